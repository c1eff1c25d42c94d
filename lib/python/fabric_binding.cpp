// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/fabric/fabric.h"
#include "toolbox/volume/label_grains.h"
#include "work.h"
#include "wscvt/base/error.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

/// An array (nz, ny, nx) as a volume. `Convert` makes a label of a number.
template <class Number, class Convert>
class ArrayVolume : public LabelVolume {
 public:
  using Array = py::array_t<Number, py::array::c_style | py::array::forcecast>;

  ArrayVolume(VolumeGeometry geometry, const Array& array, Convert convert)
      : LabelVolume(std::move(geometry)), next_(array.data()), first_(next_), convert_(convert) {}

  const std::vector<Label>& next_row() override {
    row_.clear();
    for (std::int32_t x = 0; x < geometry().counts[0]; ++x) row_.push_back(convert_(*next_++));
    return row_;
  }
  void rewind() override { next_ = first_; }

 private:
  const Number* next_;
  const Number* first_;
  Convert convert_;
  std::vector<Label> row_;
};

using Labels = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
using Greys = py::array_t<float, py::array::c_style | py::array::forcecast>;

VolumeGeometry geometry_of(const py::array& array, const std::array<double, 3>& voxel_size) {
  if (array.ndim() != 3 || array.size() == 0) {
    refuse("A volume does not have the shape (nz, ny, nx). Give an array of three dimensions.");
  }
  VolumeGeometry geometry;
  constexpr py::ssize_t most = 1000000;
  for (std::size_t k = 0; k < 3; ++k) {
    const py::ssize_t count = array.shape(static_cast<py::ssize_t>(2 - k));
    if (count > most) refuse("A volume has more than a million voxels along an axis.");
    geometry.counts[k] = static_cast<std::int32_t>(count);
  }
  geometry.axes = Vector3(voxel_size[0], voxel_size[1], voxel_size[2]).asDiagonal();
  return geometry;
}

/// Returns an array of a member of each item.
template <class Item, class Get>
auto column(const std::vector<Item>& items, const Get& get) {
  using Value = decltype(get(items[0]));
  py::array_t<Value> values(static_cast<py::ssize_t>(items.size()));
  for (std::size_t k = 0; k < items.size(); ++k) values.mutable_data()[k] = get(items[k]);
  return values;
}

template <class Item>
py::array_t<double> vectors(const std::vector<Item>& items, Vector3 Item::*member) {
  std::vector<Vector3> values;
  values.reserve(items.size());
  for (const Item& item : items) values.push_back(item.*member);
  return array_of(values);
}

py::dict contacts_of(const Fabric& fabric) {
  const auto& all = fabric.contacts;
  const auto label = [&](std::size_t k) { return std::int64_t{fabric.grains[k].label}; };
  py::dict dict;
  dict["first"] = column(all, [&](const FabricContact& c) { return label(c.first); });
  dict["second"] = column(all, [&](const FabricContact& c) { return label(c.second); });
  dict["contact"] = column(all, [](const FabricContact& c) { return c.is_contact; });
  dict["faces"] =
      column(all, [](const FabricContact& c) { return static_cast<std::int64_t>(c.faces); });
  dict["raw_area"] = column(all, [](const FabricContact& c) { return c.raw_area; });
  dict["area"] = column(all, [](const FabricContact& c) { return c.area; });
  dict["area_uncertainty"] = column(all, [](const FabricContact& c) { return c.area_uncertainty; });
  dict["centre"] = vectors(all, &FabricContact::centre);
  dict["centre_uncertainty"] =
      column(all, [](const FabricContact& c) { return c.centre_uncertainty; });
  dict["normal"] = vectors(all, &FabricContact::normal);
  dict["normal_uncertainty"] =
      column(all, [](const FabricContact& c) { return c.normal_uncertainty; });
  dict["branch"] = vectors(all, &FabricContact::branch);
  dict["at_border"] = column(all, [](const FabricContact& c) { return c.at_border; });
  return dict;
}

py::dict grains_of(const Fabric& fabric) {
  const auto& all = fabric.grains;
  const auto whole = [](std::uint64_t number) { return static_cast<std::int64_t>(number); };
  py::dict dict;
  dict["label"] = column(all, [&](const FabricGrain& g) { return std::int64_t{g.label}; });
  dict["voxels"] = column(all, [&](const FabricGrain& g) { return whole(g.voxels); });
  dict["volume"] = column(all, [](const FabricGrain& g) { return g.volume; });
  dict["centre"] = vectors(all, &FabricGrain::centre);
  dict["touching"] = column(all, [&](const FabricGrain& g) { return whole(g.touching); });
  dict["contacts"] = column(all, [&](const FabricGrain& g) { return whole(g.contacts); });
  dict["contact_area"] = column(all, [](const FabricGrain& g) { return g.contact_area; });
  dict["at_border"] = column(all, [](const FabricGrain& g) { return g.at_border; });
  return dict;
}

py::dict fabric(const py::object& labels, const std::array<double, 3>& voxel_size,
                const py::object& scan, std::int64_t background, const py::object& progress) {
  for (const double length : voxel_size) require_in_range(length, voxel_size_option);
  const auto array = py::array::ensure(labels);
  const char kind = array ? array.dtype().kind() : ' ';
  if (kind != 'i' && kind != 'u' && kind != 'b') {
    throw py::type_error(
        "The labels are not whole numbers. Give an array (nz, ny, nx) of whole numbers.");
  }
  const Labels voxels(array);
  const Greys greys = scan.is_none() ? Greys() : Greys(scan);
  const auto label_of = [background](std::int64_t number) {
    if (number == background) return no_label;
    if (number < 0 || number >= std::int64_t{no_label}) {
      refuse("The labels have the number " + std::to_string(number) +
             ". Give numbers from 0 to 4294967294.");
    }
    return static_cast<Label>(number);
  };
  ArrayVolume<std::int64_t, decltype(label_of)> volume(geometry_of(voxels, voxel_size), voxels,
                                                       label_of);
  std::optional<ArrayVolume<float, Label (*)(float)>> grey_volume;
  if (!scan.is_none()) grey_volume.emplace(geometry_of(greys, voxel_size), greys, &grey_code);
  FabricOptions options;
  options.background = -1.0;  // any number that is none of the labels
  options.scan = grey_volume ? &*grey_volume : nullptr;
  const Fabric result = work_on(1, progress, [&](const Execution& execution) {
    return measure_fabric(volume, options, execution);
  });
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
             py::arg("scan") = py::none(), py::arg("background") = 0,
             py::arg("progress") = py::none());
}

}  // namespace wscvt::python
