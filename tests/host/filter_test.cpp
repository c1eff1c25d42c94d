// SPDX-License-Identifier: GPL-3.0-or-later
// The plugin as it was built, loaded into this process, which plays the host.
#include <gtest/gtest.h>

#include <QApplication>
#include <QFile>
#include <QFileInfo>
#include <QImage>
#include <QJsonDocument>
#include <QLabel>
#include <QMainWindow>
#include <QPluginLoader>
#include <QTemporaryDir>
#include <QTextDocumentFragment>
#include <QThread>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "calls.h"
#include "creation_filter.h"
#include "descriptor_filter.h"
#include "filters.h"
#include "host.h"
#include "log_text.h"
#include "mesh_conversion.h"
#include "node_parameters.h"
#include "parameters.h"
#include "programs.h"
#include "remesh_filter.h"
#include "sample_meshes.h"
#include "wscvt/base/text_format.h"
#include "wscvt/remesh.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt::host_test {
namespace {

const QString filter_menu_text = "Remeshing: Weighted Spherical Centroidal Voronoi";

const QString creation_menu_text = "Create: grain from ellipsoid, superellipsoid or harmonics";
const QString descriptor_menu_text = "Grain shape descriptors";

/// One of the plugin's filters, the remesher unless told otherwise.
class LoadedFilter {
 public:
  explicit LoadedFilter(QString menu_text = filter_menu_text)
      : menu_text_(std::move(menu_text)), loader_(QStringLiteral(WSCVT_PLUGIN_FILE)) {
    plugin_ = qobject_cast<Plugin*>(loader_.instance());
    if (plugin_ == nullptr) throw std::runtime_error(loader_.errorString().toStdString());
    plugin_->setLog(&log_);
  }

  Plugin& plugin() { return *plugin_; }
  QAction* action() {
    for (QAction* action : actions_of(*plugin_)) {
      if (action->text() == menu_text_) return action;
    }
    throw std::runtime_error("There is no filter " + menu_text_.toStdString());
  }

  RichParameterList parameters(MeshDocument& document) {
    return parameters_of(*plugin_, action(), document);
  }

  bool apply(MeshDocument& document, const RichParameterList& parameters,
             vcg::CallBackPos* callback = nullptr) {
    return apply_filter(*plugin_, action(), document, parameters, callback, message_, values_);
  }

  /// Levels and lines of the log.
  const QList<std::pair<int, QString>>& log_entries() const { return log_.logStringList(); }

  /// The sentence of the last failure.
  std::string message() const { return message_.toStdString(); }

  /// What the last run handed back.
  const std::map<std::string, double>& values() const { return values_; }

  QStringList log() {
    QStringList lines;
    log_.print(lines);
    return lines;
  }

 private:
  QString menu_text_;
  QPluginLoader loader_;
  Plugin* plugin_ = nullptr;
  GLLogStream log_;
  QString message_;
  std::map<std::string, double> values_;
};

MeshModel& add_layer(MeshDocument& document, const IndexedMesh& mesh) {
  MeshModel& layer = *document.addNewMesh("", "scan.ply", true);
  filter::assign(layer.cm, mesh, std::vector<double>(mesh.points.size(), 0.25));
  update_box_and_normals(layer);
  return layer;
}

void set_transform(MeshModel& layer, const Eigen::Matrix4d& transform) {
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      layer.cm.Tr.ElementAt(row, column) = static_cast<Scalarm>(transform(row, column));
    }
  }
}

/// Sets a parameter from its text, as MeshLab does for a script.
void set_from_text(RichParameterList& list, const std::string& name, const std::string& text) {
  RichParameter& parameter = list.getParameterByName(QString::fromStdString(name));
  const QString value = QString::fromStdString(text);
  if (dynamic_cast<const RichEnum*>(&parameter) != nullptr) {
    parameter.setValue(EnumValue(value.toInt()));
  } else if (parameter.value().isInt()) {
    parameter.setValue(IntValue(value.toInt()));
  } else if (parameter.value().isFloat()) {
    parameter.setValue(FloatValue(value.toFloat()));
  } else if (parameter.value().isBool()) {
    parameter.setValue(BoolValue(value == "true"));
  } else {
    set_text(parameter, value);
  }
}

/// Everything about a layer that a user could notice.
struct LayerState {
  QString label;
  int mask = 0;
  int vertex_count = 0;
  int face_count = 0;
  std::array<float, 16> transform{};
  std::vector<float> vertices;  ///< point, normal, quality, flags
  std::vector<std::ptrdiff_t> faces;

  bool operator==(const LayerState& other) const {
    const auto same_bits = [](const std::vector<float>& a, const std::vector<float>& b) {
      return a.size() == b.size() &&
             std::equal(a.begin(), a.end(), b.begin(), [](float x, float y) {
               return x == y || (std::isnan(x) && std::isnan(y));
             });
    };
    return label == other.label && mask == other.mask && vertex_count == other.vertex_count &&
           face_count == other.face_count && transform == other.transform &&
           same_bits(vertices, other.vertices) && faces == other.faces;
  }
};

LayerState state_of(MeshModel& layer) {
  LayerState state;
  state.label = layer.label();
  state.mask = layer.dataMask();
  state.vertex_count = layer.cm.vn;
  state.face_count = layer.cm.fn;
  std::copy(layer.cm.Tr.V(), layer.cm.Tr.V() + 16, state.transform.begin());
  for (const auto& vertex : layer.cm.vert) {
    for (int k = 0; k < 3; ++k) state.vertices.push_back(vertex.cP()[k]);
    for (int k = 0; k < 3; ++k) state.vertices.push_back(vertex.cN()[k]);
    state.vertices.push_back(vertex.cQ());
    state.vertices.push_back(static_cast<float>(vertex.cFlags()));
  }
  for (const auto& face : layer.cm.face) {
    for (int k = 0; k < 3; ++k) state.faces.push_back(face.cV(k) - layer.cm.vert.data());
    state.faces.push_back(face.cFlags());
  }
  return state;
}

std::vector<LayerState> state_of(MeshDocument& document) {
  std::vector<LayerState> states;
  for (MeshModel* layer : layers_of(document)) states.push_back(state_of(*layer));
  return states;
}

TEST(Filter, IsFoundByTheWordsThatPeopleSearchFor) {
  // MeshLab's search (searcher.cpp) splits name and tooltip into words and takes each prefix of
  // three letters and more; words in brackets of HTML are left out.
  LoadedFilter filter;
  QString text = (filter_menu_text + " " + filter.plugin().filterInfo(filter.action())).toLower();
  text.remove(QRegExp("<[^>]*>"));
  const QStringList words = text.split(QRegExp("\\W+"), Qt::SkipEmptyParts);
  for (const QString searched : {"wscvt", "voronoi", "cvt", "sand", "grain", "particle", "dem",
                                 "remesh", "resample", "simplify", "decimate", "isotropic"}) {
    const bool found = std::any_of(words.begin(), words.end(),
                                   [&](const QString& word) { return word.startsWith(searched); });
    EXPECT_TRUE(found) << searched.toStdString();
  }
}

TEST(Filter, NamesMenusAndConditionsAreFrozen) {
  LoadedFilter loaded;
  Plugin& plugin = loaded.plugin();
  ASSERT_EQ(actions_of(plugin).size(), 3U);
  const int changes = MeshModel::MM_VERTNUMBER | MeshModel::MM_FACENUMBER;
  QAction* remesh = loaded.action();
  EXPECT_EQ(plugin.getClass(remesh), Plugin::Remeshing);
  EXPECT_EQ(plugin.filterArity(remesh), Plugin::SINGLE_MESH);
  EXPECT_EQ(plugin.getPreConditions(remesh), MeshModel::MM_NONE);  // points without faces too
  EXPECT_EQ(plugin.postCondition(remesh) & changes, changes);

  QAction* create = LoadedFilter(creation_menu_text).action();
  EXPECT_EQ(plugin.getClass(create), Plugin::MeshCreation);
  EXPECT_EQ(plugin.filterArity(create), Plugin::NONE);
  EXPECT_EQ(plugin.getPreConditions(create), MeshModel::MM_NONE);
  EXPECT_EQ(plugin.postCondition(create) & changes, changes);

  QAction* describe = LoadedFilter(descriptor_menu_text).action();
  EXPECT_EQ(plugin.getClass(describe), Plugin::Measure);
  EXPECT_EQ(plugin.filterArity(describe), Plugin::SINGLE_MESH);
  EXPECT_EQ(plugin.getPreConditions(describe), MeshModel::MM_FACENUMBER);
  EXPECT_EQ(plugin.postCondition(describe), MeshModel::MM_NONE);

  std::vector<std::string> python_names;
  for (const filter::Filter& each : filter::all_filters()) python_names.push_back(each.python_name);
  EXPECT_EQ(python_names,
            (std::vector<std::string>{"meshing_weighted_spherical_voronoi", "create_grain",
                                      "get_grain_shape_descriptors"}));
}

TEST(Filter, HelpNamesTheMethodAndItsSource) {
  LoadedFilter loaded;
  const QString help = loaded.plugin().filterInfo(loaded.action());
  for (const char* words :
       {"Wu F., Huang L., Lai Z.", "10.6052/j.issn.1000-4750.2022.07.0614", "exactly N nodes"}) {
    EXPECT_TRUE(help.contains(words)) << words;
  }
}

TEST(Filter, HelpsAreSixLinesAtMost) {
  // The narrowest dialog is 490 pixels wide and shows 65 characters a line.
  for (const filter::Filter& each : filter::all_filters()) {
    const QString help =
        QTextDocumentFragment::fromHtml(QString::fromStdString(each.help)).toPlainText();
    EXPECT_LE(help.size(), 6 * 65 - 25) << each.name;
    EXPECT_GE(help.size(), 50) << each.name;
  }
}

TEST(Filter, HelpOfParametersFitsItsColumn) {
  const QMainWindow window;  // texts are laid out for one
  for (const filter::Filter& each : filter::all_filters()) {
    LoadedFilter loaded(QString::fromStdString(each.name));
    MeshDocument document;
    for (const RichParameter& parameter : loaded.parameters(document)) {
      // As every version makes them.
      QLabel label("<small>" + parameter.toolTip() + "</small>");
      label.setTextFormat(Qt::RichText);
      label.setWordWrap(true);
      EXPECT_LE(label.minimumSizeHint().width(), help_column)
          << each.name << ' ' << parameter.name().toStdString();
      EXPECT_GT(label.minimumSizeHint().width(), 0.8 * help_column)
          << "room is given away: " << parameter.name().toStdString();
    }
  }
}

