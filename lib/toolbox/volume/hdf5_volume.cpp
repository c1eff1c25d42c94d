// SPDX-License-Identifier: GPL-3.0-or-later
// HDF5, read slice by slice by its own library (4 MB). MATLAB's files are HDF5 from version 7.3 on.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#ifdef WSCVT_HAS_HDF5
#include <hdf5.h>

#include <boost/endian/conversion.hpp>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sstream>

#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/table_heading.h"
#include "wscvt/mesh_files/text_fields.h"
#endif

namespace wscvt {

#ifdef WSCVT_HAS_HDF5

namespace {

using Json = nlohmann::json;

/// Locks the library: Debian's is not thread-safe, and several threads of a batch read volumes.
std::unique_lock<std::mutex> alone() {
  static std::mutex mutex;
  std::unique_lock<std::mutex> lock(mutex);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // otherwise it prints every error
  return lock;
}

/// An object of the library, closed at the end of its scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }

  operator hid_t() const { return id_; }
  bool is_there() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

std::optional<VoxelType> type_of(hid_t data_set) {
  Handle type(H5Dget_type(data_set), H5Tclose);
  if (!type.is_there()) return std::nullopt;
  // Truth values of h5py and PyTables are enumerations of 0 and 1.
  if (H5Tget_class(type) == H5T_ENUM) type = Handle(H5Tget_super(type), H5Tclose);
  const std::size_t size = H5Tget_size(type);
  const bool is_float = H5Tget_class(type) == H5T_FLOAT;
  const bool has_size =
      is_float ? size == 4 || size == 8 : size == 1 || size == 2 || size == 4 || size == 8;
  if ((!is_float && H5Tget_class(type) != H5T_INTEGER) || !has_size) return std::nullopt;
  return VoxelType{static_cast<int>(size), is_float || H5Tget_sign(type) == H5T_SGN_2, is_float,
                   boost::endian::order::native == boost::endian::order::big};
}

std::vector<hsize_t> counts_of(hid_t data_set) {
  const Handle space(H5Dget_space(data_set), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1) return {};
  std::vector<hsize_t> counts(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space, counts.data(), nullptr);
  return counts;
}

/// Finds the paths of the data sets that can be a volume.
void find_volumes(hid_t group, const std::string& path, int depth, std::size_t& left,
                  std::vector<std::string>& found) {
  H5G_info_t info{};
  constexpr int deepest = 16;  // groups may contain themselves
  if (depth > deepest || H5Gget_info(group, &info) < 0) return;
  for (hsize_t k = 0; k < info.nlinks && left > 0; ++k, --left) {
    char name[512];
    H5L_info_t link{};
    if (H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, name, sizeof name,
                           H5P_DEFAULT) < 0 ||
        H5Lget_info(group, name, &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD ||
        name[0] == '#') {  // MATLAB's own
      continue;
    }
    const Handle object(H5Oopen(group, name, H5P_DEFAULT), H5Oclose);
    if (!object.is_there()) continue;
    const std::string here = path + "/" + name;
    if (H5Iget_type(object) == H5I_GROUP) {
      find_volumes(object, here, depth + 1, left, found);
    } else if (H5Iget_type(object) == H5I_DATASET && counts_of(object).size() >= 3 &&
               type_of(object)) {
      found.push_back(here);
    }
  }
}

/// Whether other files hold the voxels: a file could show any other file of the machine.
bool has_foreign_voxels(hid_t data_set) {
  const Handle made(H5Dget_create_plist(data_set), H5Pclose);
  return H5Pget_external_count(made) > 0 || H5Pget_layout(made) == H5D_VIRTUAL;
}

void refuse_foreign_voxels(hid_t data_set, const std::string& name, const std::string& path) {
  if (!has_foreign_voxels(data_set)) return;
  const Handle made(H5Dget_create_plist(data_set), H5Pclose);
  refuse_volume(path,
                std::string("is an HDF5 file whose voxels are in other files, by ") +
                    (H5Pget_external_count(made) > 0 ? "external storage" : "a virtual data set") +
                    ". Copy the voxels into one file, in its folder by python3 -c 'import h5py; "
                    "h5py.File(\"one.h5\", \"w\")[\"labels\"] = h5py.File(" +
                    in_quotes(std::filesystem::path(path).filename().string()) + ")[" +
                    in_quotes(name) + "][()]'");
}

/// Returns the texts of an attribute; none without one.
std::vector<std::string> texts_of(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {};
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  const hssize_t said = H5Sget_simple_extent_npoints(space);
  constexpr std::size_t longest = 1 << 16;
  const std::size_t size = H5Tget_size(type);
  const auto count = static_cast<std::size_t>(std::max<hssize_t>(said, 0));
  if (H5Tget_class(type) != H5T_STRING || size == 0 || count > longest / size) return {};
  std::vector<std::string> texts;
  if (H5Tis_variable_str(type) > 0) {
    std::vector<char*> read(count, nullptr);
    const Handle memory(H5Tcopy(type), H5Tclose);
    if (H5Aread(attribute, memory, read.data()) < 0) return {};
    for (char* const text : read) {
      texts.emplace_back(text == nullptr ? "" : text);
      if (text != nullptr) H5free_memory(text);
    }
    return texts;
  }
  std::string all(count * size, '\0');
  if (H5Aread(attribute, type, all.data()) < 0) return {};
  for (std::size_t k = 0; k < count; ++k) {
    const std::string text = all.substr(k * size, size);
    texts.emplace_back(trimmed(text.substr(0, text.find('\0'))));
  }
  return texts;
}

/// Returns the text of an attribute, also of one that is stored letter by letter; empty without
/// one.
std::string text_of(hid_t object, const char* name) {
  std::string joined;
  const std::vector<std::string> texts = texts_of(object, name);
  for (const std::string& text : texts) {
    if (text.size() > 1 && texts.size() > 1) return "";
    joined += text;
  }
  return joined;
}

/// Returns the roles of dimensions by their names; empty if one is unknown.
std::vector<int> roles_of(const std::vector<std::string>& names) {
  std::vector<int> roles;
  for (const std::string& name : names) {
    const std::string text = lower_case(name);
    if (text == "x" || text == "y" || text == "z") {
      roles.push_back(text.front() - 'x');
    } else if (text == "c" || text == "t") {
      roles.push_back(text == "c" ? -2 : -1);
    } else {
      return {};
    }
  }
  return roles;
}

/// A length of voxels in a file's unit.
struct UnitLength {
  double length = 0.0;  ///< not above 0: unknown
  std::string unit;     ///< as unit_of gives it; empty: unknown
};

/// Sets the size of the voxels, of which the dimensions `roles` have these lengths. It stays
/// unknown where a length or the ratio of units is, or all lengths are 1 without a unit.
void take_lengths(const std::vector<int>& roles, const std::vector<UnitLength>& lengths,
                  const char* source, ArrayShape& shape) {
  Vector3 size = Vector3::Zero();
  std::string unit;
  for (std::size_t k = 0; k < roles.size(); ++k) {
    if (roles[k] < 0) continue;
    const double from = nanometres(lengths[k].unit);
    const bool is_first = size.isZero(0.0);
    if (is_first) unit = lengths[k].unit;
    const double to = nanometres(unit);
    if (lengths[k].unit != unit && from * to == 0.0) return;
    size[roles[k]] = lengths[k].length * (lengths[k].unit == unit ? 1.0 : from / to);
    if (!(size[roles[k]] > 0.0)) return;
  }
  if (!(size.minCoeff() > 0.0) || (unit.empty() && size == Vector3::Ones())) return;
  shape.voxel_size = size;
  shape.unit = unit;
  shape.size_source = source;
}

/// Reads the roles of dimensions from ilastik's axistags, and the size of the voxels that its later
/// versions write there. Nothing without them or for unknown axes.
void read_axistags(hid_t data_set, const std::string& path, ArrayShape& shape) {
  const Json json = Json::parse(text_of(data_set, "axistags"), nullptr, false);
  if (!json.is_object() || !json.contains("axes") || !json["axes"].is_array()) return;
  if (json["axes"].size() != shape.counts.size()) {
    refuse_volume(path, "has axistags of " + std::to_string(json["axes"].size()) +
                            " axes on a data set of " + std::to_string(shape.counts.size()) +
                            " dimensions. Correct the attribute \"axistags\", or remove it.");
  }
  std::vector<std::string> names;
  std::vector<UnitLength> lengths;
  for (const Json& axis : json["axes"]) {
    const auto text = [&](const char* key) {
      const bool is_there = axis.is_object() && axis.contains(key) && axis[key].is_string();
      return is_there ? axis[key].get<std::string>() : std::string();
    };
    names.push_back(text("key"));
    const bool has_length =
        axis.is_object() && axis.contains("resolution") && axis["resolution"].is_number();
    lengths.push_back({has_length ? axis["resolution"].get<double>() : 0.0, unit_of(text("unit"))});
  }
  shape.roles = roles_of(names);
  take_lengths(shape.roles, lengths, "ilastik's axistags", shape);
}

/// Returns the three numbers of an attribute; nothing without them.
std::optional<Vector3> three_numbers(hid_t object, const char* attribute) {
  if (H5Aexists(object, attribute) <= 0) return std::nullopt;
  const Handle found(H5Aopen(object, attribute, H5P_DEFAULT), H5Aclose);
  const Handle space(H5Aget_space(found), H5Sclose);
  Vector3 values;
  if (H5Sget_simple_extent_npoints(space) != 3 ||
      H5Aread(found, H5T_NATIVE_DOUBLE, values.data()) < 0) {
    return std::nullopt;
  }
  return values;
}

/// Returns the three numbers of a data set or, without it, of an attribute.
std::optional<Vector3> three_numbers(hid_t group, const std::string& data_set,
                                     const char* attribute) {
  if (H5Lexists(group, data_set.substr(0, data_set.find('/')).c_str(), H5P_DEFAULT) <= 0 ||
      H5Lexists(group, data_set.c_str(), H5P_DEFAULT) <= 0) {
    return three_numbers(group, attribute);
  }
  const Handle found(H5Dopen2(group, data_set.c_str(), H5P_DEFAULT), H5Dclose);
  if (!found.is_there() || has_foreign_voxels(found)) return std::nullopt;
  const Handle space(H5Dget_space(found), H5Sclose);
  Vector3 values;
  if (H5Sget_simple_extent_npoints(space) != 3 ||
      H5Dread(found, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    return std::nullopt;
  }
  return values;
}

/// Reads the geometry that DREAM.3D keeps in a group above the data set: version 6 in
/// _SIMPL_GEOMETRY, version 7 in attributes.
void read_dream3d(hid_t file, const std::string& name, const std::string& path, ArrayShape& shape) {
  for (std::size_t end = name.rfind('/'); end != std::string::npos && end > 0;
       end = name.rfind('/', end - 1)) {
    const Handle group(H5Gopen2(file, name.substr(0, end).c_str(), H5P_DEFAULT), H5Gclose);
    if (!group.is_there()) continue;
    const auto spacing = three_numbers(group, "_SIMPL_GEOMETRY/SPACING", "_SPACING");
    if (!spacing) continue;
    const auto sizes = three_numbers(group, "_SIMPL_GEOMETRY/DIMENSIONS", "_DIMENSIONS");
    for (std::size_t axis = 0; sizes && axis < 3; ++axis) {
      const double size = (*sizes)[static_cast<Eigen::Index>(axis)];
      if (size == static_cast<double>(shape.counts[2 - axis])) continue;
      refuse_volume(path, "has the array " + in_quotes(name) + " with " +
                              std::to_string(shape.counts[2 - axis]) + " voxels along " +
                              "xyz"[axis] + ", but DREAM.3D's DIMENSIONS say " +
                              format_number(size, 10) + ". Export it again.");
    }
    shape.voxel_size = *spacing;
    shape.corner = three_numbers(group, "_SIMPL_GEOMETRY/ORIGIN", "_ORIGIN");
    shape.unit = "";
    shape.size_source = "DREAM.3D's geometry";
    return;
  }
}

/// Returns the step of the evenly spaced positions along an axis of `count` voxels, by NeXus'
/// rules: a data set of their centres or edges, with its unit as an attribute.
UnitLength step_of_axis(hid_t group, const std::string& name, std::int64_t count) {
  const Handle axis(H5Lexists(group, name.c_str(), H5P_DEFAULT) > 0
                        ? H5Dopen2(group, name.c_str(), H5P_DEFAULT)
                        : H5I_INVALID_HID,
                    H5Dclose);
  if (!axis.is_there() || !type_of(axis) || has_foreign_voxels(axis)) return {};
  const std::vector<hsize_t> counts = counts_of(axis);
  const auto wanted = static_cast<hsize_t>(count);
  if (counts.size() != 1 || wanted < 2 || (counts[0] != wanted && counts[0] != wanted + 1)) {
    return {};
  }
  std::vector<double> places(counts[0]);
  if (H5Dread(axis, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, places.data()) < 0) return {};
  const std::string said = text_of(axis, "units");
  if (!unit_of(said).empty() && !is_known_unit(said)) return {};
  const double step = (places.back() - places.front()) / static_cast<double>(places.size() - 1);
  for (std::size_t k = 1; k < places.size(); ++k) {
    constexpr double even = 0.01;
    if (!(std::abs(places[k] - places[k - 1] - step) <= even * step)) return {};
  }
  return {step, unit_of(said)};
}

/// Reads the names of the dimensions and their positions from the group NXdata of NeXus that has
/// the data set. https://manual.nexusformat.org/classes/base_classes/NXdata.html
void read_nexus(hid_t file, hid_t data_set, const std::string& name, ArrayShape& shape) {
  const Handle group(H5Gopen2(file, (name.substr(0, name.rfind('/')) + "/").c_str(), H5P_DEFAULT),
                     H5Gclose);
  if (!group.is_there() || text_of(group, "NX_class") != "NXdata") return;
  std::vector<std::string> axes = texts_of(group, "axes");
  const std::string before_2014 = text_of(data_set, "axes");  // "z:y:x"
  if (axes.empty() && !before_2014.empty()) {
    std::istringstream parts(before_2014);
    for (std::string one; std::getline(parts, one, ':');) axes.push_back(one);
  }
  if (axes.size() != shape.counts.size()) return;
  if (shape.roles.empty()) shape.roles = roles_of(axes);
  std::vector<int> roles = shape.roles;
  if (roles.empty() && axes.size() == 3) roles = {2, 1, 0};
  std::vector<UnitLength> lengths;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    lengths.push_back(step_of_axis(group, axes[k], shape.counts[k]));
  }
  take_lengths(roles, lengths, "NeXus' axes", shape);
}

/// Returns the path of the chosen volume of an Imaris file, in full resolution; empty for other
/// files.
std::string imaris_volume(hid_t file, const VolumeChoice& choice, const std::string& path) {
  const std::string level = "/DataSet/ResolutionLevel 0/TimePoint ";
  const auto is_group = [&](const std::string& name) {
    return Handle(H5Gopen2(file, name.c_str(), H5P_DEFAULT), H5Gclose).is_there();
  };
  VolumeAxis frames = {AxisKind::Frame, 0};
  VolumeAxis channels = {AxisKind::Channel, 0};
  while (is_group(level + std::to_string(frames.count))) ++frames.count;
  while (is_group(level + "0/Channel " + std::to_string(channels.count))) ++channels.count;
  if (frames.count == 0 || channels.count == 0) return "";
  return level + std::to_string(chosen_place(frames, choice, path)) + "/Channel " +
         std::to_string(chosen_place(channels, choice, path)) + "/Data";
}

/// Reads Imaris' counts of voxels, which the stored blocks exceed, and the extent of the image.
void read_imaris(hid_t file, const std::string& name, ArrayShape& shape) {
  const Handle image(H5Gopen2(file, "/DataSetInfo/Image", H5P_DEFAULT), H5Gclose);
  const Handle channel(H5Gopen2(file, name.substr(0, name.rfind('/')).c_str(), H5P_DEFAULT),
                       H5Gclose);
  if (!image.is_there() || !channel.is_there() || shape.counts.size() != 3) return;
  std::vector<UnitLength> lengths;
  Vector3 corner = Vector3::Zero();
  for (const std::size_t k : {2U, 1U, 0U}) {  // z, y, x
    const std::string letter(1, "XYZ"[k]);
    const auto said = whole_number_in(text_of(channel, ("ImageSize" + letter).c_str()));
    std::int64_t& count = shape.counts[2 - k];
    if (said && *said > 0 && *said < count) count = *said;
    const auto least = number_in(text_of(image, ("ExtMin" + std::to_string(k)).c_str()));
    const auto most = number_in(text_of(image, ("ExtMax" + std::to_string(k)).c_str()));
    lengths.push_back({least && most ? (*most - *least) / static_cast<double>(count) : 0.0,
                       unit_of(text_of(image, "Unit"))});
    if (least) corner[static_cast<Eigen::Index>(k)] = *least;
  }
  take_lengths({2, 1, 0}, lengths, "Imaris' extent of the image", shape);
  if (shape.voxel_size.minCoeff() > 0.0) shape.corner = corner;
}

bool is_of_matlab(hid_t data_set) { return H5Aexists(data_set, "MATLAB_class") > 0; }

ArrayShape shape_of(hid_t file, const std::string& name, const std::string& path) {
  const Handle data_set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  refuse_foreign_voxels(data_set, name, path);
  ArrayShape shape;
  for (const hsize_t count : counts_of(data_set)) {
    constexpr hsize_t most = 1000000000;
    if (count < 1 || count > most) {
      refuse_volume(path, "has a dimension of " + std::to_string(count) + ". Export it again.");
    }
    shape.counts.push_back(static_cast<std::int64_t>(count));
  }
  if (is_of_matlab(data_set)) {
    // MATLAB's rows are y, its columns x, and the first dimension is the fastest; the file reverses
    // them.
    shape.roles.assign(shape.counts.size(), -1);
    const std::size_t last = shape.counts.size() - 1;
    shape.roles[last] = 1;
    shape.roles[last - 1] = 0;
    shape.roles[last - 2] = 2;
  }
  if (shape.roles.empty()) read_axistags(data_set, path, shape);
  if (shape.roles.empty()) {
    const std::vector<std::string> labels = texts_of(data_set, "DIMENSION_LABELS");
    if (labels.size() == shape.counts.size()) shape.roles = roles_of(labels);
  }
  const auto is_unknown = [&] { return !(shape.voxel_size.minCoeff() > 0.0); };
  // Of Fiji and ilastik: z, y, x in micrometres.
  if (const std::optional<Vector3> size_um = three_numbers(data_set, "element_size_um")) {
    shape.voxel_size = size_um->reverse();
    shape.unit = "um";
    shape.size_source = "element_size_um";
  }
  if (is_unknown() && !is_of_matlab(data_set)) read_nexus(file, data_set, name, shape);
  if (is_unknown()) read_dream3d(file, name, path, shape);
  if (is_unknown()) read_imaris(file, name, shape);
  return shape;
}

/// Says which attribute may be the size of a voxel; empty: none.
Sentence note_of_size(hid_t file, const std::string& name) {
  const Handle data_set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  for (const char* key :
       {"voxel_size", "voxelsize", "spacing", "resolution", "pixel_size", "scale"}) {
    const std::optional<Vector3> found = three_numbers(data_set, key);
    if (!found) continue;
    return std::string("The attribute \"") + key + "\" has " + format_number((*found)[0], 6) +
           ", " + format_number((*found)[1], 6) + " and " + format_number((*found)[2], 6) +
           ". It was not used, because it says neither its unit nor the order of its axes.";
  }
  return {};
}

/// The bytes of the voxels, read slice by slice.
class Hdf5Bytes : public MadeBytes {
 public:
  Hdf5Bytes(const ShapedVolume& volume, std::string path, const std::string& name,
            const VolumeChoice& choice)
      : path_(std::move(path)) {
    const auto lock = alone();
    file_ = Handle(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    // The dimensions, the slowest first; the first dimension of space is the slices'.
    for (std::size_t k = volume.axes.size(); k-- > 0;) {
      const VolumeAxis& axis = volume.axes[k];
      const bool is_space = axis.kind == AxisKind::Space;
      begin_.push_back(is_space ? 0 : static_cast<hsize_t>(chosen_place(axis, choice, path_)));
      counts_.push_back(is_space ? static_cast<hsize_t>(axis.count) : 1);
      if (is_space && slices_ == none) slices_ = counts_.size() - 1;
    }
    end_ = std::exchange(counts_[slices_], hsize_t{1});
    data_set_ = Handle(H5Dopen2(file_, name.c_str(), access_list(name)), H5Dclose);
    const Handle stored(H5Dget_type(data_set_), H5Tclose);
    memory_type_ = Handle(H5Tget_native_type(stored, H5T_DIR_ASCEND), H5Tclose);
    if (!memory_type_.is_there()) {
      refuse_volume(path_, "was changed while it was read. Run the command again.");
    }
  }
  Hdf5Bytes(const Hdf5Bytes&) = delete;
  Hdf5Bytes& operator=(const Hdf5Bytes&) = delete;
  ~Hdf5Bytes() override {
    const auto lock = alone();
    memory_type_ = Handle(H5I_INVALID_HID, H5Tclose);
    data_set_ = Handle(H5I_INVALID_HID, H5Dclose);
    file_ = Handle(H5I_INVALID_HID, H5Fclose);
  }

 private:
  static constexpr std::size_t none = 100;

  /// Keeps unpacked chunks of the current slice in memory, up to 256 MB.
  Handle access_list(const std::string& name) const {
    Handle list(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
    const Handle plain(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle made(H5Dget_create_plist(plain), H5Pclose);
    if (H5Pget_layout(made) != H5D_CHUNKED) return list;
    std::vector<hsize_t> chunk(counts_.size());
    H5Pget_chunk(made, static_cast<int>(chunk.size()), chunk.data());
    double bytes = 8.0;
    for (std::size_t k = 0; k < chunk.size(); ++k) {
      const hsize_t chunks = (counts_[k] + chunk[k] - 1) / chunk[k] + 1;
      bytes *= static_cast<double>(chunks) * static_cast<double>(chunk[k]);
    }
    constexpr double most = 256.0 * 1024 * 1024;
    constexpr std::size_t slots = 100003;  // a prime, as the library recommends
    H5Pset_chunk_cache(list, slots, static_cast<std::size_t>(std::min(bytes, most)), 1.0);
    return list;
  }

  bool make(std::vector<char>& made) override {
    if (begin_[slices_] == end_) return false;
    const auto lock = alone();
    hsize_t bytes = H5Tget_size(memory_type_);
    for (const hsize_t count : counts_) bytes *= count;
    constexpr hsize_t most = hsize_t{1} << 32;
    if (bytes > most) refuse_volume(path_, "has slices of more than 4 GiB, which is too large.");
    made.resize(bytes);
    const Handle space(H5Dget_space(data_set_), H5Sclose);
    const Handle memory(H5Screate_simple(static_cast<int>(counts_.size()), counts_.data(), nullptr),
                        H5Sclose);
    if (H5Sselect_hyperslab(space, H5S_SELECT_SET, begin_.data(), nullptr, counts_.data(),
                            nullptr) < 0 ||
        H5Dread(data_set_, memory_type_, memory, space, H5P_DEFAULT, made.data()) < 0) {
      refuse_volume(path_,
                    "is damaged, or packed by a filter that is not installed. Copy it again, "
                    "or export it packed by gzip.");
    }
    ++begin_[slices_];
    return true;
  }

  std::string path_;
  Handle file_{H5I_INVALID_HID, H5Fclose};
  Handle data_set_{H5I_INVALID_HID, H5Dclose};
  Handle memory_type_{H5I_INVALID_HID, H5Tclose};
  std::vector<hsize_t> begin_;
  std::vector<hsize_t> counts_;
  std::size_t slices_ = none;  ///< the dimension
  hsize_t end_ = 0;            ///< number of slices
};

}  // namespace

std::unique_ptr<LabelVolume> open_hdf5(const std::string& path, const VolumeChoice& chosen) {
  VolumeChoice choice = chosen;
  file_size(path);  // throws if there is no file
  std::string name;
  Sentence note;
  Sentence size_note;
  ArrayShape shape;
  VoxelType type;
  {
    const auto lock = alone();
    const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!file.is_there()) {
      refuse_volume(path,
                    ending_of(path) == ".mat"
                        ? "is not a MATLAB file of version 7.3. Save it by save(..., '-v7.3')."
                        : "is not an HDF5 file, or is damaged. Export it again.");
    }
    std::vector<std::string> names;
    std::size_t left = 100000;
    find_volumes(file, "", 0, left, names);
    if (names.empty()) {
      refuse_volume(path,
                    "has no data set of three dimensions with whole numbers, float32 or float64. "
                    "Links to other files are not followed. Save the voxels so, in one file.");
    }
    if (!choice.array.empty() && choice.array.front() != '/') choice.array = "/" + choice.array;
    if (choice.array.empty()) {
      choice.array = imaris_volume(file, choice, path);
      if (!choice.array.empty()) choice.channel = choice.frame = std::nullopt;
    }
    // Of DREAM.3D's arrays of cells one has the labels.
    std::vector<std::string> labels;
    for (const std::string& one : names) {
      if (one.substr(one.rfind('/') + 1) == "FeatureIds") labels.push_back(one);
    }
    if (choice.array.empty() && names.size() > 1 && labels.size() == 1) {
      note = "The array \"" + labels.front() + "\" was read, one of " +
             std::to_string(names.size()) + ". Choose another by " +
             mention("select", "array=NAME") + ".";
      choice.array = labels.front();
    }
    name = names[chosen_array(names, choice, path)];
    shape = shape_of(file, name, path);
    type = type_of(Handle(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose)).value();
    if (!(shape.voxel_size.minCoeff() > 0.0) && !choice.voxel_size) {
      size_note = note_of_size(file, name);
    }
  }
  const ShapedVolume shaped = volume_of_shape(shape, choice, path);
  std::unique_ptr<LabelVolume> volume = volume_of_bytes(
      shaped.geometry, type, {},
      [=] { return std::make_unique<Hdf5Bytes>(shaped, path, name, choice); }, path);
  for (const Sentence& sentence : {note, size_note}) {
    if (!sentence.empty()) volume->add_note(sentence);
  }
  return volume;
}

#else

std::unique_ptr<LabelVolume> open_hdf5(const std::string& path, const VolumeChoice&) {
  refuse_without(path, "HDF5", "libhdf5-dev");
}

#endif

}  // namespace wscvt
