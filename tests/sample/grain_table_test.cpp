// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/grain_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <string>

#include "support/holds.h"
#include "toolbox/sample/grain_sample.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/text_format.h"

namespace wscvt {
namespace {

using test::holds;

class GrainTableTest : public ::testing::Test {
 protected:
  GrainTable read(const std::string& text) const {
    std::ofstream(path_, std::ios::binary) << text;
    return read_grain_table(path_);
  }
  /// The sentence that a table is refused with.
  std::string refusal(const std::string& text) const {
    try {
      read(text);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
      return error.what();
    }
    return "";
  }
  std::string path_ = ::testing::TempDir() + "/grain_table.csv";
};

TEST_F(GrainTableTest, ReadsNamesUnitsNumbersAndFiles) {
  const GrainTable table = read(
      "\xEF\xBB\xBFsize [mm],grain,note,ratio,file,void\r\n"
      "1.25,\"b, 1\",5 pores,0.5,b.ply,\r\n"
      " +2e-3 ,a,,NA,a.ply,\n"
      "nan,\"c\n2\",7,nan,c.ply,\n");
  EXPECT_EQ(table.grains, (std::vector<std::string>{"b, 1", "a", "c\n2"}));
  EXPECT_EQ(table.files, (std::vector<std::string>{"b.ply", "a.ply", "c.ply"}));
  ASSERT_EQ(table.columns.size(), 3U);  // a note is text, since the first one is
  EXPECT_EQ(table.columns[0].name, "size");
  EXPECT_EQ(table.columns[0].unit, "mm");
  EXPECT_EQ(heading_of(table.columns[0]), "size [mm]");
  EXPECT_EQ(heading_of(table.columns[1]), "ratio");
  ASSERT_EQ(table.values.rows(), 3);
  EXPECT_EQ(table.values(0, 0), 1.25);
  EXPECT_EQ(table.values(1, 0), 0.002);
  EXPECT_TRUE(std::isnan(table.values(2, 0)));
  EXPECT_EQ(table.values(0, 1), 0.5);
  EXPECT_TRUE(std::isnan(table.values(1, 1)) && std::isnan(table.values(2, 1)));
  EXPECT_TRUE(table.values.col(2).array().isNaN().all());
}

TEST_F(GrainTableTest, KnowsTheColumnsOfOtherPrograms) {
  const auto value = [](const GrainTable& table, const std::string& column) {
    return table.values(0, static_cast<Eigen::Index>(table.index_of(column)));
  };
  // A box of 2 x 3 x 4 by each program's definitions.
  const double volume = 24.0;
  const double area = 52.0;
  const double wadell = std::cbrt(36.0 * pi * volume * volume) / area;
  const GrainTable atlas = read(
      "Particle ID,Volume (\xC2\xB5m\xC2\xB3),Equivalent Diameter (\xC2\xB5m),Middle Axis Length "
      "(\xC2\xB5m),True Sphericity (-),Compactness (-)\n7,24,3.5789,3.5,0.83,0.58\n");
  EXPECT_EQ(atlas.grains, (std::vector<std::string>{"7"}));
  EXPECT_EQ(heading_of(atlas.columns[atlas.index_of("volume")]), "volume [um^3]");
  EXPECT_EQ(atlas.columns[atlas.index_of("sphericity_wadell")].unit, "");
  EXPECT_EQ(value(atlas, "axis_i_inertia"), 3.5);
  EXPECT_FALSE(atlas.find("compactness"));
  const GrainTable morpho =
      read("Label\tVolume\tSurfaceArea\tMeanBreadth\tSphericity\tElli.R2\n3\t24\t52\t4.5\t" +
           std::to_string(std::pow(wadell, 3)) + "\t1.75\n");
  EXPECT_EQ(morpho.grains, (std::vector<std::string>{"3"}));
  EXPECT_EQ(value(morpho, "area"), area);
  EXPECT_NEAR(value(morpho, "sphericity_wadell"), wadell, 1e-5);  // six decimals above
  // Of a box pi (a + b + c), and its mean breadth (a + b + c) / 2.
  EXPECT_NEAR(value(morpho, "mean_curvature_integral"), 9.0 * pi, 1e-12);
  EXPECT_EQ(value(morpho, "axis_i_inertia"), 3.5);
  const GrainTable shape = read("name,Volume,Surface_area,I_obb,Zingg_I_over_L\nb,24,52,3,0.75\n");
  EXPECT_EQ(value(shape, "axis_i_box"), 3.0);
  EXPECT_EQ(value(shape, "zingg_elongation_box"), 0.75);
  // A table of no program keeps its headings.
  EXPECT_TRUE(read("grain,Depth (mm3)\na,1\n").find("Depth (mm3)"));
}

/// Every column of a table, with its value in the first row.
std::map<std::string, double> first_row(const GrainTable& table) {
  std::map<std::string, double> row;
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    row[heading_of(table.columns[k])] = table.values(0, static_cast<Eigen::Index>(k));
  }
  return row;
}

TEST_F(GrainTableTest, TakesEachColumnOfOtherProgramsUnderItsName) {
  using Row = std::map<std::string, double>;
  EXPECT_EQ(
      first_row(read("Particle ID,Equivalent Diameter (mm),Major Axis Length (mm),Middle Axis "
                     "Length (mm),Minor Axis Length (mm),True Sphericity (-),Convexity "
                     "(-),Flatness (-),Elongation (-),Compactness (-)\n"
                     "7,3,4,2,1,0.875,0.75,0.5,0.25,0.125\n")),
      (Row{{"equivalent_diameter [mm]", 3.0},
           {"axis_l_inertia [mm]", 4.0},
           {"axis_i_inertia [mm]", 2.0},
           {"axis_s_inertia [mm]", 1.0},
           {"sphericity_wadell", 0.875},
           {"convexity", 0.75},
           {"zingg_flatness_inertia", 0.5},
           {"zingg_elongation_inertia", 0.25},
           {"compactness_of_area", 0.125}}));
  // Radii of an ellipsoid, whose axes are twice as long.
  EXPECT_EQ(first_row(read("Label,SurfaceArea,Elli.R1,Elli.R2,Elli.R3,InscrBall.Radius\n"
                           "3,52,4,2,1,0.75\n")),
            (Row{{"area", 52.0},
                 {"axis_l_inertia", 8.0},
                 {"axis_i_inertia", 4.0},
                 {"axis_s_inertia", 2.0},
                 {"inscribed_radius", 0.75}}));
  EXPECT_EQ(
      first_row(read("name,Surface_area,S_obb,I_obb,L_obb,Sphericity_Wadell,Convexity,Intercept_"
                     "Sphericity_Krumbein,Flatness_Kong_and_Fonseca_2018,Elongation_Kong_and_"
                     "Fonseca_2018,Zingg_S_over_I,Zingg_I_over_L\n"
                     "b,52,1,2,4,0.875,0.75,0.625,0.5,0.375,0.25,0.125\n")),
      (Row{{"area", 52.0},
           {"axis_s_box", 1.0},
           {"axis_i_box", 2.0},
           {"axis_l_box", 4.0},
           {"sphericity_wadell", 0.875},
           {"convexity", 0.75},
           {"krumbein_sphericity_box", 0.625},
           {"kong_fonseca_flatness_box", 0.5},
           {"kong_fonseca_elongation_box", 0.375},
           {"zingg_flatness_box", 0.25},
           {"zingg_elongation_box", 0.125}}));
}

TEST_F(GrainTableTest, RefusesMarksBetweenThousandsByRowAndField) {
  for (const char* field : {"\"1,000.5\"", "\"3,000\"", "\"1,234,567\"", "12 500", "1'000.25",
                            "1\xE2\x80\xAF"
                            "000",
                            "1\xC2\xA0"
                            "000,5"}) {
    SCOPED_TRACE(field);
    for (const std::string& rows :
         {std::string("a,") + field + "\nb,2\n", std::string("b,2\na,") + field + "\n"}) {
      if (rows.find("000,5") != std::string::npos) continue;  // needs another separator
      const std::string sentence = refusal("grain,volume [mm^3]\n" + rows);
      EXPECT_TRUE(holds(sentence, rows[0] == 'a' ? "line 2" : "line 3"));
      EXPECT_TRUE(holds(sentence, "volume"));
    }
  }
  for (const char* rows :
       {"a;1.000,5\nb;2,5\n", "a;1.000\nb;2,5\n", "b;2,5\na;1.234.567\n", "b;2,5\na;1 000,5\n"}) {
    EXPECT_TRUE(holds(refusal(std::string("grain;volume\n") + rows), "thousands")) << rows;
  }
  // Followed, it works; points alone are decimal points.
  EXPECT_EQ(read("grain,volume\na,1000.5\nb,2\n").values(0, 0), 1000.5);
  EXPECT_EQ(read("grain;volume\na;1.234\nb;2.5\n").values(0, 0), 1.234);
  EXPECT_EQ(read("grain;volume\na;1,234\nb;2,5\n").values(0, 0), 1.234);
  // Points at thousands only, beside whole numbers: 456 is not 456 times 1.660.
  EXPECT_TRUE(
      holds(refusal("grain;volume\na;1.660\nb;456\n"), "line 2: \"1.660\" may have a point"));
  EXPECT_EQ(read("grain,volume\na,1.660\nb,456\n").values(0, 0), 1.66);
  EXPECT_EQ(read("grain;volume\na;1.660\nb;456\nc;0.250\n").values(0, 0), 1.66);
}

TEST_F(GrainTableTest, NamesFilesAsTheyAre) {
  const std::string text = csv_record({"grain", "file", "volume"}) +
                           csv_record({"a", "-a.ply", "1"}) + csv_record({"b", "'-a.ply", "2"});
  EXPECT_EQ(read(text).files, (std::vector<std::string>{"-a.ply", "'-a.ply"}));
}

TEST_F(GrainTableTest, LeavesOutNoColumnOfADescriptorInSilence) {
  const std::string sentence = refusal("grain,volume,sphericity_wadell\na,1,80.2%\n");
  EXPECT_TRUE(holds(sentence,
                    "line 2: the column \"sphericity_wadell\" has \"80.2%\". Write fractions "
                    "of 1"));
  EXPECT_TRUE(holds(refusal("grain,volume\na,12 mm\n"), "\"volume [mm]\""));
  EXPECT_TRUE(holds(refusal("grain,volume,sphericity_wadell\na,1,1.7\n"), "at most 1"));
  // Names have no unit.
  const GrainTable unnamed = read("width [mm],volume\n1.5,1\n2.5,2\n");
  EXPECT_EQ(unnamed.grains, (std::vector<std::string>{"1", "2"}));
  EXPECT_EQ(unnamed.columns[0].name, "width");
  // What begins with a text is left out, and told if numbers follow.
  const GrainTable table = read(
      "grain,volume,roundness,form,id,empty\na,1,-,\"0,5\",A1,\nb,2,0.5,\"0,4\",NA,\n"
      "12,3,0.6,text,B2,\n");
  EXPECT_EQ(table.text_columns, (std::vector<std::string>{"roundness", "form", "id"}));
  EXPECT_EQ(table.mixed_columns, (std::vector<std::string>{"roundness", "form"}));
  SampleOptions options;
  options.size = SizeMeasure::EquivalentDiameter;
  EXPECT_TRUE(holds(sample_of(table, options).notes[0], "no number: roundness, form."));
}

TEST_F(GrainTableTest, KnowsTheUsualHeadings) {
  const GrainTable table = read(
      "Particle,Volume (mm\xC2\xB3),EquivalentDiameter (mm),Surface Area "
      "(mm\xC2\xB2)\nb,8,2.5,24\n\n"
      "c,1,1.2,6\n");
  EXPECT_EQ(table.grains, (std::vector<std::string>{"b", "c"}));
  EXPECT_EQ(heading_of(table.columns[table.index_of("volume")]), "volume [mm^3]");
  EXPECT_EQ(heading_of(table.columns[table.index_of("area")]), "area [mm^2]");
  EXPECT_EQ(table.values(1, static_cast<Eigen::Index>(table.index_of("equivalent_diameter"))), 1.2);
  EXPECT_TRUE(holds(refusal("\xFF\xFEg\n"), "UTF-16"));
}

TEST_F(GrainTableTest, KnowsWhatProgramsOnWindowsAndMacsWrite) {
  // Latin-1; as UTF-8 it is the same.
  const GrainTable latin = read("label,volume (\xB5m\xB3)\na,8\nb,1\n");
  EXPECT_EQ(heading_of(latin.columns[latin.index_of("volume")]), "volume [um^3]");
  EXPECT_TRUE(holds(refusal("label,volume\ra,8\rb,1\r"), "end by CR"));
  const std::string error = refusal("label,volume\na,#DIV/0!\nb,1\n");
  EXPECT_TRUE(holds(error, "line 2"));
  EXPECT_TRUE(holds(error, "an error of a spreadsheet"));
}

// By the isoperimetric inequality; 4.84 for a volume of 1.
TEST_F(GrainTableTest, RefusesLessAreaThanABallHas) {
  const std::string sentence = refusal("grain,volume,area\na,8,24\nb,1,2\n");
  EXPECT_TRUE(holds(sentence, "line 3: the area 2 is less than 4.836"));
  EXPECT_EQ(read("grain,volume,area\na,8,24\nb,1,4.6\nc,1,\nd,,1\n").grains.size(), 4U);
  // In other units it may be so.
  EXPECT_EQ(read("grain,volume [um^3],area [mm^2]\na,8e9,24\n").grains.size(), 1U);
}

TEST_F(GrainTableTest, KnowsTheTablesOfScikitImage) {
  const GrainTable table = read(
      "label,area,equivalent_diameter_area,axis_major_length,axis_minor_length,feret_diameter_max,"
      "solidity\n4,1250,13.4,20,10,21,0.9\n");
  EXPECT_EQ(first_row(table), (std::map<std::string, double>{{"area_or_volume", 1250.0},
                                                             {"equivalent_diameter", 13.4},
                                                             {"axis_l_inertia", 20.0},
                                                             {"axis_s_inertia", 10.0},
                                                             {"feret_max", 21.0},
                                                             {"convexity", 0.9}}));
  EXPECT_EQ(table.grains, (std::vector<std::string>{"4"}));
}

TEST_F(GrainTableTest, RowsWithoutNamesAreNumbered) {
  const GrainTable table = read("volume,sphericity\n24,0.8\n25,0.9\n");
  EXPECT_EQ(table.grains, (std::vector<std::string>{"1", "2"}));
  EXPECT_EQ(table.values(1, static_cast<Eigen::Index>(table.index_of("volume"))), 25.0);
}

TEST_F(GrainTableTest, RefusesValuesThatNoGrainHas) {
  for (const char* row : {"-3,1,0.9", "0,1,0.9", "inf,1,0.9", "nan,1,0.9", "1e999,1,0.9",
                          "3,-1,0.9", "3,1,1.2", "3,1,-0.1", "3,-inf,0.9"}) {
    const std::string sentence =
        refusal(std::string("grain,volume,axis_i_box,sphericity\na,1,1,0.9\nb,") + row + "\n");
    EXPECT_TRUE(holds(sentence, "line 3")) << row;
    EXPECT_TRUE(holds(sentence, "the column"));
  }
  // Other columns may be negative, and fields may be empty.
  EXPECT_EQ(read("grain,volume,curl\na,1,-2\nb,,3\n").values(0, 1), -2.0);
}

// Below the grains, ImageJ and spreadsheets write such rows, which were counted as grains.
TEST_F(GrainTableTest, RefusesRowsThatSumUpOthers) {
  for (const char* word : {"Total", "mean", " SD ", "Min", "Grand Total"}) {
    for (const std::string& row :
         {std::string(word) + ",,3\n", "3," + std::string(word) + ",3\n"}) {
      const std::string sentence = refusal("id,label,volume\n1,a,1\n2,b,2\n" + row);
      EXPECT_TRUE(holds(sentence, "line 4: the row has")) << row;
    }
  }
  EXPECT_EQ(read("id,label,volume\nMaximus,total sand,1\nb,x,2\n").grains.size(), 2U);
  EXPECT_TRUE(holds(refusal("# made by\nid,volume\n1,2\n"), "delete the comments"));
}

TEST_F(GrainTableTest, ReadsWhatSpreadsheetsWrite) {
  const std::string comma = "grain,size [mm],note\r\na,1.5,x\r\nb,-2e-1,y";
  for (const char* other : {"\xEF\xBB\xBFgrain;size [mm];note\r\na;1,5;x\r\nb;-2e-1;y\r\n",
                            "grain\tsize [mm]\tnote\na\t1,5\tx\nb\t-0.2\ty"}) {
    const GrainTable table = read(other);
    const GrainTable same = read(comma);  // its last row has no line break
    EXPECT_EQ(table.grains, same.grains);
    ASSERT_EQ(table.columns.size(), 1U);
    EXPECT_EQ(table.columns[0].unit, "mm");
    EXPECT_EQ(table.values, Eigen::Vector2d(1.5, -0.2));
    EXPECT_EQ(table.values, same.values);
    EXPECT_EQ(table.text_columns, std::vector<std::string>{"note"});
    EXPECT_TRUE(table.mixed_columns.empty());
  }
}

TEST_F(GrainTableTest, NamesAreTheFirstColumnIfNoneIsNamedGrain) {
  const GrainTable table = read("id,volume\n17,2\n4,3\n");
  EXPECT_EQ(table.grains, (std::vector<std::string>{"17", "4"}));
  EXPECT_EQ(table.columns.size(), 1U);
  EXPECT_TRUE(table.files.empty());
}

TEST_F(GrainTableTest, LeavesFailedRowsOut) {
  const GrainTable table = read("grain,status,v\na,done,1\nb,failed,\nc,done,3\n");
  EXPECT_EQ(table.grains, (std::vector<std::string>{"a", "c"}));
  EXPECT_EQ(table.failed, 1U);
  EXPECT_EQ(table.values(1, 0), 3.0);
}

TEST_F(GrainTableTest, ErrorsNameFileLineAndColumn) {
  // The second record has two lines.
  const std::string rows = "grain,v,w\n\"a\nb\",1,2\n";
  EXPECT_TRUE(holds(refusal(rows + "c,x,2\n"), path_ + "\", line 4: the column \"v\" has \"x\""));
  EXPECT_TRUE(holds(refusal(rows + "c,1\n"), "line 4: the row has 2 fields"));
  EXPECT_TRUE(holds(refusal(rows + "c,\"1,2\n"), "line 4: the file ends within"));
  EXPECT_TRUE(holds(refusal("grain,status,v\na,done,1"), "line 2: the file ends within"));
  for (const char* table : {"0,0,0,1\n.5,0,0,1\n", "12\n13\n", "1;2.5\n", "1,nan\n"}) {
    EXPECT_TRUE(holds(refusal(table), "line 1: the first line has numbers")) << table;
  }
  EXPECT_TRUE(holds(refusal("a,b,a [mm]\n"), "line 1: two columns are named \"a\""));
  EXPECT_TRUE(holds(refusal("a|b\n1|2\n"), "by commas"));
  EXPECT_TRUE(holds(refusal("grain,v\n"), "no row"));
  EXPECT_TRUE(holds(refusal("grain,v\na,b\n"), "no column"));
  EXPECT_TRUE(holds(refusal(""), "no table"));
  // A number that is only begun is none, "1.2.3" and "12 mm" among them.
  EXPECT_TRUE(holds(refusal("grain,v\na,1\nb,1.2.3\n"), "line 3"));
  try {
    read_grain_table(::testing::TempDir() + "/no/such/table.csv");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InputOutput);
  }
}

