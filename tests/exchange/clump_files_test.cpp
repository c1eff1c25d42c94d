// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/clump_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/holds.h"
#include "support/page_tables.h"
#include "support/test_shapes.h"
#include "wscvt/base/numbers.h"

namespace wscvt {
namespace {

using test::holds;

/// A clump whose grain is no sphere, turned and off the origin.
const ClumpResult& made_clump() {
  static const ClumpResult clump = [] {
    ClumpOptions options;
    options.sphere_count = 3;
    const IndexedMesh scan =
        test::moved(test::transformed(test::lumpy(3), test::random_rotation(3), Vector3::Zero()),
                    2.0, {5.0, 6.0, -7.0});
    return make_clump(scan, options, Execution(1));
  }();
  return clump;
}

class ClumpFiles : public test::FileFolder {
 protected:
  std::string written(const std::string& name, const FrameOptions& frame = {}) const {
    write_clump(path(name), made_clump(), frame);
    return content(name);
  }
};

/// The numbers of a text.
std::vector<double> numbers_of(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == '\n'; }, ' ');
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (double number = 0.0; stream >> number;) numbers.push_back(number);
  return numbers;
}

TEST_F(ClumpFiles, TableReadsBackToTheSameBits) {
  written("clump.csv");
  ASSERT_TRUE(is_clump_file(path("clump.csv")));
  const std::vector<Sphere> read = read_clump(path("clump.csv"));
  ASSERT_EQ(read.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(read[k].centre, made_clump().spheres[k].centre);
    EXPECT_EQ(read[k].radius, made_clump().spheres[k].radius);
  }
}

TEST_F(ClumpFiles, FrameAndSizeAreThoseOfTheGrain) {
  FrameOptions frame;
  frame.frame = Frame::Centred;
  frame.size = 10.0;
  written("clump.csv", frame);
  const double scale = 5.0 / made_clump().equivalent_radius;
  const std::vector<Sphere> read = read_clump(path("clump.csv"));
  const Sphere& first = made_clump().spheres[2];
  EXPECT_LT((read[2].centre - scale * (first.centre - made_clump().scan.centroid)).norm(), 1e-9);
  EXPECT_NEAR(read[2].radius, scale * first.radius, 1e-12);
}

TEST_F(ClumpFiles, EnginesGetPrincipalAxesAndTheGrainsMoments) {
  const SimulationFrame frame = simulation_frame(made_clump().scan, {Frame::Principal, 1.0, 0.0});
  const Sphere& last = made_clump().spheres[2];
  const Vector3 centre = frame.point(last.centre);
  const Vector3 moments = mass_properties(made_clump().scan).principal_moments;

  // As data/clumps/triangular_flat.csv of DEM-Engine: header, rows, comments.
  const std::string chrono = written("clump.chrono.csv");
  EXPECT_EQ(chrono.substr(0, 8), "x,y,z,r\n");
  const std::vector<Sphere> read = read_clump(path("clump.chrono.csv"));
  EXPECT_LT((read[2].centre - centre).norm(), 1e-12);
  EXPECT_TRUE(holds(chrono, "# volume = "));
  EXPECT_EQ(test::count_of(chrono.substr(8, chrono.find('\n', 8) - 8), ","), 3U);

  const std::vector<double> liggghts = numbers_of(written("clump.multisphere"));
  ASSERT_EQ(liggghts.size(), 12U);
  EXPECT_NEAR(liggghts[8], centre.x(), 1e-12);
  EXPECT_EQ(liggghts[11], last.radius);
  const std::string fix = content("clump.multisphere.in");
  EXPECT_TRUE(holds(fix, "nspheres 3 "));
  EXPECT_TRUE(holds(fix, "file \"clump.multisphere\" "));
  EXPECT_TRUE(holds(fix, "fix clump_clump all"));
  const double volume = mass_properties(made_clump().scan).volume;
  const std::pair<const char*, double> variables[] = {
      {"mass", volume}, {"xx", moments[0]}, {"yy", moments[1]}, {"zz", moments[2]}};
  for (const auto& [name, value] : variables) {
    const std::string begin = std::string("variable clump_") + name + " equal ${density}*";
    ASSERT_TRUE(holds(fix, begin));
    EXPECT_EQ(std::stod(fix.substr(fix.find(begin) + begin.size())), value) << name;
  }

  write_clump(path("clump.mclump"), made_clump(), {});
  const std::vector<double> mercury = numbers_of(content("clump.mclump/Clump/Clump.txt"));
  ASSERT_EQ(mercury.size(), 12U);
  EXPECT_NEAR(mercury[9], centre.y(), 1e-12);
  const std::vector<double> tensor = numbers_of(content("clump.mclump/Inertia/TOI.txt"));
  ASSERT_EQ(tensor.size(), 9U);
  EXPECT_EQ(tensor[8], moments[2]);
  EXPECT_EQ(numbers_of(content("clump.mclump/Inertia/PD.txt")),
            (std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1}));

  const std::string pfc = written("clump.p3dat");
  const std::size_t pebbles = pfc.find("pebbles 3 ...\n");
  ASSERT_NE(pebbles, std::string::npos) << pfc;
  // The radius first, as PFC's "pebbles" takes it.
  EXPECT_EQ(numbers_of(pfc.substr(pebbles + 14, 40)).front(), made_clump().spheres[0].radius);

  const std::string yade = written("clump.py");
  EXPECT_TRUE(holds(yade, "clumpTemplate(relRadii"));
}

