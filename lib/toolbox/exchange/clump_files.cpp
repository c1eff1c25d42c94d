// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/clump_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include "wscvt/base/error.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/table_heading.h"
#include "wscvt/mesh_files/text_fields.h"
#include "wscvt/mesh_files/text_writers.h"
#include "wscvt/report/report.h"

namespace wscvt {

namespace {

/// A clump in the frame of a file.
struct FramedClump {
  std::vector<Sphere> spheres;
  MassProperties mass;  ///< the grain's
};

FramedClump in_frame(const ClumpResult& clump, const FrameOptions& options) {
  const SimulationFrame frame = simulation_frame(clump.scan, options);
  FramedClump framed;
  for (const Sphere& sphere : clump.spheres) {
    framed.spheres.push_back({frame.point(sphere.centre), frame.scale * sphere.radius});
  }
  framed.mass = in_frame(mass_properties(clump.scan), frame);
  return framed;
}

std::string rows_of(const std::vector<Sphere>& spheres, const char* between) {
  std::string text;
  for (const Sphere& sphere : spheres) {
    text += vector_text(sphere.centre, between) + between + format_exact(sphere.radius) + "\n";
  }
  return text;
}

std::string name_of(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

/// Returns the name of a fix in LIGGGHTS, which may have letters, digits and underscores.
std::string liggghts_name(const std::string& path) {
  std::string name = "clump_" + name_of(path);
  name.resize(name.size() - std::string(".multisphere").size());
  for (char& c : name) {
    const bool is_kept = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    if (!is_kept) c = '_';
  }
  return name;
}

/// Returns a prime above 10,000 that differs between names: LIGGGHTS refuses two templates with one
/// seed.
int liggghts_seed(const std::string& name) {
  std::uint32_t hash = 2166136261U;  // FNV-1a
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return next_prime(10000 + static_cast<int>(hash % 1000000000U));
}

std::string liggghts_fix(const FramedClump& clump, const std::string& path) {
  const std::string name = liggghts_name(path);
  std::string moments;
  for (Eigen::Index k = 0; k < 3; ++k) {
    moments += std::string("variable clump_") + std::string(2, "xyz"[k]) + " equal ${density}*" +
               format_exact(clump.mass.principal_moments[k]) + "\n";
  }
  return "# Made by " + made_by() +
         ". Mass and tensor of inertia are the grain's, at unit density times\n"
         "# the variable density. Each such file counts clump_type up. Before the first write:\n"
         "#   variable density equal 2500\n#   variable clump_type equal 1\n"
         "variable clump_mass equal ${density}*" +
         format_exact(clump.mass.volume) + "\n" + moments + "fix " + name +
         " all particletemplate/multisphere " + std::to_string(liggghts_seed(name)) +
         " atom_type 1 density constant ${density} nspheres " +
         std::to_string(clump.spheres.size()) + " ntry 100000 spheres file \"" + name_of(path) +
         "\" scale 1.0 type ${clump_type} mass ${clump_mass} inertia_tensor ${clump_xx} 0 0 "
         "${clump_yy} 0 ${clump_zz} use_density\nvariable clump_type equal ${clump_type}+1\n";
}

std::string yade_script(const FramedClump& clump) {
  std::string spheres;
  for (const Sphere& sphere : clump.spheres) {
    spheres +=
        "    ((" + vector_text(sphere.centre, ", ") + "), " + format_exact(sphere.radius) + "),\n";
  }
  return "# Made by " + made_by() +
         ". A clump for Yade: import this file in a script of Yade's.\n"
         "# Coordinates are the grain's principal axes about its centroid; mass and moments are "
         "the\n"
         "# grain's at unit density.\n"
         "from yade import O, Matrix3, Quaternion, Vector3, utils\n\n"
         "volume = " +
         format_exact(clump.mass.volume) + "\nmoments = (" +
         vector_text(clump.mass.principal_moments, ", ") + ")\nspheres = [\n" + spheres +
         "]\n\n"
         "# For O.bodies.replaceByClumps, which takes mass and inertia from the spheres.\n"
         "template = utils.clumpTemplate(relRadii=[r for c, r in spheres], relPositions=[c for c, "
         "r in "
         "spheres])\n\n\n"
         "def add(position=(0, 0, 0), orientation=None, material=-1, density=2650.0):\n"
         "    \"\"\"Adds a clump with the grain's mass and moments; its number, and those of its "
         "spheres. Yade\n"
         "    keeps the centre of mass of the spheres.\"\"\"\n"
         "    turn = orientation if orientation is not None else Quaternion(1, 0, 0, 0)\n"
         "    bodies = [utils.sphere(Vector3(position) + turn * Vector3(c), r, material=material) "
         "for "
         "c, r in spheres]\n"
         "    number, members = O.bodies.appendClumped(bodies, discretization=0)\n"
         "    state = O.bodies[number].state\n"
         "    state.mass = density * volume\n"
         "    to_grain = (turn.conjugate() * state.ori).toRotationMatrix()\n"
         "    tensor = Matrix3(moments[0], 0, 0, 0, moments[1], 0, 0, 0, moments[2])\n"
         "    turned = to_grain.transpose() * tensor * to_grain\n"
         "    state.inertia = density * Vector3(turned[0, 0], turned[1, 1], turned[2, 2])\n"
         "    return number, members\n";
}

std::string chrono_table(const FramedClump& clump) {
  return "x,y,z,r\n" + rows_of(clump.spheres, ",") +
         "# volume = " + format_exact(clump.mass.volume) +
         "\n# Ixx, yy, zz = " + vector_text(clump.mass.principal_moments, ", ") + "\n# made by " +
         made_by() + "; mass is density times volume, moments are density times Ixx, yy, zz\n";
}

std::string pfc_command(const FramedClump& clump, const std::string& path) {
  std::string name = name_of(path);
  name.resize(name.size() - std::string(".p3dat").size());
  std::replace(name.begin(), name.end(), '\'', '_');
  std::string text = "; made by " + made_by() + "; mass properties are the grain's\n" +
                     "clump template create ...\n  name '" + name + "' ...\n  pebbles " +
                     std::to_string(clump.spheres.size()) + " ...\n";
  for (const Sphere& sphere : clump.spheres) {
    text += "    " + format_exact(sphere.radius) + " " + vector_text(sphere.centre) + " ...\n";
  }
  return text + "  volume " + format_exact(clump.mass.volume) + " ...\n  inertia " +
         vector_text(clump.mass.principal_moments) + " 0 0 0\n";
}

/// Returns a cluster of Kratos's DEM application. Its mesher takes the ball about the cluster.
std::string kratos_cluster(const FramedClump& clump, const std::string& path) {
  double reach = 0.0;
  for (const Sphere& sphere : clump.spheres) {
    reach = std::max(reach, sphere.centre.norm() + sphere.radius);
  }
  const Vector3 per_mass = clump.mass.principal_moments / clump.mass.volume;
  const std::string size = format_exact(2.0 * reach);
  return "// made by " + made_by() + "; volume and inertia are the grain's\n\nName\n" +
         std::filesystem::path(path).stem().string() + "\n\nBegin centers_and_radii\n" +
         rows_of(clump.spheres, " ") +
         "End centers_and_radii\n\nParticle_center_and_diameter\n0 0 0 " + size + "\n\nSize\n" +
         size + "\n\nVolume\n" + format_exact(clump.mass.volume) + "\n\nInertia per unit mass\n" +
         vector_text(per_mass, "\n") + "\n";
}

/// LAMMPS adds the masses of atoms for the energies that it prints, but uses the body's mass and
/// moments from the head of the file.
std::string lammps_molecule(const FramedClump& clump, double density) {
  const std::vector<Sphere>& spheres = clump.spheres;
  double cubes = 0.0;
  for (const Sphere& sphere : spheres) cubes += portable::pow(sphere.radius, 3);
  const double mass = density * clump.mass.volume;
  std::string coordinates, types, diameters, masses;
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const std::string number = std::to_string(k + 1) + " ";
    coordinates += number + vector_text(spheres[k].centre) + "\n";
    types += number + "1\n";
    diameters += number + format_exact(2.0 * spheres[k].radius) + "\n";
    masses += number + format_exact(mass * portable::pow(spheres[k].radius, 3) / cubes) + "\n";
  }
  const Vector3 tensor = density * clump.mass.principal_moments;
  return "# made by " + made_by() + "; mass and moments are the grain's, density " +
         format_exact(density) + "\n\n" + std::to_string(spheres.size()) + " atoms\n" +
         format_exact(mass) + " mass\n0 0 0 com\n" + vector_text(tensor) +
         " 0 0 0 inertia\n\nCoords\n\n" + coordinates + "\nTypes\n\n" + types + "\nDiameters\n\n" +
         diameters + "\nMasses\n\n" + masses;
}

/// Writes the format of MercuryDPM's Clump driver; readers before 2024 need these names in small
/// letters.
void write_mercury(const std::string& path, const FramedClump& clump) {
  const std::filesystem::path folder(path);
  std::error_code error;
  for (const char* part : {"Clump", "Inertia"}) {
    std::filesystem::create_directories(folder / part, error);  // writing reports errors
  }
  const Vector3& m = clump.mass.principal_moments;
  write_file((folder / "Clump/Clump.txt").string(), rows_of(clump.spheres, ","));
  write_file((folder / "Inertia/Mass.txt").string(), format_exact(clump.mass.volume) + "\n");
  write_file((folder / "Inertia/TOI.txt").string(), vector_text({m[0], 0, 0}, ",") + "\n" +
                                                        vector_text({0, m[1], 0}, ",") + "\n" +
                                                        vector_text({0, 0, m[2]}, ",") + "\n");
  write_file((folder / "Inertia/PD.txt").string(), "1,0,0\n0,1,0\n0,0,1\n");
}

/// Returns the longest matching ending; empty if there is none.
std::string clump_ending(const std::string& path) {
  const std::string lower = lower_case(path);
  std::string found;
  for (const std::string ending :
       {".csv", ".multisphere", ".py", ".chrono.csv", ".mclump", ".p3dat", ".molecule", ".clu"}) {
    const bool fits =
        lower.size() > ending.size() && std::equal(ending.rbegin(), ending.rend(), lower.rbegin());
    if (fits && ending.size() > found.size()) found = ending;
  }
  return found;
}

}  // namespace

bool is_clump_name(const std::string& path) { return !clump_ending(path).empty(); }

void check_clump_path(const std::string& path) {
  if (is_clump_name(path)) return;
  refuse("\"" + path +
         "\" does not have the ending of a clump format. Give a name that ends in .csv, "
         ".multisphere (LIGGGHTS), .py (Yade), .chrono.csv (Chrono DEM-Engine), .mclump "
         "(MercuryDPM), .p3dat (PFC), .molecule (LAMMPS) or .clu (Kratos).");
}

std::vector<std::string> files_of_clump(const std::string& path) {
  const std::string ending = clump_ending(path);
  if (ending == ".multisphere") return {path, path + ".in"};
  if (ending == ".mclump") {
    return {path + "/Clump/Clump.txt", path + "/Inertia/Mass.txt", path + "/Inertia/TOI.txt",
            path + "/Inertia/PD.txt"};
  }
  return {path};
}

void write_clump(const std::string& path, const ClumpResult& clump, const FrameOptions& frame,
                 double density) {
  check_clump_path(path);
  require_in_range(density, clump_density_option);
  const std::string ending = clump_ending(path);
  FrameOptions used = frame;
  if (ending != ".csv") used.frame = Frame::Principal;
  const FramedClump framed = in_frame(clump, used);
  if (ending == ".csv") {
    write_file(path, "x,y,z,r\n" + rows_of(framed.spheres, ","));
  } else if (ending == ".multisphere") {
    write_file(path, rows_of(framed.spheres, " "));
    write_file(path + ".in", liggghts_fix(framed, path));
  } else if (ending == ".py") {
    write_file(path, yade_script(framed));
  } else if (ending == ".chrono.csv") {
    write_file(path, chrono_table(framed));
  } else if (ending == ".mclump") {
    write_mercury(path, framed);
  } else if (ending == ".molecule") {
    write_file(path, lammps_molecule(framed, density));
  } else if (ending == ".clu") {
    write_file(path, kratos_cluster(framed, path));
  } else {
    write_file(path, pfc_command(framed, path));
  }
}

namespace {

/// Longest line of a table of spheres that is looked at.
constexpr std::size_t longest_line = 1000;

/// Reads a line without its end.
bool next_line(std::istream& stream, std::string& line) {
  line.clear();
  for (char c = 0; stream.get(c) && c != '\n';) {
    if (line.size() > longest_line) return false;
    line += c;
  }
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return !line.empty() || !stream.eof();
}

/// Columns of x, y, z and the radius.
struct SphereColumns {
  std::array<std::size_t, 4> of{};
  std::size_t count = 0;      ///< of all columns
  bool has_diameter = false;  ///< in the place of the radius
  bool has_heading = true;
  double radius_unit = 1.0;  ///< nanometres, or 1 with centre_unit
  double centre_unit = 1.0;
  std::string unit_fault;  ///< why the heading's units make no sense; empty: they do
};

/// Sets what the units of a heading mean. The radius may have another unit than the centre.
void read_units(const std::vector<TableHeading>& headings, SphereColumns& columns) {
  const auto unit = [&](std::size_t k) { return headings[columns.of[k]].unit; };
  const CommonUnit centre = common_unit({unit(0), unit(1), unit(2)});
  const CommonUnit all = common_unit({centre.unit, unit(3)});
  const double of_centre = nanometres(centre.unit);
  const double of_radius = nanometres(unit(3));
  columns.unit_fault = centre.fault;
  if (all.fault.empty() || !centre.fault.empty()) return;
  if (of_centre * of_radius == 0.0) columns.unit_fault = all.fault;
  columns.centre_unit = of_centre;
  columns.radius_unit = of_radius;
}

/// Returns nothing if the first line is no heading of spheres and not four numbers or more.
std::optional<SphereColumns> columns_of(const std::string& first_line) {
  const std::vector<TableHeading> headings = read_headings(first_line);
  SphereColumns columns;
  columns.count = headings.size();
  std::size_t numbers = 0;
  std::array<int, 4> found{};
  int diameters = 0;
  for (std::size_t k = 0; k < headings.size(); ++k) {
    const std::string name = lower_case(headings[k].name);
    if (number_in_row(name, first_line)) ++numbers;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string letter(1, "xyz"[axis]);
      if (name == letter || name == "c" + letter || name == "center_" + letter ||
          name == "centre_" + letter || name == "pos" + letter || name == letter + "c") {
        columns.of[axis] = k;
        ++found[axis];
      }
    }
    if (name == "g" || name == "green") return {};  // beside it r is red
    if (name == "r" || name == "radius" || name == "rad") {
      columns.of[3] = k;
      ++found[3];
    } else if (name == "d" || name == "diameter") {
      if (found[3] == 0) columns.of[3] = k;
      ++diameters;
    }
  }
  if (found[3] == 0) {
    columns.has_diameter = true;
    found[3] = diameters;
  }
  if (found == std::array<int, 4>{1, 1, 1, 1}) {
    read_units(headings, columns);
    return columns;
  }
  if (numbers < 4 || headings.size() != numbers) return {};
  columns.of = {0, 1, 2, 3};
  columns.has_heading = false;
  columns.has_diameter = false;
  return columns;
}

/// Reads up to the line that tells the columns, behind comments that do not; `number`: of the line.
std::optional<SphereColumns> next_columns(std::istream& stream, std::string& line,
                                          std::size_t& number) {
  constexpr std::size_t most_comments = 100;
  for (number = 1; number <= most_comments && next_line(stream, line); ++number) {
    std::optional<SphereColumns> columns = columns_of(line);
    if (columns || (!line.empty() && line.front() != '#' && !names_separator(line))) {
      return columns;
    }
  }
  return {};
}

std::optional<SphereColumns> columns_in(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  std::ifstream stream(path, std::ios::binary);
  std::string line;
  std::size_t number = 0;
  return next_columns(stream, line, number);
}

}  // namespace

