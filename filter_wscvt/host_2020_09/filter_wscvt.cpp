// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_wscvt.h"

#include <vcg/complex/algorithms/update/color.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <optional>
#include <utility>

#include "creation_filter.h"
#include "descriptor_filter.h"
#include "log_text.h"
#include "mesh_conversion.h"
#include "node_parameters.h"
#include "parameters.h"
#include "remesh_filter.h"
#include "remesh_report.h"
#include "wscvt/base/error.h"
#include "wscvt/base/execution.h"
#include "wscvt/remesh.h"
#include "wscvt/surface/harmonic_io.h"

namespace {

using namespace wscvt::filter;

enum Filter : MeshFilterInterface::FilterIDType { Remesh, Create, Describe };

/// What the host asks about a filter.
struct FilterDescription {
  std::string name;
  std::string help;
  ParameterList parameters;
  MeshFilterInterface::FilterClass menu;
  MeshFilterInterface::FILTER_ARITY arity;
  int changes;  ///< parts of a mesh that are not as before
};

/// A new or changed mesh with its quality and, when asked for, its colour.
constexpr int mesh_changes = MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL |
                             MeshModel::MM_VERTNUMBER | MeshModel::MM_VERTQUALITY |
                             MeshModel::MM_VERTCOLOR | MeshModel::MM_FACEVERT |
                             MeshModel::MM_FACENORMAL | MeshModel::MM_FACENUMBER;

FilterDescription description_of(MeshFilterInterface::FilterIDType filter) {
  switch (filter) {
    case Create:
      return {creation_name(),           creation_help(),
              creation_parameters(),     MeshFilterInterface::MeshCreation,
              MeshFilterInterface::NONE, mesh_changes};
    case Describe:
      return {descriptor_name(),
              descriptor_help(),
              descriptor_parameters(),
              MeshFilterInterface::Measure,
              MeshFilterInterface::SINGLE_MESH,
              MeshModel::MM_NONE};
    default:
      return {remesh_name(),
              remesh_help(),
              remesh_parameters(),
              MeshFilterInterface::Remeshing,
              MeshFilterInterface::SINGLE_MESH,
              mesh_changes};
  }
}

/// The parts of a result that MeshLab does not hold by default.
constexpr int result_mask = MeshModel::MM_VERTQUALITY;

/// Value of a parameter. The host's getters end the program when a script gave the
/// parameter another type, so the type is checked first.
ParameterValue value_of(const FilterParameter& parameter, const Value& value) {
  switch (parameter.kind) {
    case ParameterKind::Integer:
    case ParameterKind::Choice:
      if (value.isInt()) return static_cast<double>(value.getInt());
      break;
    case ParameterKind::Real:
      if (value.isFloat()) return typed_value(value.getFloat());
      if (value.isInt()) return static_cast<double>(value.getInt());
      break;
    case ParameterKind::Flag:
      if (value.isBool()) return value.getBool() ? 1.0 : 0.0;
      break;
    case ParameterKind::Text:
      if (value.isString()) return value.getString().trimmed().toStdString();
      break;
  }
  throw wscvt::Error(wscvt::ErrorCode::InvalidInput,
                     "Parameter " + parameter.name + " has the type " +
                         value.typeName().toStdString() +
                         ", which does not fit; take the types from the filter's own scripts.");
}

ParameterValues values_of(const ParameterList& known, const RichParameterList& parameters) {
  ParameterValues values;
  for (const FilterParameter& parameter : known) {
    const QString name = QString::fromStdString(parameter.name);
    if (!parameters.hasParameter(name)) continue;
    values[parameter.name] = value_of(parameter, parameters.getParameterByName(name).value());
  }
  return values;
}

wscvt::ProgressCallback progress_to(vcg::CallBackPos* callback) {
  if (callback == nullptr) return {};
  return [callback](double fraction, const std::string& stage) {
    return callback(static_cast<int>(100.0 * fraction), stage.c_str());
  };
}

/// MeshLab's window renders the log as HTML; meshlabserver, which has no window, prints it.
bool log_is_shown_as_html() {
  const QWidgetList widgets = QApplication::topLevelWidgets();
  return std::any_of(widgets.begin(), widgets.end(),
                     [](const QWidget* widget) { return widget->inherits("QMainWindow"); });
}

wscvt::Error no_mesh() {
  return {wscvt::ErrorCode::InvalidInput, "There is no mesh to work on; open a scan first."};
}

/// Puts the result into a layer, which keeps its transform.
void fill_layer(MeshModel& layer, const wscvt::RemeshResult& result,
                const ResultSettings& settings) {
  // Adjacency, colours, texture coordinates and the like belong to the elements that go.
  const int kept = MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL | MeshModel::MM_VERTFLAG |
                   MeshModel::MM_FACEVERT | MeshModel::MM_FACENORMAL | MeshModel::MM_FACEFLAG |
                   MeshModel::MM_TRANSFMATRIX;
  layer.clearDataMask(~kept);
  const std::vector<double>& quality = quality_values(result, settings.quality);
  assign(layer.cm, result.mesh, quality);
  layer.cm.svn = 0;
  layer.cm.sfn = 0;
  layer.updateDataMask(result_mask);
  if (settings.colour_by_quality) {
    layer.updateDataMask(MeshModel::MM_VERTCOLOR);
    // Left to find the range itself, the ramp adds an attribute to the mesh that is never freed.
    const auto [low, high] = std::minmax_element(quality.begin(), quality.end());
    const auto red = static_cast<Scalarm>(*low);
    const auto blue = std::max(static_cast<Scalarm>(*high),
                               std::nextafter(red, std::numeric_limits<Scalarm>::max()));
    vcg::tri::UpdateColor<CMeshO>::PerVertexQualityRamp(layer.cm, red, blue);
  }
  layer.UpdateBoxAndNormals();
}

/// Adds a current layer with the result; `source`, if there is one, gives it its transform.
void add_layer(MeshDocument& document, const QString& name, const MeshModel* source,
               const wscvt::RemeshResult& result, const ResultSettings& settings) {
  const MeshModel* before = document.mm();
  // One call for all: a name may hold %1 itself.
  const QString label = QStringLiteral("%1 %2 %3")
                            .arg(name, QString::fromStdString(nodes_name(result.options)),
                                 QString::number(result.mesh.points.size()));
  MeshModel* layer = document.addNewMesh(QString(), label, true);
  try {
    if (source != nullptr) layer->cm.Tr = source->cm.Tr;
    fill_layer(*layer, result, settings);
  } catch (...) {
    document.delMesh(layer);
    if (before != nullptr) document.setCurrentMesh(before->id());
    throw;
  }
}

/// A layer as the document shows it: its transform applied.
NamedMesh shown_mesh(const MeshModel& layer) {
  NamedMesh result{layer.label().toStdString(), to_indexed_mesh(layer.cm)};
  const auto& transform = layer.cm.Tr;
  for (wscvt::Vector3& point : result.mesh.points) {
    wscvt::Vector3 moved;
    for (int k = 0; k < 3; ++k) {
      moved[k] = transform.ElementAt(k, 0) * point.x() + transform.ElementAt(k, 1) * point.y() +
                 transform.ElementAt(k, 2) * point.z() + transform.ElementAt(k, 3);
    }
    point = moved;
  }
  return result;
}

const MeshModel& layer_with_label(const MeshDocument& document, const std::string& label) {
  const QString wanted = QString::fromStdString(label);
  const MeshModel* found = nullptr;
  QStringList labels;
  for (const MeshModel* layer : document.meshList) {
    labels << "'" + layer->label() + "'";
    if (layer->label() != wanted) continue;
    if (found != nullptr) {
      throw wscvt::Error(
          wscvt::ErrorCode::InvalidInput,
          "Two layers are called '" + label + "'; rename one of them. Nothing was changed.");
    }
    found = layer;
  }
  if (found == nullptr) {
    throw wscvt::Error(wscvt::ErrorCode::InvalidInput,
                       "Parameter ReferenceLayer: there is no layer called '" + label +
                           "'; the layers are " + labels.join(", ").toStdString() + ".");
  }
  return *found;
}

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

FilterWscvt::FilterWscvt() {
  typeList << Remesh << Create << Describe;
  for (const FilterIDType filter : types())
    actionList << new QAction(FilterWscvt::filterName(filter), this);
}

QString FilterWscvt::pluginName() const { return QStringLiteral("FilterWSCVT"); }

QString FilterWscvt::filterName(FilterIDType filter) const {
  return QString::fromStdString(description_of(filter).name);
}

QString FilterWscvt::filterInfo(FilterIDType filter) const {
  return QString::fromStdString(description_of(filter).help);
}

MeshFilterInterface::FilterClass FilterWscvt::getClass(QAction* action) {
  return description_of(ID(action)).menu;
}

MeshFilterInterface::FILTER_ARITY FilterWscvt::filterArity(QAction* action) const {
  return description_of(ID(action)).arity;
}

int FilterWscvt::getPreConditions(QAction* action) const {
  // The remesher takes points without faces too.
  return ID(action) == Describe ? MeshModel::MM_FACENUMBER : MeshModel::MM_NONE;
}

int FilterWscvt::postCondition(QAction* action) const { return description_of(ID(action)).changes; }

void FilterWscvt::initParameterSet(QAction* action, MeshDocument& /*document*/,
                                   RichParameterList& parameters) {
  for (const FilterParameter& parameter : description_of(ID(action)).parameters) {
    const QString name = QString::fromStdString(parameter.name);
    const QString label = QString::fromStdString(parameter.label);
    const QString tooltip = QString::fromStdString(parameter.tooltip);
    switch (parameter.kind) {
      case ParameterKind::Integer:
        parameters.addParam(
            RichInt(name, static_cast<int>(parameter.default_value), label, tooltip));
        break;
      case ParameterKind::Real:
        parameters.addParam(
            RichFloat(name, static_cast<float>(parameter.default_value), label, tooltip));
        break;
      case ParameterKind::Choice: {
        QStringList choices;
        for (const std::string& choice : parameter.choices) {
          choices << QString::fromStdString(choice);
        }
        parameters.addParam(
            RichEnum(name, static_cast<int>(parameter.default_value), choices, label, tooltip));
        break;
      }
      case ParameterKind::Flag:
        parameters.addParam(RichBool(name, parameter.default_value != 0.0, label, tooltip));
        break;
      case ParameterKind::Text:
        parameters.addParam(RichString(name, QString(), label, tooltip));
        break;
    }
  }
}

bool FilterWscvt::applyFilter(QAction* action, MeshDocument& document,
                              const RichParameterList& parameters, vcg::CallBackPos* callback) {
  errorMessage.clear();
  // An exception that leaves this function ends MeshLab.
  try {
    switch (ID(action)) {
      case Create:
        create_layer(document, parameters, callback);
        break;
      case Describe:
        describe_current_layer(document, parameters, callback);
        break;
      default:
        remesh_current_layer(document, parameters, callback);
    }
    return true;
  } catch (const std::bad_alloc&) {
    return fail(QStringLiteral(
        "There is not enough memory for this mesh; simplify it or ask for fewer nodes."));
  } catch (const std::exception& error) {
    return fail(QString::fromUtf8(error.what()));
  } catch (...) {
    return fail(QStringLiteral("The filter failed for a reason it does not know."));
  }
}

void FilterWscvt::remesh_current_layer(MeshDocument& document, const RichParameterList& parameters,
                                       vcg::CallBackPos* callback) {
  const Stopwatch stopwatch;
  const RemeshSettings settings = read_remesh_settings(values_of(remesh_parameters(), parameters));
  MeshModel* source = document.mm();
  if (source == nullptr) throw no_mesh();

  const wscvt::Execution execution(0, progress_to(callback));
  const wscvt::RemeshResult result =
      wscvt::remesh(to_indexed_mesh(source->cm), settings.options, execution);
  // Files first: when they cannot be written the document stays as it was.
  if (!settings.result.report_file.empty()) {
    write_report(result, to_indexed_mesh(source->cm), settings.result.report_file);
  }
  if (!settings.coefficients_file.empty()) {
    wscvt::write_harmonics(settings.coefficients_file, wscvt::HarmonicSurface(result.coefficients));
  }
  if (settings.new_layer) {
    add_layer(document, QFileInfo(source->label()).completeBaseName(), source, result,
              settings.result);
  } else {
    fill_layer(*source, result, settings.result);
  }
  log(log_lines(result, settings.result.quality, stopwatch.seconds()));
}

void FilterWscvt::create_layer(MeshDocument& document, const RichParameterList& parameters,
                               vcg::CallBackPos* callback) {
  const Stopwatch stopwatch;
  const CreationSettings settings =
      read_creation_settings(values_of(creation_parameters(), parameters));
  const auto surface = make_surface(settings);
  const wscvt::Execution execution(0, progress_to(callback));
  const wscvt::RemeshResult result = wscvt::remesh(*surface, settings.options, execution);
  write_report(result, wscvt::IndexedMesh(), settings.result.report_file);
  add_layer(document, QString::fromStdString(surface_name(settings)), nullptr, result,
            settings.result);
  log(log_lines(result, settings.result.quality, stopwatch.seconds()));
}

void FilterWscvt::describe_current_layer(MeshDocument& document,
                                         const RichParameterList& parameters,
                                         vcg::CallBackPos* callback) {
  const Stopwatch stopwatch;
  const DescriptorSettings settings =
      read_descriptor_settings(values_of(descriptor_parameters(), parameters));
  if (document.mm() == nullptr) throw no_mesh();
  std::optional<NamedMesh> reference;
  if (!settings.reference_layer.empty()) {
    reference = shown_mesh(layer_with_label(document, settings.reference_layer));
  }
  const wscvt::Execution execution(0, progress_to(callback));
  const DescriptorResult result =
      measure_grains(shown_mesh(*document.mm()), std::move(reference), settings.options, execution);
  write_report(result, settings.report_file);
  log(descriptor_lines(result, stopwatch.seconds()));
}

void FilterWscvt::log(const std::vector<std::string>& lines) {
  const bool html = log_is_shown_as_html();
  for (const std::string& line : lines) Log(html ? html_line(line) : line);
}

bool FilterWscvt::fail(const QString& sentence) {
  // The message box reads HTML. meshlabserver does not print the message, only the log.
  errorMessage = sentence.toHtmlEscaped();
  const std::string line = sentence.toStdString();
  Log(std::string());
  Log(GLLogStream::WARNING, log_is_shown_as_html() ? html_line(line) : line);
  return false;
}

MESHLAB_PLUGIN_NAME_EXPORTER(FilterWscvt)
