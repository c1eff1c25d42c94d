// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#include "wscvt/base/error.h"
#include "wscvt/base/input_file.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

using Json = nlohmann::json;

Json description_of(const std::string& path) {
  constexpr std::uint64_t most_bytes = 1 << 20;
  if (file_size(path) > most_bytes) {
    refuse_volume(path, "is too large for the description of a raw file. Give the description.");
  }
  InputFile stream(path);
  Json description = Json::parse(stream, nullptr, false);
  if (!description.is_object()) {
    refuse_volume(path, "is not a JSON object. See lib/doc/files.md for its content.");
  }
  return description;
}

/// Refuses unknown keys, which may be misspelled.
void check_keys(const Json& description, const std::string& path) {
  for (const auto& [key, value] : description.items()) {
    constexpr std::array<const char*, 8> known = {"dimensions", "type", "byte_order", "spacing",
                                                  "origin",     "unit", "offset",     "file"};
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    refuse_volume(path, "has the key " + in_quotes(key) +
                            ", which is not for raw files. See lib/doc/files.md for the keys.");
  }
}

/// Reads three numbers, or one for all three.
Vector3 vector_of(const Json& value, const std::string& key, const std::string& path) {
  if (value.is_number()) return Vector3::Constant(value.get<double>());
  Vector3 vector;
  const bool has_three = value.is_array() && value.size() == 3;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!has_three || !value[axis].is_number()) {
      refuse_volume(path, "does not have three numbers as \"" + key + "\". Correct it.");
    }
    vector[static_cast<Eigen::Index>(axis)] = value[axis].get<double>();
  }
  return vector;
}

std::string text_of(const Json& description, const std::string& key, const std::string& fallback,
                    const std::string& path) {
  const auto found = description.find(key);
  if (found == description.end()) return fallback;
  if (!found->is_string())
    refuse_volume(path, "does not have a text as \"" + key + "\". Correct it.");
  return found->get<std::string>();
}

VoxelCounts counts_of(const Json& description, const std::string& path) {
  std::array<std::int64_t, 3> counts{};
  const auto found = description.find("dimensions");
  const bool has_three = found != description.end() && found->is_array() && found->size() == 3;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!has_three || !(*found)[axis].is_number_integer()) {
      refuse_volume(
          path,
          "does not have three whole numbers as \"dimensions\". Give the voxels along x, y "
          "and z.");
    }
    counts[axis] = (*found)[axis].get<std::int64_t>();
  }
  return voxel_counts(counts, path);
}

}  // namespace

std::unique_ptr<LabelVolume> open_raw(const std::string& path, const VolumeChoice& choice) {
  const Json description = description_of(path);
  check_keys(description, path);
  VolumeGeometry geometry;
  geometry.counts = counts_of(description, path);
  geometry.unit = unit_of(text_of(description, "unit", "", path));
  geometry.has_size = description.contains("spacing");
  const Vector3 spacing = vector_of(description.value("spacing", Json(1)), "spacing", path);
  require_spacing(spacing, choice, path);
  const Vector3 origin = vector_of(description.value("origin", Json(0)), "origin", path);
  set_lattice(geometry, spacing.asDiagonal(), origin, choice, path);
  VoxelType type = voxel_type_of(text_of(description, "type", "", path), path);
  const std::string order = text_of(description, "byte_order", "little", path);
  if (order != "little" && order != "big") {
    refuse_volume(path, "has a \"byte_order\" that is neither \"little\" nor \"big\". Correct it.");
  }
  type.big_endian = order == "big";
  const Json offset = description.value("offset", Json(0U));
  if (!offset.is_number_unsigned()) {
    refuse_volume(path, "has an \"offset\" that is not a number of bytes. Correct it.");
  }
  const std::string beside =
      std::filesystem::path(path).filename().replace_extension(".raw").string();
  refuse_array_choice(choice, path);
  VoxelData data;
  data.picks = picks_of({}, choice, path);
  data.paths = {voxel_file_beside(path, text_of(description, "file", beside, path))};
  data.offset = offset.get<std::uint64_t>();
  return volume_of_files(geometry, type, data);
}

}  // namespace wscvt
