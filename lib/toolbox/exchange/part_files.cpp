// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/part_files.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

namespace {

std::string text_of(double value) { return format_number(value, 17); }

std::string text_of(const Vector3& v) {
  return text_of(v.x()) + " " + text_of(v.y()) + " " + text_of(v.z());
}

/// Appends a part to an OBJ text; `first` is the number of its first vertex, from 1.
void append_obj(const IndexedMesh& part, std::size_t number, std::size_t first, std::string& text) {
  text += "g part_" + std::to_string(number) + "\n";
  for (const Vector3& p : part.points) text += "v " + text_of(p) + "\n";
  for (const Triangle& t : part.triangles) {
    text += "f";
    for (const std::int32_t v : t) {
      text += " " + std::to_string(first + static_cast<std::size_t>(v));
    }
    text += "\n";
  }
}

std::string obj_text(const ConvexParts& parts) {
  std::string text = "# convex parts, a group each\n";
  std::size_t first = 1;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    append_obj(parts[k], k + 1, first, text);
    first += parts[k].points.size();
  }
  return text;
}

std::string stem_of(const std::string& path) { return std::filesystem::path(path).stem().string(); }

std::string part_name(const std::string& path, std::size_t number) {
  return stem_of(path) + "_" + std::to_string(number) + ".obj";
}

std::string urdf_text(const std::string& path, std::size_t parts, const MassProperties& mass,
                      double density) {
  const Eigen::Matrix3d inertia = density * mass.inertia_tensor;
  std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"" + html_escaped(stem_of(path)) +
                     "\">\n  <link name=\"grain\">\n    <inertial>\n      <origin xyz=\"" +
                     text_of(mass.centroid) + "\"/>\n      <mass value=\"" +
                     text_of(density * mass.volume) + "\"/>\n      <inertia ixx=\"" +
                     text_of(inertia(0, 0)) + "\" ixy=\"" + text_of(inertia(0, 1)) + "\" ixz=\"" +
                     text_of(inertia(0, 2)) + "\" iyy=\"" + text_of(inertia(1, 1)) + "\" iyz=\"" +
                     text_of(inertia(1, 2)) + "\" izz=\"" + text_of(inertia(2, 2)) +
                     "\"/>\n    </inertial>\n";
  for (const std::string kind : {"visual", "collision"}) {
    for (std::size_t k = 1; k <= parts; ++k) {
      text += "    <" + kind + ">\n      <geometry>\n        <mesh filename=\"" +
              html_escaped(part_name(path, k)) + "\"/>\n      </geometry>\n    </" + kind + ">\n";
    }
  }
  return text + "  </link>\n</robot>\n";
}

std::string mjcf_text(const std::string& path, const ConvexParts& parts, const MassProperties& mass,
                      double density) {
  const std::string name = html_escaped(stem_of(path));
  const Eigen::Matrix3d inertia = density * mass.inertia_tensor;
  std::string text = "<mujoco model=\"" + name + "\">\n  <asset>\n";
  for (std::size_t k = 0; k < parts.size(); ++k) {
    text += "    <mesh name=\"part_" + std::to_string(k + 1) + "\" vertex=\"";
    for (const Vector3& p : parts[k].points) text += text_of(p) + " ";
    text += "\"/>\n";
  }
  text += "  </asset>\n  <worldbody>\n    <body name=\"" + name +
          "\">\n      <freejoint/>\n      <inertial pos=\"" + text_of(mass.centroid) +
          "\" mass=\"" + text_of(density * mass.volume) + "\" fullinertia=\"" +
          text_of(Vector3(inertia.diagonal())) + " " +
          text_of(Vector3(inertia(0, 1), inertia(0, 2), inertia(1, 2))) + "\"/>\n";
  for (std::size_t k = 1; k <= parts.size(); ++k) {
    text += "      <geom type=\"mesh\" mesh=\"part_" + std::to_string(k) + "\"/>\n";
  }
  return text + "    </body>\n  </worldbody>\n</mujoco>\n";
}

}  // namespace

const std::vector<std::string>& part_endings() {
  static const std::vector<std::string> endings = {".obj", ".urdf", ".xml", ".shp"};
  return endings;
}

std::vector<std::string> parts_beside(const std::string& path, int count) {
  std::vector<std::string> files;
  if (ending_of(path) != ".urdf") return files;
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  for (int k = 1; k <= count; ++k) {
    files.push_back((folder / part_name(path, static_cast<std::size_t>(k))).string());
  }
  return files;
}

void check_part_file(const std::string& path) {
  const std::vector<std::string>& endings = part_endings();
  if (std::find(endings.begin(), endings.end(), ending_of(path)) != endings.end()) return;
  refuse("\"" + path +
         "\" does not have the ending of a format for convex parts. Give a name that ends in .obj, "
         ".urdf, .xml (MJCF) or .shp (Rockable).");
}

Rounding write_parts(const std::string& path, const ConvexParts& parts, const MassProperties& mass,
                     double density) {
  check_part_file(path);
  const std::string ending = ending_of(path);
  if (ending == ".shp") return write_rockable_shape(path, joined(parts), mass);
  if (ending != ".urdf") {
    write_file(path, ending == ".obj" ? obj_text(parts) : mjcf_text(path, parts, mass, density));
    return {};
  }
  for (std::size_t k = 1; k <= parts.size(); ++k) {
    std::string text;
    append_obj(parts[k - 1], k, 1, text);
    write_file((std::filesystem::path(path).parent_path() / part_name(path, k)).string(), text);
  }
  write_file(path, urdf_text(path, parts.size(), mass, density));
  return {};
}

Sentence inertia_warning(const std::string& path, const MassProperties& mass, double density,
                         const Sentence& lengths) {
  constexpr double least_of_mujoco = 1e-14;  // mjEPS of its compiler
  const double least = density * mass.principal_moments.minCoeff();
  if (ending_of(path) != ".xml" || least >= least_of_mujoco) return "";
  // With the mass in kg as before, moments grow with the square of the unit.
  double units = 1e3;
  while (least * units * units < least_of_mujoco) units *= 1e3;
  return "MuJoCo refuses \"" + path + "\": its least moment of inertia is " +
         format_number(least, 2) +
         ", and MuJoCo's limit is 1e-14. Use a smaller unit of length: "
         "multiply " +
         lengths + " by " + format_number(units) + ", set " +
         mention("density", format_number(density / portable::pow(units, 3))) +
         ", and multiply gravity by " + format_number(units) + ".";
}

WrittenParts write_parts(const std::string& path, const PartsResult& result,
                         const FrameOptions& options, double density) {
  const SimulationFrame frame = simulation_frame(result.scan, options);
  const MassProperties mass = in_frame(mass_properties(result.scan), frame);
  ConvexParts parts = result.parts;
  for (IndexedMesh& part : parts) part = in_frame(std::move(part), frame);
  return {write_parts(path, parts, mass, density),
          inertia_warning(path, mass, density, mention("size") + " or " + mention("scale"))};
}

}  // namespace wscvt
