// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/fabric/fabric.h"
#include "toolbox/volume/label_volume.h"
#include "work.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

/// Returns the array's numbers of the items' labels: of 64 bits, without sign only if needed.
template <class Item, class Get>
py::object numbers_of(const Fabric& fabric, const std::vector<Item>& items, const Get& label_of) {
  const auto number = [&](const Item& item) -> std::uint64_t {
    const Label label = label_of(item);
    const auto name = fabric.names.find(label);
    return name == fabric.names.end() ? label : std::stoull(name->second);
  };
  const auto is_large = [&](const Item& item) { return number(item) > INT64_MAX; };
  if (std::any_of(items.begin(), items.end(), is_large)) return column(items, number);
  return column(items, [&](const Item& item) { return static_cast<std::int64_t>(number(item)); });
}

py::dict contacts_of(const Fabric& fabric) {
  const auto& all = fabric.contacts;
  const auto& grains = fabric.grains;
  py::dict dict;
  dict["first"] =
      numbers_of(fabric, all, [&](const FabricContact& c) { return grains[c.first].label; });
  dict["second"] =
      numbers_of(fabric, all, [&](const FabricContact& c) { return grains[c.second].label; });
  dict["contact"] = column(all, &FabricContact::is_contact);
  dict["faces"] =
      column(all, [](const FabricContact& c) { return static_cast<std::int64_t>(c.faces); });
  dict["raw_area"] = column(all, &FabricContact::raw_area);
  dict["area"] = column(all, &FabricContact::area);
  dict["area_uncertainty"] = column(all, &FabricContact::area_uncertainty);
  dict["centre"] = column(all, &FabricContact::centre);
  dict["centre_uncertainty"] = column(all, &FabricContact::centre_uncertainty);
  dict["normal"] = column(all, &FabricContact::normal);
  dict["normal_uncertainty"] = column(all, &FabricContact::normal_uncertainty);
  dict["branch"] = column(all, &FabricContact::branch);
  dict["at_border"] = column(all, &FabricContact::at_border);
  return dict;
}

py::dict grains_of(const Fabric& fabric) {
  const auto& all = fabric.grains;
  const auto whole = [](std::uint64_t number) { return static_cast<std::int64_t>(number); };
  py::dict dict;
  dict["label"] = numbers_of(fabric, all, [](const FabricGrain& g) { return g.label; });
  dict["voxels"] = column(all, [&](const FabricGrain& g) { return whole(g.voxels); });
  dict["volume"] = column(all, &FabricGrain::volume);
  dict["centre"] = column(all, &FabricGrain::centre);
  dict["touching"] = column(all, [&](const FabricGrain& g) { return whole(g.touching); });
  dict["contacts"] = column(all, [&](const FabricGrain& g) { return whole(g.contacts); });
  dict["contact_area"] = column(all, &FabricGrain::contact_area);
  dict["at_border"] = column(all, &FabricGrain::at_border);
  return dict;
}

py::dict fabric(const py::object& labels, const std::array<double, 3>& voxel_size,
                const py::object& scan, double background, const py::object& progress) {
  const VolumeOfArray array = volume_of(labels, "labels", voxel_size);
  const std::unique_ptr<LabelVolume> volume = array.open();
  // Any number is a grey value, also of types that no file of labels has.
  const VolumeOfArray greys = scan.is_none()
                                  ? VolumeOfArray()
                                  : volume_of(py::array_t<float>::ensure(scan), "scan", voxel_size);
  const std::unique_ptr<LabelVolume> grey_volume = scan.is_none() ? nullptr : greys.open();
  FabricOptions options;
  options.background = background;
  options.scan = grey_volume.get();
  const Fabric result = work_on(1, progress, [&](const Execution& execution) {
    return of_array([&] { return measure_fabric(*volume, options, execution); });
  });
  for (const Sentence& warning : volume->warnings()) warn(warning);
  py::dict dict;
  dict["contacts"] = contacts_of(result);
  dict["grains"] = grains_of(result);
  dict["tensor"] = result.tensor;
  dict["branch_tensor"] = result.branch_tensor;
  dict["anisotropy"] = anisotropy_of(result.tensor);
  dict["coordination"] = result.coordination;
  dict["blur"] = result.blur;
  return dict;
}

}  // namespace

void bind_fabric(py::module_& module) {
  module.def("fabric", &fabric, py::arg("labels"), py::arg("voxel_size"), py::kw_only(),
             py::arg("scan") = py::none(), py::arg("background") = 0.0,
             py::arg("progress") = py::none());
}

}  // namespace wscvt::python