/// The rows of a section of a LAMMPS molecule: number, then values.
std::vector<double> section_of(const std::string& molecule, const std::string& name) {
  const std::size_t at = molecule.find("\n" + name + "\n\n");
  if (at == std::string::npos) return {};
  const std::size_t begin = at + name.size() + 3;
  return numbers_of(molecule.substr(begin, molecule.find("\n\n", begin) - begin));
}

// A box, turned and off the origin: mass and moments by their closed forms, at a density.
TEST_F(ClumpFiles, MoleculeHasMassAndMomentsOfTheTurnedBox) {
  const Vector3 edges(3.0, 2.0, 0.5);
  ClumpOptions options;
  options.sphere_count = 4;
  const ClumpResult clump =
      make_clump(test::moved(test::transformed(test::box(edges.x(), edges.y(), edges.z()),
                                               test::random_rotation(7), Vector3::Zero()),
                             1.0, {4.0, -9.0, 2.0}),
                 options, Execution(1));
  FrameOptions frame;
  frame.scale = 2.0;
  const double density = 2650.0;
  write_clump(path("box.molecule"), clump, frame, density);
  const std::string text = content("box.molecule");

  const double mass = density * 8.0 * edges.prod();
  const Vector3 squares = 4.0 * edges.array().square();
  const std::vector<double> head = numbers_of(text.substr(text.find("\n\n") + 2));
  ASSERT_FALSE(head.empty());
  EXPECT_EQ(head.front(), 4.0);
  std::istringstream lines(text);
  std::string line;
  std::vector<double> masses, centre, inertia;
  while (std::getline(lines, line) && line != "Coords") {
    if (line.find(" mass") != std::string::npos && line.front() != '#') masses = numbers_of(line);
    if (line.find(" com") != std::string::npos) centre = numbers_of(line);
    if (line.find(" inertia") != std::string::npos) inertia = numbers_of(line);
  }
  ASSERT_EQ(masses.size(), 1U) << text;
  // Relative: sums over twelve triangles, of numbers ten times the box.
  EXPECT_NEAR(masses[0] / mass, 1.0, 1e-12);
  EXPECT_EQ(centre, (std::vector<double>{0, 0, 0}));
  ASSERT_EQ(inertia.size(), 6U);
  for (int k = 0; k < 3; ++k) {
    const double moment = mass / 12.0 * (squares.sum() - squares[k]);
    EXPECT_NEAR(inertia[k] / moment, 1.0, 1e-10);
    EXPECT_EQ(inertia[k + 3], 0.0);
  }

  const SimulationFrame to = simulation_frame(clump.scan, {Frame::Principal, 2.0, 0.0});
  const std::vector<double> places = section_of(text, "Coords");
  const std::vector<double> types = section_of(text, "Types");
  const std::vector<double> diameters = section_of(text, "Diameters");
  const std::vector<double> parts = section_of(text, "Masses");
  ASSERT_EQ(places.size(), 16U);
  ASSERT_EQ(types.size(), 8U);
  ASSERT_EQ(diameters.size(), 8U);
  ASSERT_EQ(parts.size(), 8U);
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Sphere& sphere = clump.spheres[k];
    EXPECT_EQ(places[4 * k], k + 1.0);
    EXPECT_LT(
        (Vector3(places[4 * k + 1], places[4 * k + 2], places[4 * k + 3]) - to.point(sphere.centre))
            .norm(),
        1e-12);
    EXPECT_EQ(types[2 * k + 1], 1.0);
    EXPECT_NEAR(diameters[2 * k + 1], 4.0 * sphere.radius, 1e-12);
    EXPECT_NEAR(parts[2 * k + 1] / parts[1], std::pow(sphere.radius / clump.spheres[0].radius, 3),
                1e-12);
    sum += parts[2 * k + 1];
  }
  EXPECT_NEAR(sum / mass, 1.0, 1e-12);
}

