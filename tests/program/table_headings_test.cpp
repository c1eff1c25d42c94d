// SPDX-License-Identifier: GPL-3.0-or-later
// The same spellings of units in the headings of all tables that the program reads.
#include <nlohmann/json.hpp>
#include <string>

#include "program_run.h"
#include "support/test_shapes.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

/// "NAME" stands for a column's name; all in micrometres. Micro signs are U+00B5, U+03BC, Latin-1.
const char* const spellings[] = {"NAME [um]",      "NAME(um)",         "NAME (\xc2\xb5m)",
                                 "\"NAME, um\"",   "NAME_um",          "NAME / \xce\xbcm",
                                 "NAME [\xb5m]",   "NAME [microns]",   "NAME [ UM ]",
                                 "\"NAME \xb5m\"", "NAME, [\xce\xbcm]"};

std::string spelled(std::string heading, const std::string& name, const std::string& power = "") {
  heading.replace(heading.find("NAME"), 4, name);
  const std::size_t end = heading.find_last_not_of(")]\" ");
  return heading.insert(end + 1, power);
}

class TableHeadings : public test::ProgramRun {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
};

TEST_F(TableHeadings, OfGrains) {
  for (const std::string heading : spellings) {
    const bool is_latin = heading.find("\xb5m") < heading.find('\xc2');
    for (const std::string power : {"^3", "3", is_latin ? "\xb3" : "\xc2\xb3"}) {
      for (const std::string name : {"volume", "Volume"}) {
        const std::string headings =
            "grain;" + spelled(heading, name, power) + ";" + spelled(heading, "axis_i_box") + "\n";
        SCOPED_TRACE(headings);
        write("t.csv", headings + "a;8,5;2\nb;27;3\nc;30;3,5\n");
        const Outcome outcome = run("sample t.csv -q --report r.json");
        ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
        const auto columns =
            nlohmann::json::parse(content("r.json")).at("samples").at(0).at("descriptors");
        EXPECT_EQ(columns.at("volume").at("unit"), "um^3");
        EXPECT_EQ(columns.at("axis_i_box").at("unit"), "um");
      }
    }
  }
  // A row of units, also below the headings of another program.
  write("t.csv", "Label,Volume,SurfaceArea\n,\xb5m\xb3,(\xb5m2)\n1,8,25\n2,27,60\n");
  ASSERT_EQ(run("sample t.csv -q --report r.json --diameter equivalent-diameter").exit_code, 0);
  const auto columns =
      nlohmann::json::parse(content("r.json")).at("samples").at(0).at("descriptors");
  EXPECT_EQ(columns.at("volume").at("unit"), "um^3");
  EXPECT_EQ(columns.at("area").at("unit"), "um^2");
}

TEST_F(TableHeadings, OfSpheresAndPoints) {
  const IndexedMesh scan = test::transformed(test::sphere(2), Vector3(3, 2, 1).asDiagonal());
  write_mesh(scan, path("scan.ply"));
  std::string points;
  for (const Vector3& p : scan.points) {
    points += format_exact(p.x()) + ";" + format_exact(p.y()) + ";" + format_exact(p.z()) + "\n";
  }
  std::string remeshed;
  for (const std::string heading : spellings) {
    const std::string xyz =
        spelled(heading, "x") + ";" + spelled(heading, "y") + ";" + spelled(heading, "z");
    SCOPED_TRACE(xyz);
    write("p.csv", xyz + "\n" + points);
    const Outcome cloud = run("remesh p.csv out.ply -n 40 --points -q");
    ASSERT_EQ(cloud.exit_code, 0) << cloud.errors;
    if (remeshed.empty()) remeshed = content("out.ply");
    EXPECT_EQ(content("out.ply"), remeshed);
    // Two units are refused in the same words.
    const std::string two = "columns in um and in cm, which are two units. Convert them to one.";
    const std::string mixed =
        spelled(heading, "x") + ";" + spelled(heading, "y") + ";z (centimetres)";
    write("c.csv", mixed + ";r\n0;0;0;1\n");
    write("p.csv", mixed + "\n" + points);
    expect_refused("describe", {{"c.csv scan.ply", 1, two}}, {});
    expect_refused("remesh", {{"p.csv o.ply -n 40 --points", 1, two}}, {"o.ply"});
  }
  // A radius may have another unit than the centre.
  const auto described = [&](const std::string& table) {
    write("c.csv", table);
    const Outcome outcome = run("describe c.csv scan.ply");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    return outcome.output.substr(0, outcome.output.find("Time"));
  };
  EXPECT_EQ(described("x_um;\"y [\xb5m]\";z / microns;r, mm\n-1;0;0;0.001\n1;0.3;0.2;0.0015\n"),
            described("x,y,z,r\n-1,0,0,1\n1,0.3,0.2,1.5\n"));
}

TEST_F(TableHeadings, OfSizes) {
  write_mesh(test::sphere(1), path("scan.ply"));
  const std::string call = "clump scan.ply -k 1 --engine lammps --size-curve curve.csv -o ";
  for (const std::string heading : spellings) {
    SCOPED_TRACE(heading);
    write("curve.csv", "sieve;" + spelled(heading, "aperture") + "\n0,5;0\n2;100\n");
    expect_refused(call + "out", {{"", 2, "a length in the second column"}}, {"out"});
  }
  // "Cumulative" has no unit, and a cell of a spreadsheet may have two lines.
  for (const char* text : {"\"Sieve\nmm\";Cumulative passing\n;\n0,5;0\n2;100",
                           "Sieve, mm\tPassing, %\n.5\t0\n2\t100\n",
                           "Sand of the river\n\"Sieve, mm\",Finer\n\xb5m,[%]\n0.5,0\n2,100\n"}) {
    write("curve.csv", text);
    std::filesystem::remove_all(folder_ / "out");
    const Outcome outcome = run(call + "out");
    EXPECT_EQ(outcome.exit_code, 0) << text << outcome.errors;
    EXPECT_EQ(content("out/sizes.csv"),
              "equivalent_diameter [length],finer_by_mass [%]\r\n0.5,0\r\n2,100\r\n");
  }
  write("curve.csv", "sieve,finer\n<0.5,0\n1,50\n2,100\n");
  expect_refused(call + "new", {{"", 2, "Line 2"}}, {"new"});
}

}  // namespace
}  // namespace wscvt