TEST(Filter, BriefTooltipIsOfWholeSentences) {
  filter::FilterParameter parameter;
  parameter.tooltip = "One and 2.5. Two. Three.";
  parameter.choices_help = " Choice: four.";
  EXPECT_EQ(filter::whole_tooltip(parameter), "One and 2.5. Two. Three. Choice: four.");
  EXPECT_EQ(filter::brief_tooltip(parameter, 24), "One and 2.5. Two. Three.");
  EXPECT_EQ(filter::brief_tooltip(parameter, 23), "One and 2.5. Two.");
  EXPECT_EQ(filter::brief_tooltip(parameter, 16), "One and 2.5.");
  EXPECT_EQ(filter::brief_tooltip(parameter, 1), "One and 2.5.");
  parameter.tooltip.clear();
  EXPECT_EQ(filter::brief_tooltip(parameter, 24), "");
}

TEST(Filter, ParametersOfEveryDayAreFirstAndNotFoldedAway) {
  LoadedFilter remesher;
  MeshDocument document;
  QStringList of_every_day;
  for (const RichParameter& parameter : remesher.parameters(document)) {
    of_every_day << parameter.name();
    if (of_every_day.size() == 8) break;
  }
  EXPECT_EQ(of_every_day, (QStringList{"NodeCount", "Method", "Weighting", "EdgeRatio", "Distances",
                                       "Quality", "ColorByQuality", "ReportFile"}))
      << of_every_day.join(' ').toStdString();
  for (const RichParameter& parameter : remesher.parameters(document)) {
    EXPECT_EQ(is_advanced(parameter),
              host_folds_parameters && !of_every_day.contains(parameter.name()))
        << parameter.name().toStdString();
  }
}

TEST(CreationFilter, FoldsAwayWhatIsSeldomNeeded) {
  LoadedFilter loaded(creation_menu_text);
  MeshDocument document;
  std::size_t shown = 0;
  for (const RichParameter& parameter : loaded.parameters(document)) {
    if (!is_advanced(parameter)) ++shown;
    if (parameter.name() == "NodeCount" || parameter.name() == "ReportFile") {
      EXPECT_FALSE(is_advanced(parameter));
    }
  }
  EXPECT_EQ(shown, host_folds_parameters ? 14U : loaded.parameters(document).size());
}

/// Names, types and defaults, one a line.
QString listed_parameters(const QString& menu_text) {
  LoadedFilter loaded(menu_text);
  MeshDocument document;
  QStringList lines;
  for (const RichParameter& parameter : loaded.parameters(document)) {
    QDomDocument xml;
    const QDomElement element = parameter.fillToXMLDocument(xml);
    // Versions have two names for a file's type.
    QString type = parameter.stringType();
    if (type == output_file_type) type = "OutputFile";
    if (type == input_file_type) type = "InputFile";
    lines << (parameter.name() + " " + type + " " + element.attribute("value")).trimmed();
    EXPECT_FALSE(parameter.fieldDescription().isEmpty()) << parameter.name().toStdString();
    if (type == "RichFloat") {
      // The dialog of 2020.09 shows two digits and Apply uses what is shown.
      const double value = element.attribute("value").toDouble();
      EXPECT_NEAR(100.0 * value, std::round(100.0 * value), 1e-4) << parameter.name().toStdString();
    }
    EXPECT_GT(parameter.toolTip().size(), 40) << parameter.name().toStdString();
  }
  return lines.join("\n");
}

TEST(Filter, ParameterNamesTypesAndDefaultsAreFrozen) {
  const QStringList remesh{
      "NodeCount RichInt 1000",        "Method RichEnum 0",          "Weighting RichEnum 1",
      "EdgeRatio RichFloat 1.1",       "Distances RichBool false",   "Quality RichEnum 0",
      "ColorByQuality RichBool false", "ReportFile OutputFile",      "ErrorTarget RichFloat 0",
      "TargetMeasure RichEnum 4",      "CurvatureAlpha RichFloat 1", "Placement RichEnum 4",
      "HarmonicDegree RichInt 20",     "FoldLimit RichFloat 5",      "MendLimit RichFloat 5",
      "Points RichBool false",         "NewLayer RichBool true",     "KeepColors RichBool true",
      "CoefficientsFile OutputFile"};
  EXPECT_EQ(listed_parameters(filter_menu_text).toStdString(), remesh.join("\n").toStdString());
  const QStringList create{"Surface RichEnum 0",         "SemiAxisX RichFloat 1",
                           "SemiAxisY RichFloat 1",      "SemiAxisZ RichFloat 1",
                           "PolarExponent RichFloat 1",  "AzimuthalExponent RichFloat 1",
                           "CoefficientsFile InputFile", "CoefficientDegree RichInt -1",
                           "NodeCount RichInt 1000",     "Method RichEnum 0",
                           "Weighting RichEnum 1",       "CurvatureAlpha RichFloat 1",
                           "Placement RichEnum 4",       "EdgeRatio RichFloat 1.1",
                           "Quality RichEnum 0",         "ColorByQuality RichBool false",
                           "ReportFile OutputFile"};
  EXPECT_EQ(listed_parameters(creation_menu_text).toStdString(), create.join("\n").toStdString());
  EXPECT_LE(remesh.size(), 19);
  EXPECT_LE(create.size(), 18);
  const QStringList describe{"ReferenceLayer RichString", "RoundnessBall RichFloat 0.2",
                             "RoughnessCutoff RichFloat 0.33", "ReportFile OutputFile"};
  EXPECT_EQ(listed_parameters(descriptor_menu_text).toStdString(),
            describe.join("\n").toStdString());
}

TEST(Filter, ChoicesAreFrozen) {
  LoadedFilter loaded;
  MeshDocument document;
  const RichParameterList list = loaded.parameters(document);
  const auto choices = [&](const char* name) {
    return dynamic_cast<const RichEnum&>(list.getParameterByName(name)).enumvalues;
  };
  EXPECT_EQ(choices("Weighting"), QStringList({"Constant (as published)", "WSCVT-D",
                                               "WSCVT-C (curvature)", "Area (as published)"}));
  EXPECT_EQ(choices("Method"), QStringList({"On the scan", "As published"}));
  EXPECT_EQ(choices("Placement"),
            QStringList({"SH surface (as published)", "On the surface",
                         "Fitted (on the scan, volume exact)", "Contact fit (on the scan)",
                         "Default of the method"}));
  EXPECT_EQ(choices("TargetMeasure"),
            QStringList({"Volume", "Area", "Sphericity", "Inertia", "RMS distance"}));
  EXPECT_EQ(choices("Quality"),
            QStringList({"Radial distance", "Curvature", "Cell area", "Distance to the scan"}));
}

struct Script {
  const char* file;
  QString menu_text;
  std::map<std::string, std::string> values;  ///< that differ from the defaults
};

void PrintTo(const Script& script, std::ostream* out) { *out << script.file; }

class FilterScripts : public ::testing::TestWithParam<Script> {};

/// A script that lacks a parameter or misspells one ends meshlabserver by a failed assertion.
TEST_P(FilterScripts, HoldExactlyTheFiltersParameters) {
  FilterScript script;
  ASSERT_TRUE(script.open(script_path(GetParam().file)));
  ASSERT_EQ(script.size(), 1);
  EXPECT_EQ(filter_of(script, 0), GetParam().menu_text);

  LoadedFilter loaded(GetParam().menu_text);
  MeshDocument document;
  RichParameterList expected = loaded.parameters(document);
  for (const auto& [name, value] : GetParam().values) set_from_text(expected, name, value);
  RichParameterList actual = parameters_of(script, 0);
  ASSERT_EQ(actual.size(), expected.size());
  auto wanted = expected.begin();
  for (const RichParameter& parameter : actual) {
    QDomDocument xml;
    const QDomElement is = parameter.fillToXMLDocument(xml, false);
    const RichParameter& in_filter = *wanted;
    ++wanted;
    if (in_filter.stringType() == output_file_type || in_filter.stringType() == input_file_type) {
      // What a file dialog offers is left out. A text in place of a file would end 2020.09 when the
      // parameters of the script are edited.
      EXPECT_EQ(is.attribute("type"), in_filter.stringType());
      EXPECT_EQ(is.attribute("name"), in_filter.name());
      continue;
    }
    const QDomElement should_be = in_filter.fillToXMLDocument(xml, false);
    ASSERT_EQ(is.attributes().count(), should_be.attributes().count())
        << parameter.name().toStdString();
    for (int k = 0; k < is.attributes().count(); ++k) {
      const QString attribute = is.attributes().item(k).nodeName();
      EXPECT_EQ(is.attribute(attribute).toStdString(), should_be.attribute(attribute).toStdString())
          << parameter.name().toStdString() << ' ' << attribute.toStdString();
    }
  }
}

TEST_P(FilterScripts, RunAsTheyAre) {
  FilterScript script;
  ASSERT_TRUE(script.open(script_path(GetParam().file)));
  LoadedFilter loaded(filter_of(script, 0));
  MeshDocument document;
  MeshModel& scan = add_layer(document, grain());
  ASSERT_TRUE(loaded.apply(document, parameters_of(script, 0))) << loaded.message();
  if (GetParam().menu_text == descriptor_menu_text) {
    EXPECT_EQ(layers_of(document).size(), 1U);
    return;
  }
  EXPECT_NE(document.mm(), &scan);
  EXPECT_EQ(document.mm()->cm.vn, 1000);
}

INSTANTIATE_TEST_SUITE_P(
    , FilterScripts,
    ::testing::Values(
        Script{"constant.mlx", filter_menu_text, {{"Method", "1"}, {"Weighting", "0"}}},
        Script{"wscvt_d.mlx", filter_menu_text, {{"Weighting", "1"}}},
        Script{"wscvt_c.mlx", filter_menu_text, {{"Weighting", "2"}}},
        Script{"area.mlx", filter_menu_text, {{"Method", "1"}, {"Weighting", "3"}}},
        Script{"create_superellipsoid.mlx",
               creation_menu_text,
               {{"Surface", "1"},
                {"SemiAxisX", "1.5"},
                {"SemiAxisY", "1.2"},
                {"PolarExponent", "0.7"},
                {"AzimuthalExponent", "0.8"}}},
        Script{"descriptors.mlx", descriptor_menu_text, {}}),
    [](const auto& test) { return QFileInfo(test.param.file).baseName().toStdString(); });

TEST(Filter, AddsACurrentLayerAndKeepsTheScan) {
  LoadedFilter loaded;
  MeshDocument document;
  MeshModel& scan = add_layer(document, grain());
  scan.cm.Tr.SetTranslate(1.0F, 2.0F, 3.0F);
  scan.setLabel("grain%1.ply");  // looks like a place for another text
  const LayerState before = state_of(scan);
  RichParameterList parameters = loaded.parameters(document);
  parameters.setValue("NodeCount", IntValue(300));
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();

  ASSERT_EQ(layers_of(document).size(), 2);
  EXPECT_TRUE(state_of(scan) == before);
  MeshModel& result = *document.mm();
  EXPECT_NE(&result, &scan);
  EXPECT_TRUE(is_shown(result));
  EXPECT_FALSE(is_shown(scan)) << "the result is not seen alone";
  EXPECT_EQ(result.label().toStdString(), "grain%1 WSCVT-D 300");
  EXPECT_EQ(result.cm.vn, 300);
  EXPECT_EQ(result.cm.fn, 2 * 300 - 4);
  EXPECT_TRUE(result.cm.Tr == scan.cm.Tr);
  EXPECT_TRUE(result.hasDataMask(MeshModel::MM_VERTQUALITY));
  EXPECT_FALSE(result.hasDataMask(MeshModel::MM_VERTCOLOR));
  EXPECT_FALSE(result.cm.bbox.IsNull());
  for (const auto& face : result.cm.face) EXPECT_NEAR(face.cN().Norm(), 1.0F, 1e-5F);
}

