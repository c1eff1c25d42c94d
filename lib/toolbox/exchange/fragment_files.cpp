// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/fragment_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "toolbox/convex/convex_body.h"
#include "toolbox/exchange/part_files.h"
#include "toolbox/exchange/simulation_options.h"
#include "toolbox/sample/csv_reader.h"
#include "wscvt/base/error.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/mesh_files/text_writers.h"

namespace wscvt {

void check_fragment_format(const std::string& format) {
  if (format == "urdf" || format == "xml" || format == "shp") return;
  if (is_mesh_format("mesh." + format, MeshUse::Write)) return;
  refuse("The format of the fragments is \"" + format + "\". Give " + mention("format") +
         " one of " + mesh_extensions(MeshUse::Write) +
         ", or urdf, xml (MuJoCo) or shp (Rockable), without the point.");
}

Rounding write_fragment(const std::string& path, const IndexedMesh& mesh,
                        const MassProperties& mass, double density) {
  const std::string ending = ending_of(path);
  if (ending == ".urdf" || ending == ".xml") {
    write_parts(path, {convex_body(mesh.points).hull}, mass, density);
    return {};
  }
  if (ending != ".shp") {
    write_mesh(mesh, path);
    return {};
  }
  SimulationFrame frame;
  frame.origin = mass.centroid;
  frame.axes = mass.principal_axes;
  return write_rockable_shape(path, in_frame(mesh, frame), in_frame(mass, frame));
}

std::string fragments_csv(const Fragments& fragments, const std::vector<std::string>& files) {
  std::vector<int> contacts(fragments.list.size(), 0);
  for (const CommonWall& contact : fragments.contacts) {
    ++contacts[contact.first];
    ++contacts[contact.second];
  }
  std::string text =
      csv_record({"fragment", "file", "volume", "x", "y", "z", "qw", "qx", "qy", "qz",
                  "surface_area", "wall_area", "hull_excess_percent", "contacts"});
  for (std::size_t k = 0; k < fragments.list.size(); ++k) {
    const Fragment& fragment = fragments.list[k];
    std::vector<std::string> fields = {std::to_string(k + 1), files.at(k),
                                       format_exact(fragment.mass.volume)};
    append_exact(fields, fragment.mass.centroid);
    const Eigen::Quaterniond& q = fragment.mass.principal_axes;
    fields.push_back(format_exact(q.w()));
    append_exact(fields, q.vec());
    for (const double value :
         {fragment.surface_area, fragment.wall_area, fragment.hull_excess_percent}) {
      fields.push_back(format_exact(value));
    }
    fields.push_back(std::to_string(contacts[k]));
    text += csv_record(fields);
  }
  return text;
}

std::vector<double> volumes_of_fragments(const std::string& path) {
  InputFile table(path, MissingFile::IsEmpty);
  std::vector<double> volumes;
  for (const std::string& field : column_of(table, "volume")) {
    double& volume = volumes.emplace_back(0.0);
    std::from_chars(field.data(), field.data() + field.size(), volume);
  }
  return volumes;
}

std::string fragment_contacts_csv(const Fragments& fragments) {
  std::string text = csv_record({"first", "second", "area", "x", "y", "z", "nx", "ny", "nz"});
  for (const CommonWall& contact : fragments.contacts) {
    std::vector<std::string> fields = {std::to_string(contact.first + 1),
                                       std::to_string(contact.second + 1),
                                       format_exact(contact.area)};
    append_exact(fields, contact.centre);
    append_exact(fields, contact.normal);
    text += csv_record(fields);
  }
  return text;
}

std::vector<std::string> fragment_lines(const Fragments& fragments) {
  const double mean = fragments.grain.volume / static_cast<double>(fragments.list.size());
  double least = fragments.grain.volume;
  double most = 0.0;
  double squares = 0.0;
  double sum = 0.0;
  double hulls = 0.0;
  double largest_excess = 0.0;
  double walls = 0.0;
  for (const Fragment& fragment : fragments.list) {
    const double volume = fragment.mass.volume;
    least = std::min(least, volume);
    most = std::max(most, volume);
    squares += (volume - mean) * (volume - mean);
    sum += volume;
    hulls += 0.01 * fragment.hull_excess_percent * volume;
    largest_excess = std::max(largest_excess, fragment.hull_excess_percent);
    walls += 0.5 * fragment.wall_area;
  }
  const double variation = std::sqrt(squares / static_cast<double>(fragments.list.size())) / mean;
  std::vector<std::string> lines = {
      "Fragments: " + std::to_string(fragments.list.size()) + ", volumes " +
          format_number(least / mean, 3) + " to " + format_number(most / mean, 3) +
          " of their mean (coefficient of variation " + format_number(variation, 2) + "), sum " +
          format_number(100.0 * sum / fragments.grain.volume, 12) + " % of the grain's",
      "Walls: " + std::to_string(fragments.contacts.size()) + " contacts, area " +
          format_number(walls, 4) + " (" + format_number(100.0 * walls / fragments.grain.area, 3) +
          " % of the grain's surface)",
      "Convex hulls of the fragments: " + format_number(100.0 * hulls / fragments.grain.volume, 3) +
          " % more volume, at most " + format_number(largest_excess, 3) + " % of a fragment"};
  if (fragments.moved_pieces > 0) {
    lines.push_back("Cells in several pieces: " + std::to_string(fragments.moved_pieces) +
                    " pieces joined a neighbour, " + format_number(fragments.moved_percent, 2) +
                    " % of the grain's volume");
  }
  return lines;
}

}  // namespace wscvt
