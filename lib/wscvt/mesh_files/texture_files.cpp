// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>

#include "wscvt/base/error.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/input_file.h"
#include "wscvt/mesh_files/byte_reader.h"
#include "wscvt/mesh_files/readers.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

namespace fs = std::filesystem;

/// Returns the path of a file that another file names, in its folder. Tries the name unchanged,
/// with slashes for backslashes, and without folders. Returns the first if no file exists.
fs::path named_file(const fs::path& folder, const std::string& name) {
  std::string with_slashes = name;
  std::replace(with_slashes.begin(), with_slashes.end(), '\\', '/');
  fs::path known = folder / name;
  for (const fs::path& path :
       {known, folder / with_slashes, folder / fs::path(with_slashes).filename()}) {
    std::error_code error;
    if (fs::is_regular_file(path, error)) return path;
  }
  return known;
}

struct Material {
  std::string picture;             ///< file name; empty: none
  fs::path folder;                 ///< of its library
  std::optional<Vector3> diffuse;  ///< colour, 0 to 1
};

/// Returns the name after the options of a map; it may contain blanks.
std::string map_name(TextFields fields) {
  std::string_view name = trimmed(fields.rest());
  std::string_view field = fields.next();
  while (!field.empty() && field.front() == '-') {
    // Some options have one word as argument, others up to three numbers.
    const bool has_numbers = field == "-o" || field == "-s" || field == "-t" || field == "-mm";
    name = trimmed(fields.rest());
    field = fields.next();
    for (int k = 0; has_numbers ? k < 3 && number_in(field).has_value() : k < 1; ++k) {
      name = trimmed(fields.rest());
      field = fields.next();
    }
  }
  return std::string(name);
}

void read_materials(const fs::path& path, std::map<std::string, Material>& materials) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  InputFile stream(path.string(), MissingFile::IsEmpty);
  ByteReader reader(stream, error ? 0 : size, path.string());
  Material* material = nullptr;
  while (const std::optional<std::string_view> line = reader.line()) {
    TextFields fields(*line);
    const std::string keyword = lower_case(fields.next());
    if (keyword == "newmtl") {
      material = &materials[std::string(trimmed(fields.rest()))];
      material->folder = path.parent_path();
    } else if (material != nullptr && keyword == "map_kd") {
      material->picture = map_name(fields);
    } else if (material != nullptr && keyword == "kd") {
      Vector3 colour = Vector3::Zero();
      bool is_whole = true;
      for (double& part : colour) {
        const std::optional<double> value = number_in(fields.next());
        is_whole = is_whole && value && std::isfinite(*value);
        if (is_whole) part = std::clamp(*value, 0.0, 1.0);
      }
      if (is_whole) material->diffuse = colour;
    }
  }
}

/// Returns a picture of one pixel.
TexturePicture plain_picture(const Vector3& colour) {
  TexturePicture picture{1, 1, {}};
  for (const double part : colour) {
    picture.colours.push_back(static_cast<std::uint8_t>(std::lround(255.0 * part)));
  }
  return picture;
}

/// Reads the material files. Blanks may be part of a name or separate several names.
std::map<std::string, Material> materials_of(const std::vector<std::string>& libraries,
                                             const fs::path& folder,
                                             std::vector<std::string>& warnings) {
  std::map<std::string, Material> materials;
  for (const std::string& library : libraries) {
    std::vector<std::string> names = {library};
    std::error_code error;
    if (!fs::is_regular_file(named_file(folder, library), error)) {
      names.clear();
      TextFields fields(library);
      for (std::string_view name = fields.next(); !name.empty(); name = fields.next()) {
        names.emplace_back(name);
      }
    }
    for (const std::string& name : names) {
      const fs::path path = named_file(folder, name);
      if (fs::is_regular_file(path, error)) {
        read_materials(path, materials);
      } else {
        warnings.push_back("The file of materials \"" + path.string() +
                           "\" is not there. The remesh gets no colours from it.");
      }
    }
  }
  return materials;
}

}  // namespace

std::vector<TexturePicture> pictures_of(const std::vector<std::string>& names,
                                        const std::vector<std::string>& libraries,
                                        const std::string& mesh_path,
                                        std::vector<std::string>& warnings,
                                        const Execution& execution) {
  const fs::path folder = fs::path(mesh_path).parent_path();
  std::map<std::string, Material> materials;
  if (libraries.empty()) {
    for (const std::string& name : names) materials[name] = {name, folder, {}};
  } else {
    materials = materials_of(libraries, folder, warnings);
  }
  std::vector<TexturePicture> pictures(names.size());
  std::map<fs::path, std::size_t> known;  // several materials may use one picture
  bool has_picture = false;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    execution.report(static_cast<double>(k) / static_cast<double>(pictures.size()),
                     "Reading the pictures");
    const auto found = materials.find(names[k]);
    if (found == materials.end() || found->second.picture.empty()) continue;
    const fs::path path = named_file(found->second.folder, found->second.picture);
    const auto [first, is_new] = known.emplace(path, k);
    if (!is_new) {
      pictures[k] = pictures[first->second];
      continue;
    }
    try {
      pictures[k] = read_picture(path.string());
      has_picture = true;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::InputOutput) throw;
      warnings.push_back("The picture " + std::string(error.what()) +
                         " The remesh gets no colours from it.");
    }
  }
  for (std::size_t k = 0; has_picture && k < pictures.size(); ++k) {
    const auto found = materials.find(names[k]);
    if (found == materials.end() || !found->second.picture.empty()) continue;
    if (found->second.diffuse) pictures[k] = plain_picture(*found->second.diffuse);
  }
  return pictures;
}

}  // namespace wscvt