TEST(Filter, ReplacesTheScanWhenAsked) {
  LoadedFilter loaded;
  MeshDocument document;
  MeshModel& scan = add_layer(document, grain());
  scan.cm.Tr.SetTranslate(1.0F, 2.0F, 3.0F);
  scan.updateDataMask(MeshModel::MM_FACEFACETOPO | MeshModel::MM_VERTFACETOPO |
                      MeshModel::MM_WEDGTEXCOORD | MeshModel::MM_FACECOLOR |
                      MeshModel::MM_VERTCURVDIR | MeshModel::MM_VERTCOLOR);
  vcg::tri::Allocator<CMeshO>::AddPerVertexAttribute<float>(scan.cm, "label");
  vcg::tri::Allocator<CMeshO>::AddPerFaceAttribute<float>(scan.cm, "label");
  const auto transform = scan.cm.Tr;
  RichParameterList parameters = loaded.parameters(document);
  parameters.setValue("NodeCount", IntValue(250));
  parameters.setValue("NewLayer", BoolValue(false));
  parameters.setValue("KeepColors", BoolValue(false));
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();

  ASSERT_EQ(layers_of(document).size(), 1);
  EXPECT_EQ(document.mm(), &scan);
  EXPECT_EQ(scan.cm.vn, 250);
  EXPECT_EQ(scan.cm.fn, 2 * 250 - 4);
  EXPECT_EQ(scan.cm.vert.size(), 250U);
  EXPECT_TRUE(scan.cm.Tr == transform);
  // What described the old elements is gone, and what the host asks for next can be made anew.
  EXPECT_FALSE(scan.hasDataMask(MeshModel::MM_WEDGTEXCOORD));
  EXPECT_FALSE(scan.hasDataMask(MeshModel::MM_VERTCOLOR));
  EXPECT_TRUE(scan.cm.vert_attr.empty()) << "which MeshLab writes into files";
  EXPECT_TRUE(scan.cm.face_attr.empty());
  scan.updateDataMask(MeshModel::MM_FACEFACETOPO | MeshModel::MM_VERTFACETOPO);
  for (const auto& face : scan.cm.face) {
    for (int k = 0; k < 3; ++k) EXPECT_NE(face.cFFp(k), &face);
  }
}

TEST(Filter, RemeshesTheScanAsItIsShown) {
  // A mirror image, three times as long along an oblique axis, elsewhere.
  Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();
  transform.topLeftCorner<3, 3>() << -1.0, 0.5, 0.0, 0.25, 3.0, 0.0, 0.0, 0.5, 1.0;
  transform.topRightCorner<3, 1>() = Vector3(8.0, -4.0, 2.0);
  RemeshOptions options;
  options.node_count = 200;
  for (const bool new_layer : {true, false}) {
    LoadedFilter loaded;
    MeshDocument document;
    MeshModel& scan = add_layer(document, grain());
    set_transform(scan, transform);
    const RemeshResult expected =
        remesh(filter::transformed(filter::to_indexed_mesh(scan.cm), transform), options);
    RichParameterList parameters = loaded.parameters(document);
    parameters.setValue("NodeCount", IntValue(200));
    parameters.setValue("NewLayer", BoolValue(new_layer));
    ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
    MeshModel& result = *document.mm();
    EXPECT_TRUE(result.cm.Tr == scan.cm.Tr);
    const IndexedMesh shown = filter::transformed(filter::to_indexed_mesh(result.cm), transform);
    ASSERT_EQ(shown.points.size(), expected.mesh.points.size());
    for (std::size_t v = 0; v < shown.points.size(); ++v) {
      // Floats of coordinates below 4, three times as far apart.
      EXPECT_LT((shown.points[v] - expected.mesh.points[v]).norm(), 2e-6);
    }
    EXPECT_TRUE(shown.triangles == expected.mesh.triangles);
    const std::string log = loaded.log().join("\n").toStdString();
    for (const double size : {expected.scan.volume, expected.remesh.area}) {
      EXPECT_NE(log.find(" " + format_number(size, 5) + " "), std::string::npos) << size << log;
    }
    EXPECT_NE(log.find("Matrix: Freeze Current Matrix"), std::string::npos) << log;
  }
}

TEST(Filter, WarnsOfDigitsThatWereLostWhereALayerIsStored) {
  // Stored far away, shown at the origin.
  for (const QString& menu_text : {filter_menu_text, descriptor_menu_text}) {
    LoadedFilter loaded(menu_text);
    MeshDocument document;
    const Vector3 place = Vector3::Constant(std::ldexp(1.0, 20));
    Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();
    transform.topRightCorner<3, 1>() = -place;
    set_transform(add_layer(document, moved(grain(), place)), transform);
    ASSERT_TRUE(loaded.apply(document, loaded.parameters(document))) << loaded.message();
    const std::string log = loaded.log().join("\n").toStdString();
    EXPECT_EQ(log.find("Warning: 'scan.ply' as stored is so far") != std::string::npos,
              sizeof(Scalarm) == sizeof(float))
        << log;
  }
}

TEST(Filter, GivesWhatTheLibraryGives) {
  LoadedFilter loaded;
  MeshDocument document;
  MeshModel& scan = add_layer(document, grain());
  const IndexedMesh as_loaded = filter::to_indexed_mesh(scan.cm);  // rounded to float
  const auto qualities = [](const RemeshResult& result) {
    return std::vector<const std::vector<double>*>{&result.radial_distances, &result.curvatures,
                                                   &result.cell_areas, &result.vertex_distances};
  };
  RemeshOptions options;
  options.node_count = 200;
  OnScanOptions on_scan;
  on_scan.weighting = CellWeighting::Curvature;
  options.method = on_scan;
  options.measures.node_curvatures = true;
  options.measures.distances = true;
  const RemeshResult expected = remesh(as_loaded, options);
  const IndexedMesh mesh = expected.mesh;
  for (int quality = 0; quality < 4; ++quality) {
    document.setCurrentMesh(scan.id());
    RichParameterList parameters = loaded.parameters(document);
    parameters.setValue("NodeCount", IntValue(200));
    parameters.setValue("Weighting", EnumValue(2));
    parameters.setValue("Quality", EnumValue(quality));
    ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
    const CMeshO& actual = document.mm()->cm;
    ASSERT_EQ(actual.vert.size(), mesh.points.size());
    ASSERT_EQ(actual.face.size(), mesh.triangles.size());
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(actual.vert[v].cP()[k], static_cast<Scalarm>(mesh.points[v][k]));
      }
      EXPECT_EQ(actual.vert[v].cQ(),
                static_cast<Scalarm>((*qualities(expected)[static_cast<std::size_t>(quality)])[v]));
    }
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(actual.face[f].cV(static_cast<int>(k)) - actual.vert.data(),
                  mesh.triangles[f][k]);
      }
    }
  }
}

TEST(Filter, SkipsDeletedElements) {
  LoadedFilter loaded;
  const IndexedMesh mesh = grain();
  MeshDocument clean;
  add_layer(clean, mesh);
  MeshDocument littered;
  IndexedMesh with_litter = mesh;
  for (Triangle& t : with_litter.triangles) {
    for (std::int32_t& v : t) v += 3;
  }
  with_litter.points.insert(with_litter.points.begin(),
                            {Vector3(9, 9, 9), Vector3(10, 9, 9), Vector3(9, 10, 9)});
  with_litter.triangles.insert(with_litter.triangles.begin(), Triangle{0, 1, 2});
  MeshModel& scan = add_layer(littered, with_litter);
  vcg::tri::Allocator<CMeshO>::DeleteFace(scan.cm, scan.cm.face[0]);
  for (std::size_t v = 0; v < 3; ++v) {
    vcg::tri::Allocator<CMeshO>::DeleteVertex(scan.cm, scan.cm.vert[v]);
  }

  for (MeshDocument* document : {&clean, &littered}) {
    RichParameterList parameters = loaded.parameters(*document);
    parameters.setValue("NodeCount", IntValue(100));
    ASSERT_TRUE(loaded.apply(*document, parameters)) << loaded.message();
  }
  EXPECT_TRUE(state_of(*clean.mm()) == state_of(*littered.mm()));
}

TEST(Filter, ColorsFromRedToBlueWhenAsked) {
  LoadedFilter loaded;
  MeshDocument document;
  add_layer(document, grain());
  RichParameterList parameters = loaded.parameters(document);
  parameters.setValue("NodeCount", IntValue(300));
  parameters.setValue("ColorByQuality", BoolValue(true));
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  MeshModel& result = *document.mm();
  EXPECT_TRUE(result.hasDataMask(MeshModel::MM_VERTCOLOR));
  const auto [lowest, highest] =
      std::minmax_element(result.cm.vert.begin(), result.cm.vert.end(),
                          [](const auto& a, const auto& b) { return a.cQ() < b.cQ(); });
  EXPECT_LT(lowest->cQ(), highest->cQ());
  EXPECT_TRUE(lowest->cC() == vcg::Color4b(vcg::Color4b::Red));
  EXPECT_TRUE(highest->cC() == vcg::Color4b(vcg::Color4b::Blue));
  EXPECT_TRUE(result.cm.mesh_attr.empty()) << "an attribute that only the coloring needed";
}

TEST(Filter, DistancesAreColoredBySideAndNamedInTheLog) {
  LoadedFilter loaded;
  MeshDocument document;
  add_layer(document, grain());
  RichParameterList parameters = loaded.parameters(document);
  parameters.setValue("NodeCount", IntValue(200));
  parameters.setValue("Quality", EnumValue(3));
  parameters.setValue("ColorByQuality", BoolValue(true));
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  const CMeshO& mesh = document.mm()->cm;
  Scalarm inside = 0;
  Scalarm outside = 0;
  for (const auto& vertex : mesh.vert) {
    inside = std::min(inside, vertex.cQ());
    outside = std::max(outside, vertex.cQ());
    const int red = vertex.cC()[0];
    const int blue = vertex.cC()[2];
    // One step of a channel is a hundredth of the range.
    if (std::abs(red - blue) > 1) {
      EXPECT_EQ(red > blue, vertex.cQ() > 0) << vertex.cQ();
    }
  }
  ASSERT_LT(inside, 0);
  ASSERT_GT(outside, 0);
  const Scalarm largest = std::max(-inside, outside);
  for (const auto& vertex : mesh.vert) {
    if (std::abs(vertex.cQ()) < largest) continue;
    EXPECT_GT(std::abs(vertex.cC()[0] - vertex.cC()[2]), 120);  // the full colour
  }
  const std::string log = loaded.log().join("\n").toStdString();
  for (const double end : {static_cast<double>(inside), static_cast<double>(outside)}) {
    EXPECT_NE(log.find(format_number(end, 3)), std::string::npos) << log;
  }
  for (const char* name : {"largest distance", "rms distance", "mean distance"}) {
    EXPECT_NE(log.find(name), std::string::npos) << log;
  }
}