TEST_F(GrainTableTest, FindsColumnsAndNamesThoseThereAre) {
  const GrainTable table = read("grain,v,w\na,1,2\n");
  EXPECT_EQ(table.index_of("w"), 1U);
  EXPECT_EQ(table.find("grain"), std::nullopt);
  try {
    table.index_of("x");
    FAIL();
  } catch (const Error& error) {
    EXPECT_TRUE(holds(error.what(), "v, w."));
  }
}

TEST_F(GrainTableTest, UnderstandsUnitsAndTheLineOfSeparators) {
  for (const char* text :
       {"sep=;\r\ngrain;volume [mm\xC2\xB3];area (mm2);ratio\r\na;1,5;8;.5\r\n",
        "\xEF\xBB\xBFsep=\t\ngrain\tvolume\tarea\tratio\n\tmm^3\tmm\xC2\xB2\t-\na\t1.5\t8\t.5\n",
        "grain,volume,area,ratio\n,[mm^3],[mm^2],\na,1.5,8,.5\n"}) {
    const GrainTable table = read(text);
    ASSERT_EQ(table.grains, std::vector<std::string>{"a"}) << text;
    ASSERT_EQ(table.columns.size(), 3U) << text;
    EXPECT_EQ(heading_of(table.columns[0]), "volume [mm^3]") << text;
    EXPECT_EQ(heading_of(table.columns[1]), "area [mm^2]") << text;
    EXPECT_EQ(table.values(0, 0), 1.5);
    EXPECT_EQ(table.values(0, 2), 0.5);
  }
  const GrainTable atlas = read("Particle ID,Volume [\xC2\xB5m\xC2\xB3]\n1,20\n");
  EXPECT_EQ(heading_of(atlas.columns.at(0)), "volume [um^3]");
  EXPECT_EQ(read("grain,volume,unit\na,1,mm\nb,2,mm\n").grains.size(), 2U) << "no row of units";
  EXPECT_EQ(read("grain,volume,step\na,1,mm\nb,2,mm\n").grains.size(), 2U);
  EXPECT_TRUE(holds(refusal("grain,volume\na,1 mm3\n"), "heading: \"volume [mm3]\""));
  EXPECT_EQ(read("grain,volume,unit\na,1.5,mm\nb,2,mm\nc,2,\n").grains.size(), 3U);
  const std::string two = refusal("grain,volume,unit\na,1.5,mm\nb,200,\xC2\xB5m\n");
  EXPECT_TRUE(holds(two, "line 3"));
  EXPECT_TRUE(holds(two, "in um, but the rows above it are in mm"));
  EXPECT_TRUE(holds(refusal("sep=,\ngrain,volume\na,-1\n"), "line 3"));
  EXPECT_TRUE(holds(refusal("grain,mass,volume\na,1,1\nb,-2,2\n"), "line 3"));
}