// LIGGGHTS refuses two templates with the same name, seed or type in one input.
TEST_F(ClumpFiles, TemplatesOfLiggghtsDifferByTheirNames) {
  const auto words = [&](const std::string& name) {
    written(name + ".multisphere");
    const std::string fix = content(name + ".multisphere.in");
    std::istringstream stream(fix.substr(fix.find("\nfix ")));
    std::string word, id, seed;
    stream >> word >> id >> word >> word >> seed;
    EXPECT_TRUE(holds(fix, " type ${clump_type} "));
    EXPECT_TRUE(holds(fix, "\nvariable clump_type equal ${clump_type}+1\n"));
    return std::make_pair(id, std::stoi(seed));
  };
  const auto [first, first_seed] = words("a grain-1");
  const auto [second, second_seed] = words("a grain-2");
  EXPECT_EQ(first, "clump_a_grain_1");
  EXPECT_EQ(second, "clump_a_grain_2");
  EXPECT_NE(first_seed, second_seed);
  for (const int seed : {first_seed, second_seed}) {
    EXPECT_GT(seed, 10000);
    EXPECT_EQ(next_prime(seed - 1), seed);
  }
}

TEST_F(ClumpFiles, OfOthersAreReadByTheirHeadingOrWithoutOne) {
  for (const char* text :
       {"0,0,0.5,1\n0.5,-1,0,0.9\n", "X,Y,Z,Radius\n0,0,0.5,1\n0.5,-1,0,0.9\n",
        "x;y;z;r\n0;0;0.5;1\n0.5;-1;0;0.9\n", "x y z r\n0 0 0.5 1\n0.5 -1 0 0.9\n",
        "\"x\",\"y\",\"z\",\"r\"\r\n0,0,0.5,1\r\n0.5,-1,0,0.9\r\n",
        "\xEF\xBB\xBFid,r,x,y,z\n1,1,0,0,0.5\n2,0.9,0.5,-1,0\n",
        "# x\ty\tz\tradius\n0\t0\t0.5\t1\n0.5\t-1\t0\t0.9\n",
        "x[mm],y[mm],z[mm],r[mm]\n0,0,0.5,1\n0.5,-1,0,0.9\n",
        "x,y,z,diameter\n0,0,0.5,2\n0.5,-1,0,1.8\n",
        "# clump\n\n# of 2\nx,y,z,r\n0,0,0.5,1\n0.5,-1,0,0.9\n",
        "# clump\n0,0,0.5,1\n0.5,-1,0,0.9\n", "x,y,z,r,diameter\n0,0,0.5,1,2\n0.5,-1,0,0.9,1.8\n",
        "diameter,radius,x,y,z\n2,1,0,0,0.5\n1.8,0.9,0.5,-1,0\n",
        "sep=;\nx [mm];y [mm];z [mm];r [um]\n0;0;0.5;1000\n0.5;-1;0;900\n",
        "x;y;z;r\n0;0;0,5;1,0\n0,5;-1;0;0,9\n", "0,0;0;0.5;1\n0,5;-1;0;0,9\n",
        "x[um] y[um] z[um] diameter[mm]\n0 0 0.5 0.002\n0.5 -1 0 0.0018\n"}) {
    SCOPED_TRACE(text);
    const std::string name = file("spheres.csv", text);
    EXPECT_TRUE(is_clump_file(name));
    const std::vector<Sphere> spheres = read_clump(name);
    ASSERT_EQ(spheres.size(), 2U);
    EXPECT_EQ(spheres[0].centre, Vector3(0, 0, 0.5));
    EXPECT_EQ(spheres[1].centre, Vector3(0.5, -1, 0));
    EXPECT_EQ(spheres[0].radius, 1.0);
    EXPECT_EQ(spheres[1].radius, 0.9);
  }
  for (const char* heading :
       {"x [mm],y [um],z [mm],r [mm]", "x [mm],y [mm],z [mm],r [px]", "x,y [mm],z [um],r [mm]"}) {
    const std::string units = test::refusal(ErrorCode::InvalidInput, [&] {
      read_clump(file("units.csv", std::string(heading) + "\n0,0,0.5,1\n"));
    });
    EXPECT_TRUE(holds(units, "columns in mm and in "));
  }
  const std::string sentence = test::refusal(
      ErrorCode::InvalidInput, [&] { read_clump(file("other.csv", "a,b,c,d\n1,2,3,4\n")); });
  EXPECT_TRUE(holds(sentence, "x, y, z and r"));
  EXPECT_FALSE(is_clump_file(file("points.xyz", "0 0 0 1\n")));
  // No mesh ends in .txt, so that the table is what is told to be wrong.
  for (const std::string& five : {file("five.txt", "0 0 0 1 7\n"), file("five.csv", "0,0,0,1,7")}) {
    EXPECT_TRUE(is_clump_file(five));
    EXPECT_TRUE(holds(test::refusal(ErrorCode::InvalidInput, [&] { read_clump(five); }),
                      "not a table of spheres"));
  }
  EXPECT_FALSE(is_clump_file(file("red.csv", "x,y,z,r,g,b\n0,0,0,1,2,3\n")));
  EXPECT_TRUE(has_sphere_heading(file("named.txt", "# clump\nx y z r\n0 0 0 1\n")));
  EXPECT_FALSE(has_sphere_heading(file("grey.txt", "0 0 0 1\n")));
  const std::string line = test::refusal(ErrorCode::InvalidInput, [&] {
    read_clump(file("bad.csv", "# clump\nx,y,z,r\n0,0,0,1\n0,0,0,-1\n"));
  });
  EXPECT_TRUE(holds(line, "Line 4"));
}