TEST(Filter, KeepsTheScansColorsAndQualityUnlessToldOtherwise) {
  LoadedFilter loaded;
  MeshDocument document;
  MeshModel& scan = add_layer(document, grain());
  scan.updateDataMask(MeshModel::MM_VERTCOLOR | MeshModel::MM_VERTQUALITY |
                      MeshModel::MM_FACECOLOR | MeshModel::MM_FACEQUALITY);
  // Numbers that are linear in the place, so that every node knows what it has to hold.
  const auto red = [](const auto& p) { return 100.0 + 40.0 * p[0] + 20.0 * p[1]; };
  const auto value = [](const auto& p) { return 3.0 * p[2] - p[0]; };
  for (auto& v : scan.cm.vert) {
    v.C() = vcg::Color4b(static_cast<unsigned char>(std::lround(red(v.P()))), 7, 9, 255);
    v.Q() = static_cast<float>(value(v.P()));
  }
  for (auto& f : scan.cm.face) {
    const bool right = (f.P(0) + f.P(1) + f.P(2))[0] > 0.0F;
    f.C() = right ? vcg::Color4b(10, 20, 30, 255) : vcg::Color4b(40, 50, 60, 255);
    f.Q() = right ? 5.0F : 2.0F;
  }
  RichParameterList parameters = loaded.parameters(document);
  parameters.setValue("NodeCount", IntValue(300));
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  MeshModel& result = *document.mm();
  for (const int part :
       {MeshModel::MM_VERTCOLOR, MeshModel::MM_FACECOLOR, MeshModel::MM_FACEQUALITY}) {
    EXPECT_TRUE(result.hasDataMask(part));
  }
  // A node's nearest point of the scan is within the misfit, some hundredths.
  for (const auto& v : result.cm.vert) {
    EXPECT_NEAR(v.cC()[0], red(v.cP()), 4.0);
    EXPECT_EQ(v.cC()[2], 9);
    EXPECT_NEAR(v.cQ(), value(v.cP()), 0.2);
  }
  for (const auto& f : result.cm.face) {
    const float x = (f.cP(0) + f.cP(1) + f.cP(2))[0] / 3.0F;
    if (std::abs(x) < 0.1F) continue;
    EXPECT_EQ(f.cQ(), x > 0.0F ? 5.0F : 2.0F);
    EXPECT_EQ(f.cC()[1], x > 0.0F ? 20 : 50);
  }

  document.setCurrentMesh(static_cast<int>(scan.id()));
  parameters.setValue("KeepColors", BoolValue(false));
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  const MeshModel& plain = *document.mm();
  EXPECT_FALSE(plain.hasDataMask(MeshModel::MM_VERTCOLOR));
  EXPECT_FALSE(plain.hasDataMask(MeshModel::MM_FACECOLOR));
  // The radial distance.
  for (const auto& v : plain.cm.vert) EXPECT_NEAR(v.cQ(), v.cP().Norm(), 0.1);
}

TEST(Filter, KeepsTheColorsOfTheScansPicture) {
  // Linear in the place, 200 x 100 pixels.
  QImage picture(200, 100, QImage::Format_RGB888);
  for (int row = 0; row < 100; ++row) {
    for (int column = 0; column < 200; ++column) {
      picture.setPixel(column, row, qRgb(20 + column, 5 + 2 * row, 17));
    }
  }
  const QTemporaryDir folder;
  LoadedFilter loaded;
  MeshDocument document;
  MeshModel& scan = add_layer(document, grain());
  scan.updateDataMask(MeshModel::MM_WEDGTEXCOORD);
  scan.cm.textures = {"missing.png"};
  add_picture(scan, "stone.png", picture, folder.path());
  const auto u = [](const auto& p) { return 0.5 + 0.2 * p[0]; };
  const auto v = [](const auto& p) { return 0.5 + 0.3 * p[1]; };
  for (auto& f : scan.cm.face) {
    for (int k = 0; k < 3; ++k) {
      f.WT(k).U() = static_cast<float>(u(f.P(k)));
      f.WT(k).V() = static_cast<float>(v(f.P(k)));
      f.WT(k).N() = 1;
    }
  }
  RichParameterList parameters = loaded.parameters(document);
  parameters.setValue("NodeCount", IntValue(300));
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  const MeshModel& result = *document.mm();
  ASSERT_TRUE(result.hasDataMask(MeshModel::MM_VERTCOLOR));
  for (const auto& node : result.cm.vert) {
    // The nearest point lies within the misfit, some hundredths.
    EXPECT_NEAR(node.cC()[0], 20.0 + 200.0 * u(node.cP()) - 0.5, 3.0);
    EXPECT_NEAR(node.cC()[1], 5.0 + 2.0 * (100.0 * (1.0 - v(node.cP())) - 0.5), 4.0);
    EXPECT_EQ(node.cC()[2], 17);
  }
  EXPECT_TRUE(loaded.log().join(" ").contains("missing.png"))
      << loaded.log().join("\n").toStdString();

  document.setCurrentMesh(static_cast<int>(scan.id()));
  parameters.setValue("KeepColors", BoolValue(false));
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  EXPECT_FALSE(document.mm()->hasDataMask(MeshModel::MM_VERTCOLOR));
}

TEST(Filter, LogBeginsEmptyAndHoldsTheTableAndTheTime) {
  LoadedFilter loaded;
  MeshDocument document;
  add_layer(document, grain());
  RichParameterList parameters = loaded.parameters(document);
  parameters.setValue("NodeCount", IntValue(300));
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  const QStringList lines = loaded.log();
  ASSERT_FALSE(lines.isEmpty());
  EXPECT_EQ(lines.front(), "");
  for (const QString& line : lines) {
    // The verdict is a sentence, which wraps.
    if (line == lines.back()) continue;
    EXPECT_LT(line.size(), 60) << "wider than the panel: " << line.toStdString();
    EXPECT_FALSE(line.contains('\n')) << line.toStdString();
  }
  const QString log = lines.join("\n");
  EXPECT_LE(lines.size(), 14) << log.toStdString();
  for (const char* words :
       {"volume", "area", "aspect", "sphericity", "error", "time, s", "300", "596"}) {
    EXPECT_TRUE(log.contains(words, Qt::CaseInsensitive)) << words << " is not in\n"
                                                          << log.toStdString();
  }
}

TEST(Filter, LogHoldsCountsInFull) {
  RemeshResult result;
  result.input.input_vertices = 1234567;
  result.input.vertices = 1234567;
  result.input.faces = 2469130;
  result.mesh.points.resize(100000);
  result.mesh.triangles.resize(199996);
  std::string log;
  for (const filter::LogLine& line : filter::log_lines(result, 0.1)) log += line.text + "\n";
  for (const char* count : {" 1234567 ", " 2469130 ", " 100000", " 199996"}) {
    EXPECT_NE(log.find(count), std::string::npos) << count << " is not in\n" << log;
  }
}

TEST(Filter, LogSaysWhereHandlesWereCutAsItsWarningPromises) {
  RemeshResult result;
  result.input.input_vertices = 1000;
  OnScanReport report;
  report.handles.cut.resize(1);
  report.handles.cut[0].length = 0.5;
  report.handles.cut[0].place = Vector3(1.25, -2.5, 3.75);
  result.method = report;
  std::string log;
  for (const filter::LogLine& line : filter::log_lines(result, 0.1)) log += line.text + "\n";
  EXPECT_NE(log.find("Handles     1 handle cut and closed: loop of 0.5 at (1.25, -2.5, 3.75)"),
            std::string::npos)
      << log;
}

TEST(Filter, LogHoldsTheSmallestAngleAndTheMeanEdgeRatioOfBothMeshes) {
  RemeshResult result;
  result.input.input_vertices = 500;
  result.scan_quality.smallest_angle = 7.5;
  result.scan_quality.mean_smallest_angle = 33.25;
  result.scan_quality.edge_ratio.mean = 3.5;
  result.scan_quality.edge_ratio.maximum = 9.25;
  result.quality.smallest_angle = 31.5;
  result.quality.mean_smallest_angle = 52.25;
  result.quality.edge_ratio.mean = 1.25;
  result.quality.edge_ratio.maximum = 1.75;
  QStringList log;
  for (const filter::LogLine& line : filter::log_lines(result, 0.1)) {
    log.push_back(QString::fromStdString(line.text).simplified());
  }
  for (const char* row : {"smallest angle, degrees 7.5 31.5", "mean edge ratio 3.5 1.25"}) {
    EXPECT_TRUE(log.contains(row)) << log.join("\n").toStdString();
  }
}

TEST(Filter, LogTablesAreNoWiderThanThePanel) {
  const std::string tiny = "-1.2346e-05";
  const std::vector<std::vector<std::string>> rows = {
      {"Descriptor", "reference", "layer", "error %"},
      {"  axis S", "1", "2", "+3.000"},
      {"  longest chord across L and W (T of NIST)", tiny, "7", "+1234.500"}};
  const std::vector<std::string> lines = filter::log_table(rows);
  ASSERT_EQ(lines.size(), 4U);
  for (const std::string& line : lines) EXPECT_LE(line.size(), filter::log_width) << line;
  EXPECT_EQ(lines[3].substr(0, 21), "    and W (T of NIST)");
  EXPECT_EQ(lines[3].substr(lines[3].size() - 9), "+1234.500");
  EXPECT_EQ(lines[1].size(), lines[3].size());
  // Where the numbers leave no room they stand below, one a line.
  const std::string list = "-1.23456e-05, 0.1234567, 12.3456";
  const std::vector<std::string> below = {"  principal moments", "    " + list, "    " + list};
  EXPECT_EQ(filter::log_table({{"  principal moments", list, list}}), below);
  // A word that is too long stays whole.
  const std::string word(70, 'w');
  EXPECT_EQ(filter::log_table({{"a " + word, "1"}}).back(), "  " + word + "  1");
}