TEST_F(GrainTableTest, RefusesGrainsThatCountTwice) {
  const std::string twice = refusal("grain,volume\na,1\nb,2\na ,1\n");
  EXPECT_TRUE(holds(twice, "line 4: the grain \"a \" has a row in line 2 too"));
  EXPECT_EQ(read("class,volume\na,1\nb,2\na,1\n").grains.size(), 3U) << "no names of grains";
  EXPECT_EQ(read("grain,volume\n,1\n,2\n").grains.size(), 2U) << "without names";
  EXPECT_EQ(read("grain,volume,status\na,,failed\na,1,done\n").grains.size(), 1U);
}

TEST_F(GrainTableTest, RefusesSectionsOfScikitImage) {
  const std::string head = "label,area,equivalent_diameter_area,solidity\n";
  const std::string disc = refusal(head + "4,1250,39.894,0.9\n");
  EXPECT_TRUE(holds(disc, "line 2: the equivalent diameter 39.89 is that of a disc"));
  EXPECT_EQ(read(head + "4,1250,13.365,0.9\n").grains.size(), 1U);
  EXPECT_TRUE(holds(refusal("label,area,equivalent_diameter\n1,1250,39.894\n"), "of a disc"));
  EXPECT_TRUE(
      holds(refusal("label,area,equivalent_diameter\n1,1250,13.365\n"), "Rename the column"));
  EXPECT_EQ(read("grain,area,equivalent_diameter\n1,700,13.365\n").grains.size(), 1U);
}

}  // namespace
}  // namespace wscvt