bool has_sphere_heading(const std::string& path) {
  const std::optional<SphereColumns> columns = columns_in(path);
  return columns && columns->has_heading;
}

bool is_clump_file(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".txt") return true;
  const std::optional<SphereColumns> columns = columns_in(path);
  return columns && (columns->has_heading || ending == ".csv" || ending == ".multisphere");
}

std::vector<Sphere> read_clump(const std::string& path) {
  InputFile stream(path);
  std::string line;
  std::size_t number = 0;
  const std::optional<SphereColumns> columns = next_columns(stream, line, number);
  if (!columns || (!columns->has_heading && columns->count != 4)) {
    refuse("\"" + path +
           "\" is not a table of spheres. Its first line must name the columns x, y, z and r (or "
           "radius, or diameter), or be four numbers: x, y, z and the radius.");
  }
  if (!columns->unit_fault.empty()) refuse("\"" + path + "\" " + columns->unit_fault);
  std::vector<Sphere> spheres;
  std::vector<std::string_view> fields;
  bool is_read_already = !columns->has_heading;
  if (!is_read_already) ++number;
  for (; is_read_already || next_line(stream, line); ++number) {
    is_read_already = false;
    if (line.empty() || line.front() == '#') continue;
    split_fields(line, fields);
    std::array<double, 4> values{};
    bool is_read = fields.size() == columns->count;
    for (std::size_t k = 0; k < values.size() && is_read; ++k) {
      const std::optional<double> value = number_in_row(fields[columns->of[k]], line);
      is_read = value && std::isfinite(*value);
      if (is_read) values[k] = *value;
    }
    if (!is_read || !(values[3] > 0.0)) {
      refuse("Line " + std::to_string(number) + " of \"" + path +
             "\" is not x,y,z,r with a radius above 0.");
    }
    if (columns->has_diameter) values[3] *= 0.5;
    values[3] = values[3] * columns->radius_unit / columns->centre_unit;
    spheres.push_back({Vector3(values[0], values[1], values[2]), values[3]});
  }
  if (spheres.empty()) refuse("\"" + path + "\" contains no sphere.");
  return spheres;
}

}  // namespace wscvt