TEST(Filter, LogOfARemeshEndsByItsVerdict) {
  RemeshOptions options;
  options.node_count = 200;
  const auto log_of = [&](int nodes) {
    options.node_count = nodes;
    return filter::log_lines(remesh(grain(), options, Execution(1)), 0.1);
  };
  const std::vector<filter::LogLine> good = log_of(400);
  EXPECT_FALSE(good.back().warning);
  EXPECT_EQ(good.back().text.rfind("400 nodes, volume exact, area ", 0), 0U) << good.back().text;
  EXPECT_EQ(good.back().text.substr(good.back().text.size() - 6), ": good") << good.back().text;
  const std::vector<filter::LogLine> bad = log_of(10);
  EXPECT_NE(bad.back().text.find(": look at: The remesh is not accurate"), std::string::npos)
      << bad.back().text;
  EXPECT_TRUE(bad.back().warning);
  EXPECT_TRUE(bad[bad.size() - 2].warning);
  const auto names_sdq = [](const filter::LogLine& line) {
    return line.text.find("Sdq") != std::string::npos;
  };
  EXPECT_TRUE(std::any_of(good.begin(), good.end(), names_sdq));
}

TEST(Filter, TellsWhereTheNodesAreByTheSignOfTheirDistances) {
  RemeshOptions options;
  options.node_count = 200;
  RemeshResult result = remesh(grain(), options, Execution(1));
  const double radius = result.input.equivalent_radius;
  const auto line = [&](double lowest, double highest) {
    result.vertex_distances.assign(200, lowest);
    result.vertex_distances.back() = highest;
    for (const filter::LogLine& one : filter::log_lines(result, 0.1)) {
      if (one.text.find("odes are ") != std::string::npos) return one.text;
    }
    return std::string();
  };
  EXPECT_EQ(line(-0.25, 0.5), "Nodes are from -0.25 (inside) to 0.5 (outside)");
  EXPECT_EQ(line(0.25, 0.5), "Nodes are from 0.25 (outside) to 0.5 (outside)");
  EXPECT_EQ(line(-0.5, -0.25), "Nodes are from -0.5 (inside) to -0.25 (inside)");
  EXPECT_EQ(line(-1e-16 * radius, 0.5), "Nodes are from on the scan to 0.5 (outside)");
  EXPECT_EQ(line(-2.05e-16 * radius, 2.14e-16 * radius), "All nodes are on the scan");
  // Rounding has no color: white is 0.
  const std::vector<double> none(200, 0.0);
  EXPECT_EQ(filter::quality_values(result, filter::VertexQuality::OriginalDistance), none);
  line(-1e-8 * radius, 1e-8 * radius);
  EXPECT_EQ(filter::quality_values(result, filter::VertexQuality::OriginalDistance),
            result.vertex_distances);
}

TEST(Filter, LogHasWarningsAboveTheVerdict) {
  const std::vector<filter::LogLine> log = filter::as_log({"One.", "Two."}, {"a line"}, {"Good"});
  ASSERT_EQ(log.size(), 5U);
  for (std::size_t k = 0; k < log.size(); ++k) EXPECT_EQ(log[k].warning, k == 2 || k == 3) << k;
  EXPECT_EQ(log[3].text, "Warning: Two.");
  EXPECT_EQ(log[4].text, "Good");
  EXPECT_EQ(filter::as_log({}, {"a line"}, {}).size(), 2U);
}

TEST(Filter, SentencesNameWhatIsOnTheScreen) {
  const auto shown = [](const Sentence& sentence) { return filter::shown_words(sentence); };
  EXPECT_EQ(shown("Lower " + mention("edge-ratio") + "."),
            "Lower \"Mean edge ratio (on the scan)\".");
  EXPECT_EQ(shown("Use " + mention("edge-ratio", "1.4") + "."),
            "Use \"Mean edge ratio (on the scan): 1.4\".");
  EXPECT_EQ(shown("Raise " + mention("degree") + ", or use " + mention(Method::OnScan) + "."),
            "Raise \"Degree of the SH series\", or use \"Method: On the scan\".");
  EXPECT_EQ(shown(mention(PublishedPlacement::Surface)), "\"Node placement: On the surface\"");
  EXPECT_EQ(shown(mention(ScanPlacement::Fitted)),
            "\"Node placement: Fitted (on the scan, volume exact)\"");
  // Options that only the program has.
  EXPECT_EQ(shown("use " + mention("shrink-wrap", "5") + " and"), "use wscvt --shrink-wrap 5 and");
  EXPECT_EQ(shown("(" + mention("max-handle-loop") + ")."), "(wscvt --max-handle-loop).");
  // Parameters of scripts.
  EXPECT_EQ(shown("Parameter ReportFile is 'x'"), "Parameter \"Report file\" (ReportFile) is 'x'");
  EXPECT_EQ(shown("Parameters ReportFile and CoefficientsFile both name 'x'"),
            "Parameters \"Report file\" (ReportFile) and \"Coefficients file\" "
            "(CoefficientsFile) both name 'x'");
  EXPECT_EQ(shown("a - b -- c --"), "a - b -- c --");
}

TEST(Filter, LogLinesKeepColumnsAndSignsAsHtml) {
  EXPECT_EQ(filter::html_line("a b"), "a b");
  EXPECT_EQ(filter::html_line("a  b c"), "a\u00a0\u00a0b c");
  EXPECT_EQ(filter::html_line(" a b"), "\u00a0a\u00a0b");
  EXPECT_EQ(filter::html_line("1 < 2 & 3 > 2"), "1 &lt; 2 &amp; 3 > 2");
}

// The host's callback is a bare function, so what it saw is kept beside it.
int callback_calls = 0;
int callback_cancels_at = 0;
std::set<int> callback_positions;
bool callback_on_other_thread = false;

bool watching_callback(const int position, const char* text) {
  ++callback_calls;
  callback_positions.insert(position);
  if (text == nullptr || QThread::currentThread() != qApp->thread()) {
    callback_on_other_thread = true;
  }
  return callback_cancels_at == 0 || callback_calls < callback_cancels_at;
}

TEST(Filter, ReportsProgressOnTheMainThread) {
  LoadedFilter loaded;
  MeshDocument document;
  add_layer(document, grain());
  callback_calls = 0;
  callback_cancels_at = 0;
  callback_positions.clear();
  callback_on_other_thread = false;
  ASSERT_TRUE(loaded.apply(document, loaded.parameters(document), watching_callback));
  EXPECT_FALSE(callback_on_other_thread);
  EXPECT_GE(callback_positions.size(), 5U);
  EXPECT_GE(*callback_positions.begin(), 0);
  EXPECT_LE(*callback_positions.rbegin(), 100);
}

TEST(Filter, StopsWhenTheCallbackSaysSoAndChangesNothing) {
  LoadedFilter loaded;
  for (const bool new_layer : {true, false}) {
    for (const int cancel_at : {1, 3}) {
      MeshDocument document;
      add_layer(document, grain());
      const auto before = state_of(document);
      RichParameterList parameters = loaded.parameters(document);
      parameters.setValue("NewLayer", BoolValue(new_layer));
      callback_calls = 0;
      callback_cancels_at = cancel_at;
      EXPECT_FALSE(loaded.apply(document, parameters, watching_callback));
      EXPECT_EQ(callback_calls, cancel_at);
      const QString message = QString::fromStdString(loaded.message());
      EXPECT_TRUE(message.contains("Cancelled during: ")) << loaded.message();
      EXPECT_TRUE(message.contains(". Nothing was changed.")) << loaded.message();
      EXPECT_TRUE(state_of(document) == before);
    }
  }
}

/// What a user does in the window while a filter runs: once, at the callback's first call.
std::function<void()> deed_during_the_run;

bool acting_callback(int /*position*/, const char* /*stage*/) {
  if (deed_during_the_run) std::exchange(deed_during_the_run, nullptr)();
  return true;
}

TEST(Filter, SurvivesTheScanBeingDeletedDuringTheRun) {
  LoadedFilter loaded;
  for (const bool new_layer : {true, false}) {
    MeshDocument document;
    add_layer(document, sphere());
    MeshModel& scan = add_layer(document, grain());
    scan.cm.Tr.SetTranslate(1.0F, 2.0F, 3.0F);
    const auto transform = scan.cm.Tr;
    RichParameterList parameters = loaded.parameters(document);
    parameters.setValue("NodeCount", IntValue(60));
    parameters.setValue("NewLayer", BoolValue(new_layer));
    deed_during_the_run = [&] { remove_layer(document, scan); };
    EXPECT_EQ(loaded.apply(document, parameters, acting_callback), new_layer) << loaded.message();
    if (new_layer) {
      ASSERT_EQ(layers_of(document).size(), 2U);
      EXPECT_EQ(document.mm()->cm.vn, 60);
      EXPECT_TRUE(document.mm()->cm.Tr == transform);
    } else {
      ASSERT_EQ(layers_of(document).size(), 1U);
      EXPECT_EQ(document.mm()->cm.vn, static_cast<int>(sphere().points.size()));
      EXPECT_NE(loaded.message().find("no longer exists"), std::string::npos) << loaded.message();
    }
  }
}

TEST(Filter, RefusesToBeAppliedDuringARun) {
  LoadedFilter loaded;
  MeshDocument document;
  MeshModel& scan = add_layer(document, grain());
  RichParameterList parameters = loaded.parameters(document);
  parameters.setValue("NodeCount", IntValue(60));
  bool second = true;
  std::string message;
  deed_during_the_run = [&] {
    second = loaded.apply(document, parameters);
    message = loaded.message();
  };
  EXPECT_TRUE(loaded.apply(document, parameters, acting_callback));
  EXPECT_FALSE(second);
  EXPECT_NE(message.find("still running"), std::string::npos) << message;
  EXPECT_EQ(layers_of(document).size(), 2U);
  // The advice: after the first one is done, also when it was refused or failed.
  document.setCurrentMesh(scan.id());
  EXPECT_TRUE(loaded.apply(document, parameters));
  parameters.setValue("NodeCount", IntValue(2));
  EXPECT_FALSE(loaded.apply(document, parameters));
  EXPECT_EQ(loaded.message().find("still running"), std::string::npos);
}

TEST(Filter, ClearsTheMessageOfAnEarlierRun) {
  LoadedFilter loaded;
  MeshDocument empty;
  EXPECT_FALSE(loaded.apply(empty, loaded.parameters(empty)));
  EXPECT_FALSE(loaded.message().empty());
  MeshDocument document;
  add_layer(document, grain());
  EXPECT_TRUE(loaded.apply(document, loaded.parameters(document)));
  EXPECT_TRUE(loaded.message().empty());
}

TEST(Filter, TakesDefaultsForMissingParametersAndRefusesWrongTypes) {
  LoadedFilter loaded;
  MeshDocument document;
  MeshModel& scan = add_layer(document, grain());
  RichParameterList only_count;
  only_count.addParam(RichInt("NodeCount", 50));
  EXPECT_TRUE(loaded.apply(document, only_count)) << loaded.message();
  EXPECT_EQ(document.mm()->cm.vn, 50);

  document.setCurrentMesh(scan.id());
  RichParameterList wrong_type;
  wrong_type.addParam(RichString("NodeCount", "50"));
  EXPECT_FALSE(loaded.apply(document, wrong_type));
  EXPECT_TRUE(QString::fromStdString(loaded.message()).contains("NodeCount")) << loaded.message();
}

