// SPDX-License-Identifier: GPL-3.0-or-later
// The program on the tables of samples.
#include <nlohmann/json.hpp>
#include <string>

#include "program_run.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using Document = nlohmann::ordered_json;
using test::holds;

class Sample : public test::ProgramRun {
 protected:
  /// A table of ten grains, of sizes from `first` on.
  void write_table(const std::string& name, double first) const {
    std::ofstream table(folder_ / name);
    table << "grain,volume [mm^3],axis_i_box [mm],feret_max [mm]\r\n";
    for (int k = 0; k < 10; ++k) {
      const double size = first + k;
      table << "g" << k << "," << size * size * size << "," << size << "," << 2 * size << "\r\n";
    }
  }
};

TEST_F(Sample, IsOfABatchsFolderOrATable) {
  fs::create_directory(folder_ / "scans");
  for (int k = 0; k < 3; ++k) {
    const Vector3 axes(1.0, 0.9 - 0.1 * k, 0.6);
    write_mesh(test::transformed(test::sphere(2), axes.asDiagonal()),
               path("scans/" + std::to_string(k) + ".ply"));
  }
  ASSERT_EQ(run("batch scans -o out -q -n 40,30 --describe contacts").exit_code, 0);
  const Outcome outcome = run("sample out --report page.html --report all.json --max-error 20");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  EXPECT_EQ(outcome.output.rfind("out: 3 grains\n", 0), 0U) << outcome.output;
  EXPECT_TRUE(holds(outcome.output, "N for 20 %"));
  EXPECT_TRUE(holds(outcome.output, "contact_error_mean"));
  const Document all = Document::parse(content("all.json"));
  // The second largest axis of the ellipsoids: 1.8, 1.6, 1.4.
  const Document& size = all.at("samples").at(0).at("size").at("by_number");
  EXPECT_NEAR(size.at("D50").at("value").get<double>(), 1.6, 0.03);
  EXPECT_EQ(all.at("levels").at("descriptors").at("rms_distance").at("errors").size(), 2U);
  // Fewer nodes have larger contact errors. The three ellipsoids are of one kind.
  const Document& contact =
      all.at("levels").at("descriptors").at("contact_error_scatter").at("errors");
  EXPECT_GT(contact.at(0).at("median_percent"), contact.at(1).at("median_percent"));
  EXPECT_TRUE(holds(content("page.html"), "\"0\":\"data:image/png"));
  EXPECT_EQ(run("sample out -q --report all.csv").exit_code, 0);
  EXPECT_TRUE(
      holds(content("all.csv"), "\r\nout,contact_error_mean,%,number,error_percent_90_n40,"));
  // A level is a sample of its own.
  EXPECT_EQ(run("sample out/n30 -q --report one.csv --describe remesh").exit_code, 0);
  EXPECT_EQ(run("sample out/n30/shape.csv -q --report two.csv --describe remesh -t 1").exit_code,
            0);
  EXPECT_EQ(content("one.csv"), content("two.csv"));
  EXPECT_TRUE(holds(content("one.csv"), "n30,volume,length^3,mass,mean,"));
}

TEST_F(Sample, TwoAreCompared) {
  write_table("a.csv", 3.0);
  write_table("b.csv", 3.5);
  const Outcome outcome =
      run("sample a.csv b.csv --diameter feret-max --report c.json --density 2");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const Document all = Document::parse(content("c.json"));
  EXPECT_EQ(all.at("samples").at(1).at("name"), "b.csv");
  // Sizes are twice the table's axis: 0.5 there is 1 here, and 0.1 of the grains.
  const Document& size = all.at("comparison").at("size").at("by_number");
  EXPECT_NEAR(size.at("wasserstein").get<double>(), 1.0, 1e-12);
  EXPECT_NEAR(size.at("kolmogorov_smirnov").get<double>(), 0.1, 1e-12);
  EXPECT_GT(size.at("kolmogorov_smirnov_p").get<double>(), 0.5);
  EXPECT_NEAR(all.at("samples").at(0).at("mass").get<double>(), 2.0 * (78.0 * 78.0 - 9.0), 1e-9);
  // The seed and nothing else decides the last bits.
  ASSERT_EQ(run("sample a.csv b.csv -q --diameter feret-max --report d.json --density "
                "2 --seed 1")
                .exit_code,
            0);
  EXPECT_EQ(content("d.json"), content("c.json"));
  run("sample a.csv b.csv -q --diameter feret-max --report d.json --density 2 --seed "
      "7");
  EXPECT_NE(content("d.json"), content("c.json"));
}

TEST_F(Sample, ADensityPerSampleGivesTheMasses) {
  write_table("a.csv", 3.0);
  write_table("b.csv", 3.0);
  ASSERT_EQ(run("sample a.csv b.csv -q --density 2,5 --report c.json").exit_code, 0);
  const Document all = Document::parse(content("c.json"));
  const double volume = 78.0 * 78.0 - 9.0;
  EXPECT_NEAR(all.at("samples").at(0).at("mass").get<double>(), 2.0 * volume, 1e-9);
  EXPECT_NEAR(all.at("samples").at(1).at("mass").get<double>(), 5.0 * volume, 1e-9);
  EXPECT_EQ(all.at("samples").at(1).at("density"), 5.0);
}

TEST_F(Sample, RefusesWhatIsNone) {
  write_table("a.csv", 3.0);
  fs::create_directory(folder_ / "empty");
  fs::create_directory(folder_ / "meshes");
  write_mesh(test::sphere(1), path("meshes/a.stl"));
  std::ofstream(folder_ / "units.csv") << "grain,axis_i_box,e\na,1 mm,1\nb,2 mm,2\n";
  std::ofstream(folder_ / "numbers.csv") << "grain,d,e\na,1,2\nb,2,3\n";
  expect_refused("sample",
                 {{"", 2, "samples"},
                  {"a.csv --report bad.pdf", 2, "bad.pdf"},
                  {"a.csv --report a.csv", 2, "a.csv"},
                  {"a.csv --density 0", 2, "density"},
                  {"a.csv --density 2,3", 2, "one per sample"},
                  {"a.csv a.csv --density 2,x", 2, "density"},
                  {"a.csv --diameter feret-min", 1, "feret_min"},
                  {"empty", 1, "shape.csv"},
                  {"meshes", 1, "wscvt batch meshes -o"},
                  {"meshes/a.stl", 1, "wscvt batch"},
                  {"units.csv", 1, "axis_i_box [mm]"},
                  {"numbers.csv", 1, "numeric columns: d, e."},
                  {"no.csv", 1, "no.csv"}},
                 {"bad.pdf"});
}

TEST_F(Sample, NamesASizeThatAnotherProgramsTableHas) {
  // Volumes of balls of 1, 2 and 3; MorphoLibJ has no box.
  std::ofstream(folder_ / "morpho.csv") << "Label,Volume,SurfaceArea,Sphericity\n1,4.18879,12.6,1\n"
                                           "2,33.5103,50.3,1\n3,113.097,113,1\n";
  expect_refused("sample", {{"morpho.csv", 1, "--diameter equivalent-diameter"}}, {});
  const Outcome outcome = run("sample morpho.csv --diameter equivalent-diameter");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_TRUE(holds(outcome.output, "Sizes are from the column \"volume\"")) << outcome.errors;
}

}  // namespace
}  // namespace wscvt