// The words are those of Kratos's public clusters; it reads numbers after them, line by line.
TEST_F(ClumpFiles, KratosHasTheGrainsVolumeAndInertiaPerUnitMass) {
  FrameOptions frame;
  frame.size = 2.0;
  const std::string text = written("my grain.clu", frame);
  const auto after = [&](const std::string& word) {
    const std::size_t begin = text.find(word + "\n");
    EXPECT_NE(begin, std::string::npos) << word;
    return numbers_of(text.substr(begin + word.size() + 1));
  };
  EXPECT_TRUE(holds(text, "Name\nmy grain\n"));
  const std::vector<double> spheres = after("Begin centers_and_radii");
  ASSERT_EQ(spheres.size(), 12U);
  const std::vector<double> volume = after("Volume");
  ASSERT_EQ(volume.size(), 1U);
  EXPECT_NEAR(volume[0], 4.0 / 3.0 * pi, 1e-9);
  const std::vector<double> inertia = after("Inertia per unit mass");
  ASSERT_EQ(inertia.size(), 3U);
  // A sphere of radius 1 has .4, and no body of its volume has less in the mean.
  EXPECT_GT(inertia[0] + inertia[1] + inertia[2], 1.2);
  const MassProperties grain = mass_properties(made_clump().scan);
  const double squared = std::pow(1.0 / made_clump().equivalent_radius, 2);
  EXPECT_NEAR(inertia[0], grain.principal_moments[0] / grain.volume * squared, 1e-9);
  // The ball about the centroid holds each sphere and touches one.
  const double size = after("Size").front();
  double reach = 0.0;
  for (std::size_t k = 0; k < 12; k += 4) {
    reach = std::max(reach,
                     Vector3(spheres[k], spheres[k + 1], spheres[k + 2]).norm() + spheres[k + 3]);
  }
  EXPECT_NEAR(size, 2.0 * reach, 1e-12);
  EXPECT_EQ(after("Particle_center_and_diameter").at(3), size);
}

TEST_F(ClumpFiles, WrongNamesAndContentsAreRefused) {
  EXPECT_ERROR(write_clump(path("clump.stl"), made_clump(), {}), InvalidInput);
  EXPECT_ERROR(write_clump(path("clump.molecule"), made_clump(), {}, 0.0), InvalidInput);
  EXPECT_TRUE(is_clump_name("a.CHRONO.CSV"));
  EXPECT_FALSE(is_clump_name(".csv"));
  EXPECT_FALSE(is_clump_file(file("other.csv", "x,y,z\n1,2,3\n")));
  EXPECT_ERROR(read_clump(path("none.csv")), InputOutput);
  EXPECT_ERROR(read_clump(file("empty.csv", "x,y,z,r\n")), InvalidInput);
  for (const char* row :
       {"1,2,3", "1,2,3,0", "1,2,3,-1", "1,2,nan,1", "1,2,3,4,5", "1,2,x,1", "1,2,\"3,5\",1"}) {
    const std::string name = file("bad.csv", std::string("x,y,z,r\n0,0,0,1\n") + row + "\n");
    const std::string sentence = test::refusal(ErrorCode::InvalidInput, [&] { read_clump(name); });
    EXPECT_TRUE(holds(sentence, "Line 3")) << row;
  }
}

}  // namespace
}  // namespace wscvt