TEST(Filter, TakesFilesOfOlderScriptsAsTexts) {
  QTemporaryDir folder;
  const QString report = folder.filePath("report.csv");
  LoadedFilter loaded;
  MeshDocument document;
  add_layer(document, grain());
  RichParameterList list;
  list.addParam(RichInt("NodeCount", 50));
  list.addParam(RichString("ReportFile", report));
  EXPECT_TRUE(loaded.apply(document, list)) << loaded.message();
  EXPECT_TRUE(QFileInfo::exists(report));
}

/// The parameters that a script of the project gives once some of its values are replaced.
RichParameterList parameters_of_script(const std::map<std::string, std::string>& values) {
  const QTemporaryDir folder;
  const QString path = folder.filePath("script.mlx");
  write_script(values, path);
  FilterScript script;
  if (!script.open(path)) throw std::runtime_error("The script cannot be read");
  return parameters_of(script, 0);
}

TEST(Filter, WarnsOfValuesInAScriptThatCannotBeRead) {
  // Every version drops them and says nothing; meshlabserver then ends itself, see its tests.
  for (const auto& [name, value] : std::map<std::string, std::string>{{"HarmonicDegree", "abc"},
                                                                      {"ErrorTarget", "1,5"},
                                                                      {"FoldLimit", ""},
                                                                      {"CurvatureAlpha", "one"},
                                                                      {"Distances", "yes"},
                                                                      {"Weighting", "area"}}) {
    SCOPED_TRACE(name + " = " + value);
    LoadedFilter loaded;
    MeshDocument document;
    add_layer(document, grain());
    ASSERT_TRUE(loaded.apply(document, parameters_of_script({{"NodeCount", "50"}, {name, value}})))
        << loaded.message();
    const auto& lines = loaded.log_entries();
    ASSERT_GE(lines.size(), 3);
    EXPECT_EQ(lines.back().first, GLLogStream::WARNING);
    EXPECT_EQ(
        lines.back().second.toStdString(),
        "Warning: " + name + " is missing from the script or not readable. The default was used.");
  }
}

TEST(Filter, SaysWhatItReadFromAScriptThatLacksMost) {
  LoadedFilter loaded;
  MeshDocument document;
  add_layer(document, grain());
  RichParameterList few;
  few.addParam(RichInt("NodeCount", 50));
  few.addParam(RichInt("HarmonicDegree", 10));
  few.addParam(RichBool("Distances", true));
  ASSERT_TRUE(loaded.apply(document, few)) << loaded.message();
  EXPECT_TRUE(
      loaded.log().contains("Warning: Only NodeCount, Distances and HarmonicDegree could be read "
                            "from the script. All other parameters have their defaults."))
      << loaded.log().join("\n").toStdString();
  // A dialog gives all, and nothing is said.
  LoadedFilter again;
  ASSERT_TRUE(again.apply(document, again.parameters(document))) << again.message();
  EXPECT_FALSE(again.log().join("\n").contains("script"));
}

TEST(Filter, WarnsOfWhatAScriptMisspells) {
  // The window adds its own settings to a dialog's values, so names that the filter does not know
  // are no fault; the one that is missing for it is told.
  LoadedFilter loaded;
  MeshDocument document;
  add_layer(document, grain());
  RichParameterList misspelled;
  for (const RichParameter& parameter : loaded.parameters(document)) {
    if (parameter.name() == "Weighting") {
      misspelled.addParam(RichInt("Weigthing", 3));
    } else {
      misspelled.addParam(parameter);
    }
  }
  ASSERT_TRUE(loaded.apply(document, misspelled)) << loaded.message();
  EXPECT_TRUE(loaded.log().contains(
      "Warning: Weighting is missing from the script or not readable. The default was used."))
      << loaded.log().join("\n").toStdString();
}

TEST(Filter, RefusesAScriptWhoseNodeCountIsMissingOrCannotBeRead) {
  // Every version drops a value that it cannot read; the default is not what was asked for.
  LoadedFilter loaded;
  for (const char* const value : {"abc", "200.7", "99999999999", ""}) {
    SCOPED_TRACE(value);
    MeshDocument document;
    add_layer(document, grain());
    const auto before = state_of(document);
    EXPECT_FALSE(loaded.apply(document, parameters_of_script({{"NodeCount", value}})));
    EXPECT_TRUE(state_of(document) == before) << "the document has changed";
    EXPECT_NE(loaded.message().find("NodeCount is missing"), std::string::npos) << loaded.message();
  }
  MeshDocument document;
  add_layer(document, grain());
  EXPECT_TRUE(loaded.apply(document, parameters_of_script({{"NodeCount", "200"}})))
      << loaded.message();
  EXPECT_EQ(document.mm()->cm.vn, 200);
}

/// A whole sentence with all the words in it, whatever their case.
void expect_sentence(const QString& message, const std::vector<std::string>& words) {
  EXPECT_GT(message.size(), 20);
  EXPECT_TRUE(message.endsWith('.')) << message.toStdString();
  for (const std::string& word : words) {
    EXPECT_TRUE(message.contains(QString::fromStdString(word), Qt::CaseInsensitive))
        << word << " is not in: " << message.toStdString();
  }
}

TEST(Filter, RemeshesTheScanAgainWhenTheResultIsCurrent) {
  LoadedFilter loaded;
  MeshDocument document;
  MeshModel& scan = add_layer(document, grain());
  RichParameterList parameters = loaded.parameters(document);
  parameters.setValue("NodeCount", IntValue(120));
  parameters.setValue("Weighting", EnumValue(2));
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  const LayerState wanted = state_of(*document.mm());
  parameters.setValue("NodeCount", IntValue(200));
  document.setCurrentMesh(scan.id());
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();

  // Now the remesh of 200 nodes is current.
  MeshModel& second = *document.mm();
  parameters.setValue("NodeCount", IntValue(120));
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  MeshModel& third = *document.mm();
  LayerState actual = state_of(third);
  EXPECT_TRUE(actual.label.startsWith("scan WSCVT-C 120")) << actual.label.toStdString();
  actual.label = wanted.label;
  EXPECT_TRUE(actual == wanted) << "not a remesh of the scan";
  EXPECT_TRUE(is_shown(third));
  EXPECT_FALSE(is_shown(second));
  EXPECT_FALSE(is_shown(scan));
  const std::string log = loaded.log().join("\n").toStdString();
  EXPECT_NE(log.find("'scan WSCVT-C 200' is a remesh of 'scan.ply'"), std::string::npos) << log;
  // MeshLab scrolls to the end, so the note is before the verdict.
  EXPECT_NE(loaded.log().back().indexOf("120 nodes"), -1) << log;

  // In place, the earlier remesh is what is replaced.
  parameters.setValue("NodeCount", IntValue(90));
  parameters.setValue("NewLayer", BoolValue(false));
  const LayerState scan_before = state_of(scan);
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  EXPECT_EQ(document.mm(), &third);
  EXPECT_EQ(third.cm.vn, 90);
  EXPECT_EQ(third.label().toStdString(), "scan WSCVT-C 90");
  EXPECT_TRUE(state_of(scan) == scan_before);
}

TEST(Filter, RemeshesARemeshThatWasChangedOrWhoseScanIsGone) {
  for (const bool changed : {true, false}) {
    LoadedFilter loaded;
    MeshDocument document;
    MeshModel& scan = add_layer(document, grain());
    RichParameterList parameters = loaded.parameters(document);
    parameters.setValue("NodeCount", IntValue(400));
    ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
    if (changed) {
      for (auto& vertex : document.mm()->cm.vert) vertex.P() *= 2;
    } else {
      remove_layer(document, scan);
    }
    const IndexedMesh source = filter::to_indexed_mesh(document.mm()->cm);
    RemeshOptions options = filter::read_remesh_settings({}).options;
    options.node_count = 100;
    const IndexedMesh wanted = remesh(source, options).mesh;
    parameters.setValue("NodeCount", IntValue(100));
    ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
    const IndexedMesh actual = filter::to_indexed_mesh(document.mm()->cm);
    ASSERT_EQ(actual.points.size(), wanted.points.size());
    for (std::size_t v = 0; v < wanted.points.size(); ++v) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(actual.points[v][k], static_cast<Scalarm>(wanted.points[v][k]));
      }
    }
    EXPECT_EQ(document.mm()->label().toStdString(), "scan WSCVT-D 100") << "names pile up";
  }
}

TEST(Filter, PutsFilesWithoutAFolderBesideTheScanAndSaysWhere) {
  QTemporaryDir folder;
  LoadedFilter loaded;
  MeshDocument document;
  MeshModel& scan = *document.addNewMesh(folder.filePath("sand.ply"), "sand.ply", true);
  filter::assign(scan.cm, grain(), std::vector<double>(grain().points.size(), 0.25));
  update_box_and_normals(scan);
  RichParameterList parameters = loaded.parameters(document);
  parameters.setValue("NodeCount", IntValue(60));
  set_from_text(parameters, "ReportFile", "report.csv");
  set_from_text(parameters, "CoefficientsFile", "series.json");
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  for (const QString& name : {folder.filePath("report.csv"), folder.filePath("series.json")}) {
    EXPECT_TRUE(QFileInfo::exists(name)) << name.toStdString();
    EXPECT_TRUE(loaded.log().join("\n").contains(name)) << loaded.log().join("\n").toStdString();
  }
  // The remesh is current and has no file of its own: its scan has.
  QFile::remove(folder.filePath("report.csv"));
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  EXPECT_TRUE(QFileInfo::exists(folder.filePath("report.csv")));
}

TEST(Filter, CountsTheIntersectionsOfTheLayer) {
  // A plate thinner than a float's step where it lies, .0039.
  const IndexedMesh plate = mapped_sphere(40, 80, [](const Vector3& u) {
    return Vector3(u.x(), u.y() + 0.3 * u.x(), 0.002 * u.z() + 0.2 * u.x() - 0.3 * u.y());
  });
  std::size_t all = 0;
  for (const int nodes : {600, 1000, 1500}) {
    LoadedFilter loaded;
    const QTemporaryDir folder;
    MeshDocument document;
    add_layer(document, moved(plate, Vector3::Constant(std::ldexp(1.0, 15))));
    RichParameterList parameters = loaded.parameters(document);
    parameters.setValue("NodeCount", IntValue(nodes));
    set_from_text(parameters, "ReportFile", folder.filePath("report.json").toStdString());
    ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
    const std::size_t pairs = self_intersections(filter::to_indexed_mesh(document.mm()->cm)).size();
    all += pairs;
    QFile report(folder.filePath("report.json"));
    ASSERT_TRUE(report.open(QIODevice::ReadOnly));
    EXPECT_EQ(QJsonDocument::fromJson(report.readAll())["on_scan"]["self_intersections"].toInt(),
              static_cast<int>(pairs));
  }
  // Layers of doubles are not rounded.
  if (sizeof(Scalarm) == sizeof(float)) {
    EXPECT_GT(all, 0U);
  }
}

