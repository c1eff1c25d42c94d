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
#include <mutex>
#include <nlohmann/json.hpp>

#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
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

/// Returns the text of an attribute; empty without one.
std::string text_of(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return "";
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) return "";
  constexpr std::size_t longest = 1 << 16;
  if (H5Tis_variable_str(type) > 0) {
    char* text = nullptr;
    const Handle memory(H5Tcopy(type), H5Tclose);
    if (H5Aread(attribute, memory, &text) < 0 || text == nullptr) return "";
    const std::string result(text);
    H5free_memory(text);
    return result;
  }
  const std::size_t size = H5Tget_size(type);
  if (size > longest) return "";
  std::string text(size, '\0');
  if (H5Aread(attribute, type, text.data()) < 0) return "";
  return text.substr(0, text.find('\0'));
}

/// Returns the roles of dimensions by ilastik's axistags; empty without them or for unknown ones.
std::vector<int> roles_of_axistags(hid_t data_set, std::size_t dimensions,
                                   const std::string& path) {
  const Json json = Json::parse(text_of(data_set, "axistags"), nullptr, false);
  if (!json.is_object() || !json.contains("axes") || !json["axes"].is_array()) return {};
  if (json["axes"].size() != dimensions) {
    refuse_volume(path, "has axistags of " + std::to_string(json["axes"].size()) +
                            " axes on a data set of " + std::to_string(dimensions) +
                            " dimensions. Correct the attribute \"axistags\", or remove it.");
  }
  std::vector<int> roles;
  for (const Json& axis : json["axes"]) {
    const std::string key =
        axis.is_object() && axis.contains("key") && axis["key"].is_string() ? axis["key"] : "";
    if (key == "x" || key == "y" || key == "z") {
      roles.push_back(key.front() - 'x');
    } else if (key == "c" || key == "t") {
      roles.push_back(key == "c" ? -2 : -1);
    } else {
      return {};
    }
  }
  return roles;
}

/// Returns the roles of dimensions by the labels of HDF5's dimension scales; empty without them or
/// for unknown ones.
std::vector<int> roles_of_labels(hid_t data_set, std::size_t dimensions) {
  constexpr const char* name = "DIMENSION_LABELS";
  if (H5Aexists(data_set, name) <= 0) return {};
  const Handle attribute(H5Aopen(data_set, name, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  if (H5Tis_variable_str(type) <= 0 ||
      H5Sget_simple_extent_npoints(space) != static_cast<hssize_t>(dimensions)) {
    return {};
  }
  std::vector<char*> labels(dimensions, nullptr);
  const Handle memory(H5Tcopy(type), H5Tclose);
  if (H5Aread(attribute, memory, labels.data()) < 0) return {};
  std::vector<int> roles;
  for (char* const label : labels) {
    const std::string text = label == nullptr ? "" : lower_case(label);
    if (text == "x" || text == "y" || text == "z") roles.push_back(text.front() - 'x');
    if (text == "c" || text == "t") roles.push_back(text == "c" ? -2 : -1);
    if (label != nullptr) H5free_memory(label);
  }
  if (roles.size() < dimensions) roles.clear();
  return roles;
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
  if (shape.roles.empty()) shape.roles = roles_of_axistags(data_set, shape.counts.size(), path);
  if (shape.roles.empty()) shape.roles = roles_of_labels(data_set, shape.counts.size());
  // Of Fiji and ilastik: z, y, x in micrometres.
  const std::optional<Vector3> size_um = three_numbers(data_set, "element_size_um");
  if (size_um) shape.voxel_size = size_um->reverse();
  shape.unit = "um";
  shape.size_source = "element_size_um";
  if (!(shape.voxel_size.minCoeff() > 0.0)) read_dream3d(file, name, path, shape);
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
      const auto chunks = static_cast<double>((counts_[k] + chunk[k] - 1) / chunk[k] + 1);
      bytes *= chunks * static_cast<double>(chunk[k]);
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

std::unique_ptr<LabelVolume> open_hdf5(const std::string& path, const VolumeChoice& choice) {
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
    VolumeChoice from_root = choice;
    if (!choice.array.empty() && choice.array.front() != '/') from_root.array = "/" + choice.array;
    // Of DREAM.3D's arrays of cells one has the labels.
    std::vector<std::string> labels;
    for (const std::string& one : names) {
      if (one.substr(one.rfind('/') + 1) == "FeatureIds") labels.push_back(one);
    }
    if (choice.array.empty() && names.size() > 1 && labels.size() == 1) {
      note = "The array \"" + labels.front() + "\" was read, one of " +
             std::to_string(names.size()) + ". Choose another by " +
             mention("select", "array=NAME") + ".";
      from_root.array = labels.front();
    }
    name = names[chosen_array(names, from_root, path)];
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
  refuse_volume(path,
                "cannot be read: this program was built without HDF5. Install libhdf5-dev and "
                "build it again, or save the volume as .nrrd.");
}

#endif

}  // namespace wscvt
