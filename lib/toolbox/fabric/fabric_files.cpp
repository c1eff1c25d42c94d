// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/fabric/fabric_files.h"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <sstream>

#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/text_writers.h"

namespace wscvt {

namespace {

constexpr int disc_corners = 16;

std::string yes(bool value) { return value ? "1" : "0"; }

bool has_disc(const FabricContact& contact) { return contact.is_contact && !contact.is_closed; }

/// Adds a disc as a fan about its centre. Its area is the contact's.
void add_disc(const FabricContact& contact, IndexedMesh& mesh) {
  const Vector3 right = contact.normal.unitOrthogonal();
  const Vector3 up = contact.normal.cross(right);
  constexpr double turn = 2.0 * pi / disc_corners;
  const double radius = std::sqrt(2.0 * contact.area / (disc_corners * portable::sin(turn)));
  const auto middle = static_cast<int>(mesh.points.size());
  mesh.points.push_back(contact.centre);
  for (int k = 0; k < disc_corners; ++k) {
    const double angle = turn * k;
    mesh.points.push_back(contact.centre +
                          radius * (portable::cos(angle) * right + portable::sin(angle) * up));
    mesh.triangles.push_back({middle, middle + 1 + k, middle + 1 + (k + 1) % disc_corners});
  }
}

/// Returns an element with a text for each point of each disc.
std::string point_array(const Fabric& fabric, const std::string& type,
                        const std::string& attributes,
                        const std::function<std::string(const FabricContact&)>& text) {
  std::string numbers;
  for (const FabricContact& contact : fabric.contacts) {
    if (!has_disc(contact)) continue;
    const std::string line = text(contact) + "\n";
    for (int k = 0; k <= disc_corners; ++k) numbers += line;
  }
  return vtk_data_array(type, attributes, numbers);
}

}  // namespace

std::string contacts_csv(const Fabric& fabric) {
  std::string text = csv_record({"first",
                                 "second",
                                 "contact",
                                 "faces",
                                 "raw_area",
                                 "area",
                                 "area_uncertainty",
                                 "x",
                                 "y",
                                 "z",
                                 "centre_uncertainty",
                                 "normal_x",
                                 "normal_y",
                                 "normal_z",
                                 "normal_uncertainty",
                                 "branch_x",
                                 "branch_y",
                                 "branch_z",
                                 "at_border",
                                 "unit"});
  for (const FabricContact& contact : fabric.contacts) {
    std::vector<std::string> fields = {std::to_string(fabric.grains[contact.first].label),
                                       std::to_string(fabric.grains[contact.second].label),
                                       yes(contact.is_contact),
                                       std::to_string(contact.faces),
                                       format_exact(contact.raw_area),
                                       format_exact(contact.area),
                                       format_exact(contact.area_uncertainty)};
    append_exact(fields, contact.centre);
    fields.push_back(format_exact(contact.centre_uncertainty));
    append_exact(fields, contact.normal);
    fields.push_back(format_exact(contact.normal_uncertainty));
    append_exact(fields, contact.branch);
    fields.push_back(yes(contact.at_border));
    fields.push_back(fabric.geometry.unit);
    text += csv_record(fields);
  }
  return text;
}

std::string fabric_grains_csv(const Fabric& fabric) {
  std::string text = csv_record({"label", "name", "voxels", "volume", "x", "y", "z", "touching",
                                 "contacts", "contact_area", "at_border", "unit"});
  for (const FabricGrain& grain : fabric.grains) {
    const auto name = fabric.names.find(grain.label);
    std::vector<std::string> fields = {std::to_string(grain.label),
                                       name == fabric.names.end() ? "" : name->second,
                                       std::to_string(grain.voxels), format_exact(grain.volume)};
    append_exact(fields, grain.centre);
    fields.push_back(std::to_string(grain.touching));
    fields.push_back(std::to_string(grain.contacts));
    fields.push_back(format_exact(grain.contact_area));
    fields.push_back(yes(grain.at_border));
    fields.push_back(fabric.geometry.unit);
    text += csv_record(fields);
  }
  return text;
}

std::string contacts_vtp(const Fabric& fabric) {
  IndexedMesh mesh;
  for (const FabricContact& contact : fabric.contacts) {
    if (has_disc(contact)) add_disc(contact, mesh);
  }
  const auto vectors = [&](const std::string& name, Vector3 FabricContact::*member) {
    return point_array(
        fabric, "Float64", "Name=\"" + name + "\" NumberOfComponents=\"3\"",
        [member](const FabricContact& contact) { return vector_text(contact.*member); });
  };
  const auto numbers = [&](const std::string& name, double FabricContact::*member) {
    return point_array(
        fabric, "Float64", "Name=\"" + name + "\"",
        [member](const FabricContact& contact) { return format_exact(contact.*member); });
  };
  const auto labels = [&](const std::string& name, std::size_t FabricContact::*member) {
    return point_array(fabric, "Int64", "Name=\"" + name + "\"",
                       [&fabric, member](const FabricContact& contact) {
                         return std::to_string(fabric.grains[contact.*member].label);
                       });
  };
  std::ostringstream text;
  write_vtp(text, mesh,
            "<PointData Normals=\"normal\" Scalars=\"area\">\n" +
                vectors("normal", &FabricContact::normal) +
                vectors("branch", &FabricContact::branch) + numbers("area", &FabricContact::area) +
                numbers("area_uncertainty", &FabricContact::area_uncertainty) +
                labels("first", &FabricContact::first) + labels("second", &FabricContact::second) +
                "</PointData>\n");
  return text.str();
}

std::vector<std::string> fabric_lines(const Fabric& fabric) {
  const std::string& unit = fabric.geometry.unit;
  const std::string after = unit.empty() ? "" : " " + unit;
  const std::size_t pairs = fabric.contacts.size();
  double raw = 0.0;
  for (const FabricContact& contact : fabric.contacts) raw += contact.raw_area;
  const std::string square = unit.empty() ? "" : after + "^2";
  std::vector<std::string> lines = {
      std::to_string(fabric.grains.size()) + " grains, " +
          std::to_string(fabric.grains.size() - fabric.whole_grains) + " of them at the border",
      format_count(pairs, "pair of labels touches: ", "pairs of labels touch: ") +
          std::to_string(fabric.contact_count) + " in contact, " +
          std::to_string(pairs - fabric.contact_count) + " with a narrow gap",
      "Projected area of the contacts " + format_number(fabric.contact_area, 4) + square +
          ", standard uncertainty " + format_number(fabric.contact_area_uncertainty, 4) + square +
          "; of all pairs as the labels have it " + format_number(raw, 4) + square};
  if (fabric.closed_count > 0) {
    lines.push_back(format_count(fabric.closed_count, "wall closes on itself: its area is",
                                 "walls close on themselves: their area is") +
                    " that of the wall, not projected, and it has no normal");
  }
  if (fabric.whole_grains > 0) {
    lines.push_back("Mean coordination of the grains not at the border: " +
                    format_number(fabric.coordination, 3));
  }
  if (fabric.contact_count > fabric.closed_count) {
    const auto diagonal = [](const Eigen::Matrix3d& t) {
      std::string text;
      for (Eigen::Index k = 0; k < 3; ++k) {
        text += (k == 0 ? "" : " ") + format_number(without_rounding(t(k, k), t.trace()), 3);
      }
      return text;
    };
    lines.push_back("Fabric tensor of the normals, xx yy zz: " + diagonal(fabric.tensor) +
                    "; anisotropy " + format_number(anisotropy_of(fabric.tensor), 3));
  }
  lines.push_back(
      fabric.blur
          ? "Blur of the scan: a standard deviation of " + format_number(*fabric.blur, 3) + after +
                ", " +
                format_number(*fabric.blur / portable::cbrt(fabric.geometry.voxel_volume()), 3) +
                " voxels"
          : "The labels were taken as exact. If they come from a blurred scan, give it, or false "
            "contacts remain and areas are too large");
  return lines;
}

}  // namespace wscvt