TEST(Filter, LogsWarningsAsWarningsAboveTheVerdict) {
  LoadedFilter loaded;
  MeshDocument document;
  add_layer(document, grain());
  RichParameterList parameters = loaded.parameters(document);
  // A dozen nodes are far from any scan.
  parameters.setValue("NodeCount", IntValue(12));
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  const auto& lines = loaded.log_entries();
  ASSERT_GE(lines.size(), 3);
  // MeshLab scrolls its log to the end: behind a warning there are warnings and the verdict.
  EXPECT_TRUE(lines.back().second.contains(": look at: The remesh"));
  bool warned = false;
  for (const auto& [level, line] : lines) {
    if (line == lines.back().second) continue;
    warned = warned || level == GLLogStream::WARNING;
    EXPECT_EQ(level == GLLogStream::WARNING, warned) << line.toStdString();
    EXPECT_EQ(line.startsWith("Warning: "), warned) << line.toStdString();
  }
}

TEST(Filter, HandsBackItsResultsWhereTheHostTakesThem) {
  if (!host_takes_values) GTEST_SKIP() << "this version's filters hand back nothing";
  LoadedFilter loaded;
  MeshDocument document;
  add_layer(document, grain());
  RichParameterList parameters = loaded.parameters(document);
  parameters.setValue("NodeCount", IntValue(300));
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  EXPECT_EQ(loaded.values().at("vertices"), 300.0);
  EXPECT_EQ(loaded.values().at("faces"), 596.0);
  const double from = loaded.values().at("volume_scan");
  const double to = loaded.values().at("volume");
  EXPECT_NEAR(loaded.values().at("volume_error_percent"), 100.0 * (to / from - 1.0), 1e-9);
}

TEST(DescriptorFilter, FindsTheReferenceHoweverItsLayerIsCalled) {
  LoadedFilter loaded(descriptor_menu_text);
  MeshDocument document;
  MeshModel& scan = add_layer(document, grain());
  scan.setLabel("sand 0.5.ply");
  MeshModel& other = add_layer(document, sphere());
  other.setLabel("ball");
  const std::string number = std::to_string(scan.id());
  for (const std::string& name :
       {std::string("sand 0.5.ply"), std::string("sand 0.5"), number, number + " sand 0.5.ply",
        number + "  sand 0.5.ply *", std::string("sand 0.5.ply *")}) {
    RichParameterList parameters = loaded.parameters(document);
    set_from_text(parameters, "ReferenceLayer", name);
    ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
    EXPECT_TRUE(loaded.log().join("\n").contains("Reference   sand 0.5.ply")) << name;
  }
  for (const std::string& name : {std::string("sand"), std::string("77"), std::string("0 ball")}) {
    RichParameterList parameters = loaded.parameters(document);
    set_from_text(parameters, "ReferenceLayer", name);
    EXPECT_FALSE(loaded.apply(document, parameters)) << name;
    expect_sentence(QString::fromStdString(loaded.message()), {name, "'ball'", "'sand 0.5.ply'"});
  }
}

TEST(DescriptorFilter, TellsNamesOfDigitsFromNumbers) {
  LoadedFilter loaded(descriptor_menu_text);
  MeshDocument document;
  MeshModel& first = add_layer(document, grain());
  MeshModel& second = add_layer(document, sphere());
  // More than an int holds, and the number of the other layer.
  second.setLabel("20240101123000.ply");
  const std::string number = std::to_string(second.id());
  first.setLabel(QString::fromStdString(number + ".ply"));
  RichParameterList parameters = loaded.parameters(document);
  set_from_text(parameters, "ReferenceLayer", "20240101123000");
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  EXPECT_TRUE(loaded.log().join("\n").contains("Reference   20240101123000.ply"));
  set_from_text(parameters, "ReferenceLayer", number);
  EXPECT_FALSE(loaded.apply(document, parameters));
  const std::string advised = std::to_string(first.id()) + " " + number + ".ply";
  expect_sentence(QString::fromStdString(loaded.message()), {"two layers", ": " + advised + "."});
  set_from_text(parameters, "ReferenceLayer", advised);
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  EXPECT_TRUE(
      loaded.log().join("\n").contains(QString::fromStdString("Reference   " + number + ".ply")));
}

TEST(DescriptorFilter, LogIsNoWiderThanThePanel) {
  LoadedFilter loaded(descriptor_menu_text);
  MeshDocument document;
  MeshModel& scan = add_layer(document, grain());
  scan.setLabel("ball.ply");
  add_layer(document, sphere()).setLabel("scan.ply");
  for (const char* reference : {"", "ball.ply"}) {
    RichParameterList parameters = loaded.parameters(document);
    set_from_text(parameters, "ReferenceLayer", reference);
    ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
    const QStringList lines = loaded.log();
    EXPECT_GT(lines.size(), 40);
    for (const QString& line : lines) {
      // Warnings, their names and the layers are sentences, which the panel breaks.
      if (line.contains(QRegularExpression("^(Warning|Look at|Layer|Reference)\\b"))) continue;
      EXPECT_LE(line.size(), static_cast<int>(filter::log_width)) << line.toStdString();
    }
  }
}

TEST(DescriptorFilter, MeasuresBothLayersAsTheyAreShown) {
  LoadedFilter loaded(descriptor_menu_text);
  MeshDocument document;
  // Turned, moved and half as large by its transform; and the same points without one.
  Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();
  transform.topLeftCorner<3, 3>() =
      0.5 * Eigen::AngleAxisd(0.7, Vector3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  transform.topRightCorner<3, 1>() = Vector3(3.0, -1.0, 2.0);
  const IndexedMesh there = filter::transformed(grain(), transform);
  MeshModel& moved_layer = add_layer(document, grain());
  moved_layer.setLabel("moved");
  set_transform(moved_layer, transform);
  MeshModel& plain = add_layer(document, there);
  plain.setLabel("plain");
  const QTemporaryDir folder;
  for (const auto& [current, reference] :
       {std::pair(&moved_layer, std::string("plain")), std::pair(&plain, std::string("moved"))}) {
    document.setCurrentMesh(current->id());
    RichParameterList parameters = loaded.parameters(document);
    set_from_text(parameters, "ReferenceLayer", reference);
    set_from_text(parameters, "ReportFile", folder.filePath("report.json").toStdString());
    ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
    QFile report(folder.filePath("report.json"));
    ASSERT_TRUE(report.open(QIODevice::ReadOnly));
    const QJsonValue distances = QJsonDocument::fromJson(report.readAll())["distances"];
    ASSERT_TRUE(distances["largest_distance"].isDouble());
    // Coordinates of 4 as floats.
    EXPECT_LT(distances["largest_distance"].toDouble(), 1e-5) << reference;
  }
}

TEST(Layers, LabelsOfRemeshesDoNotPileUp) {
  EXPECT_EQ(filter::without_ending("sand.ply"), "sand");
  EXPECT_EQ(filter::without_ending("sand 0.5"), "sand 0.5");
  EXPECT_EQ(filter::without_ending("sand.v2.3ds"), "sand.v2");
  EXPECT_EQ(filter::remesh_label("sand.ply", "Area", 70), "sand Area 70");
  EXPECT_EQ(filter::remesh_label("sand WSCVT-D 1000", "Area", 70), "sand Area 70");
  EXPECT_EQ(filter::remesh_label("sand WSCVT-D 1000 WSCVT-C 9.ply", "Area", 70), "sand Area 70");
  EXPECT_EQ(filter::remesh_label("Area 51", "Area", 70), "Area 51 Area 70");
}

class FilterRefuses : public ::testing::TestWithParam<Call> {};

TEST_P(FilterRefuses, WithASentenceAndChangesNothing) {
  const Call& call = GetParam();
  LoadedFilter loaded;
  for (const bool new_layer : {true, false}) {
    MeshDocument document;
    if (call.mesh) add_layer(document, *call.mesh);
    RichParameterList parameters = loaded.parameters(document);
    parameters.setValue("NewLayer", BoolValue(new_layer));
    for (const auto& [name, value] : call.parameters) set_from_text(parameters, name, value);
    const auto before = state_of(document);
    EXPECT_FALSE(loaded.apply(document, parameters));
    EXPECT_TRUE(state_of(document) == before) << "the document has changed";
    expect_sentence(QString::fromStdString(loaded.message()), call.words);
  }
}

INSTANTIATE_TEST_SUITE_P(, FilterRefuses, ::testing::ValuesIn(refused_calls()),
                         [](const auto& test) { return test.param.name; });

class DescriptorFilterRefuses : public ::testing::TestWithParam<Call> {};

TEST_P(DescriptorFilterRefuses, WithASentenceAndChangesNothing) {
  const Call& call = GetParam();
  LoadedFilter loaded(descriptor_menu_text);
  MeshDocument document;
  if (call.mesh) add_layer(document, *call.mesh);
  RichParameterList parameters = loaded.parameters(document);
  for (const auto& [name, value] : call.parameters) set_from_text(parameters, name, value);
  const auto before = state_of(document);
  EXPECT_FALSE(loaded.apply(document, parameters));
  EXPECT_TRUE(state_of(document) == before) << "the document has changed";
  expect_sentence(QString::fromStdString(loaded.message()), call.words);
}

INSTANTIATE_TEST_SUITE_P(, DescriptorFilterRefuses, ::testing::ValuesIn(unmeasurable_calls()),
                         [](const auto& test) { return test.param.name; });

TEST(DescriptorFilter, RefusesAReferenceThatTwoLayersAreCalled) {
  LoadedFilter loaded(descriptor_menu_text);
  MeshDocument document;
  add_layer(document, grain());
  // MeshLab numbers equal labels of new layers, but a user can rename them.
  add_layer(document, sphere()).setLabel("twin");
  add_layer(document, sphere()).setLabel("twin");
  RichParameterList parameters = loaded.parameters(document);
  set_from_text(parameters, "ReferenceLayer", "twin");
  const auto before = state_of(document);
  EXPECT_FALSE(loaded.apply(document, parameters));
  EXPECT_TRUE(state_of(document) == before) << "the document has changed";
  expect_sentence(QString::fromStdString(loaded.message()), {"twin", "two layers"});
}

TEST(DescriptorFilter, RefusesAReferenceThatCannotBeMeasuredByItsName) {
  LoadedFilter loaded(descriptor_menu_text);
  MeshDocument document;
  add_layer(document, without_a_patch()).setLabel("torn");
  add_layer(document, grain());
  RichParameterList parameters = loaded.parameters(document);
  set_from_text(parameters, "ReferenceLayer", "torn");
  const auto before = state_of(document);
  EXPECT_FALSE(loaded.apply(document, parameters));
  EXPECT_TRUE(state_of(document) == before) << "the document has changed";
  expect_sentence(QString::fromStdString(loaded.message()), {"torn", "boundary"});
}

class FilterCopesWith : public ::testing::TestWithParam<Call> {};

TEST_P(FilterCopesWith, AnUnusualCall) {
  const Call& call = GetParam();
  LoadedFilter loaded;
  MeshDocument document;
  add_layer(document, *call.mesh);
  RichParameterList parameters = loaded.parameters(document);
  for (const auto& [name, value] : call.parameters) set_from_text(parameters, name, value);
  ASSERT_TRUE(loaded.apply(document, parameters)) << loaded.message();
  const int nodes = parameters.getInt("NodeCount");
  EXPECT_EQ(document.mm()->cm.vn, nodes);
  EXPECT_EQ(document.mm()->cm.fn, 2 * nodes - 4);
  for (const auto& vertex : document.mm()->cm.vert) {
    EXPECT_TRUE(std::isfinite(vertex.cP()[0] + vertex.cP()[1] + vertex.cP()[2] + vertex.cQ()));
  }
}

INSTANTIATE_TEST_SUITE_P(, FilterCopesWith, ::testing::ValuesIn(extreme_calls()),
                         [](const auto& test) { return test.param.name; });

TEST(FilterParameters, TypedValueIsTheShortestDecimal) {
  EXPECT_EQ(filter::typed_value(0.1F), 0.1);
  EXPECT_EQ(filter::typed_value(5.0F), 5.0);
  EXPECT_EQ(filter::typed_value(-2.75F), -2.75);
  EXPECT_EQ(filter::typed_value(1e-6F), 1e-6);
  EXPECT_TRUE(std::isnan(filter::typed_value(std::nanf(""))));
  EXPECT_TRUE(std::isinf(filter::typed_value(HUGE_VALF)));
  // Of hosts that hold doubles: read as a float, or not.
  EXPECT_EQ(filter::typed_value(static_cast<double>(3.1F)), 3.1);
  EXPECT_EQ(filter::typed_value(0.123456789012), 0.123456789012);
  EXPECT_TRUE(std::isnan(filter::typed_value(std::nan(""))));
  EXPECT_TRUE(std::isinf(filter::typed_value(HUGE_VAL)));
}

TEST(FilterParameters, EachReachesItsOwnOption) {
  const QTemporaryDir folder;
  const std::string report = folder.filePath("r.json").toStdString();
  const std::string coefficients = folder.filePath("c.json").toStdString();
  filter::ParameterValues values = {
      {"NodeCount", 321.0},     {"ErrorTarget", 1.25},  {"TargetMeasure", 2.0},
      {"HarmonicDegree", 7.0},  {"MendLimit", 12.5},    {"Points", 1.0},
      {"NewLayer", 0.0},        {"Distances", 1.0},     {"Quality", 1.0},
      {"ColorByQuality", 1.0},  {"ReportFile", report}, {"CoefficientsFile", coefficients},
      {"CurvatureAlpha", -1.5}, {"EdgeRatio", 1.3},     {"KeepColors", 0.0}};
  const filter::RemeshSettings all = filter::read_remesh_settings(values);
  EXPECT_EQ(all.options.node_count, 321);
  EXPECT_EQ(all.options.target.percent, 1.25);
  EXPECT_EQ(static_cast<int>(all.options.target.measure), 2);
  EXPECT_EQ(all.options.target.largest_node_count, ErrorTarget().largest_node_count);
  EXPECT_EQ(all.options.degree, 7);
  EXPECT_EQ(all.options.max_repaired_area_percent, 12.5);
  EXPECT_TRUE(all.options.points && all.options.measures.distances);
  EXPECT_TRUE(all.options.measures.node_curvatures && all.options.measures.series);
  EXPECT_FALSE(all.new_layer || all.keep_attributes);
  EXPECT_EQ(all.result.quality, filter::VertexQuality::Curvature);
  EXPECT_TRUE(all.result.colour_by_quality);
  EXPECT_EQ(all.result.report_file, report);
  EXPECT_EQ(all.coefficients_file, coefficients);
  EXPECT_EQ(std::get<OnScanOptions>(all.options.method).curvature_alpha, -1.5);
  EXPECT_EQ(std::get<OnScanOptions>(all.options.method).edge_ratio, 1.3);
  // A search from more nodes than it may take goes that far.
  const filter::ParameterValues many = {{"NodeCount", 500000.0}};
  EXPECT_EQ(filter::read_remesh_settings(many).options.target.largest_node_count, 500000);

  values = {{"Method", 1.0}, {"CurvatureAlpha", 0.5}, {"FoldLimit", 2.5}};
  const auto published =
      std::get<AsPublishedOptions>(filter::read_remesh_settings(values).options.method);
  EXPECT_EQ(published.curvature_alpha, 0.5);
  EXPECT_EQ(published.max_overhang_percent, 2.5);

  values = {{"Surface", 1.0},       {"SemiAxisX", 1.1},         {"SemiAxisY", 1.2},
            {"SemiAxisZ", 1.3},     {"PolarExponent", 0.4},     {"AzimuthalExponent", 0.6},
            {"NodeCount", 77.0},    {"Quality", 3.0},           {"ColorByQuality", 1.0},
            {"ReportFile", report}, {"CoefficientDegree", 3.0}, {"CurvatureAlpha", -0.5}};
  const filter::CreationSettings made = filter::read_creation_settings(values);
  EXPECT_EQ(made.surface.kind, SurfaceKind::Superellipsoid);
  EXPECT_EQ(made.surface.semi_axes, Vector3(1.1, 1.2, 1.3));
  EXPECT_EQ(made.surface.polar_exponent, 0.4);
  EXPECT_EQ(made.surface.azimuthal_exponent, 0.6);
  EXPECT_EQ(made.surface.coefficient_degree, 3);
  EXPECT_EQ(made.options.node_count, 77);
  EXPECT_EQ(std::get<OnScanOptions>(made.options.method).curvature_alpha, -0.5);
  EXPECT_EQ(made.result.quality, filter::VertexQuality::OriginalDistance);
  EXPECT_TRUE(made.options.measures.distances && made.result.colour_by_quality);
  EXPECT_EQ(made.result.report_file, report);

  const filter::DescriptorSettings described =
      filter::read_descriptor_settings({{"RoundnessBall", 0.3},
                                        {"RoughnessCutoff", 0.7},
                                        {"ReferenceLayer", std::string("scan")},
                                        {"ReportFile", report}});
  EXPECT_EQ(described.options.roundness_ball, 0.3);
  EXPECT_EQ(described.options.roughness_cutoff, 0.7);
  EXPECT_EQ(described.reference_layer, "scan");
  EXPECT_EQ(described.report_file, report);
}

TEST(FilterParameters, ChoicesAreThoseOfTheirNames) {
  const auto on_scan = [](const filter::ParameterValues& values) {
    return std::get<OnScanOptions>(filter::read_remesh_settings(values).options.method);
  };
  EXPECT_EQ(on_scan({{"Weighting", 1.0}}).weighting, CellWeighting::Area);
  EXPECT_EQ(on_scan({{"Weighting", 2.0}}).weighting, CellWeighting::Curvature);
  EXPECT_EQ(on_scan({{"Placement", 1.0}}).placement, ScanPlacement::OnSurface);
  EXPECT_EQ(on_scan({{"Placement", 2.0}}).placement, ScanPlacement::Fitted);
  EXPECT_EQ(on_scan({{"Placement", 3.0}}).placement, ScanPlacement::ContactFit);
  const auto published = [](filter::ParameterValues values) {
    values["Method"] = 1.0;
    return std::get<AsPublishedOptions>(filter::read_remesh_settings(values).options.method);
  };
  EXPECT_EQ(published({{"Weighting", 0.0}}).weighting, Weighting::Constant);
  EXPECT_EQ(published({{"Weighting", 1.0}}).weighting, Weighting::RadialDistance);
  EXPECT_EQ(published({{"Weighting", 2.0}}).weighting, Weighting::Curvature);
  EXPECT_EQ(published({{"Weighting", 3.0}}).weighting, Weighting::Area);
  EXPECT_EQ(published({{"Placement", 0.0}}).placement, PublishedPlacement::Series);
  EXPECT_EQ(published({{"Placement", 1.0}}).placement, PublishedPlacement::Surface);
}

TEST(FilterParameters, DefaultsAreTheLibrarysAndLieInTheirRanges) {
  const RemeshOptions options = filter::read_remesh_settings({}).options;
  const RemeshOptions defaults;
  EXPECT_EQ(options.node_count, defaults.node_count);
  EXPECT_EQ(options.target.measure, defaults.target.measure);
  EXPECT_EQ(options.target.percent, defaults.target.percent);
  EXPECT_EQ(options.target.largest_node_count, defaults.target.largest_node_count);
  EXPECT_EQ(options.degree, defaults.degree);
  EXPECT_EQ(options.max_repaired_area_percent, defaults.max_repaired_area_percent);
  EXPECT_EQ(options.measures.distances, defaults.measures.distances);
  const auto& on_scan = std::get<OnScanOptions>(options.method);
  const OnScanOptions usual;
  EXPECT_EQ(on_scan.weighting, usual.weighting);
  EXPECT_EQ(on_scan.curvature_alpha, usual.curvature_alpha);
  EXPECT_EQ(on_scan.placement, usual.placement);
  EXPECT_EQ(on_scan.edge_ratio, usual.edge_ratio);
  const RemeshOptions as_published = filter::read_remesh_settings({{"Method", 1.0}}).options;
  const auto& published = std::get<AsPublishedOptions>(as_published.method);
  EXPECT_EQ(published.weighting, AsPublishedOptions().weighting);
  EXPECT_EQ(published.placement, AsPublishedOptions().placement);
  EXPECT_EQ(published.max_overhang_percent, AsPublishedOptions().max_overhang_percent);
  const DetailedOptions details = filter::read_descriptor_settings({}).options;
  EXPECT_EQ(details.roundness_ball, DetailedOptions().roundness_ball);
  EXPECT_EQ(details.roughness_cutoff, DetailedOptions().roughness_cutoff);

  for (const filter::ParameterList& list :
       {filter::remesh_parameters(), filter::creation_parameters(),
        filter::descriptor_parameters()}) {
    for (const filter::FilterParameter& parameter : list) {
      SCOPED_TRACE(parameter.name);
      const auto read = [&](const filter::ParameterValue& value) {
        return filter::CheckedValues(list, {{parameter.name, value}});
      };
      if (filter::holds_text(parameter.kind)) {
        EXPECT_NO_THROW(read(std::string("name")));
        EXPECT_ANY_THROW(read(1.0));
        continue;
      }
      EXPECT_NO_THROW(read(parameter.default_value));
      EXPECT_NO_THROW(read(parameter.minimum));
      EXPECT_NO_THROW(read(parameter.maximum));
      EXPECT_ANY_THROW(read(parameter.minimum - 1));
      EXPECT_ANY_THROW(read(parameter.maximum + 1));
      EXPECT_ANY_THROW(read(std::nan("")));
      EXPECT_ANY_THROW(read(std::string("1")));
    }
  }
}

}  // namespace
}  // namespace wscvt::host_test
