// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_wscvt.h"

#include <vcg/complex/algorithms/update/color.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <new>

#include "filter_log.h"
#include "mesh_conversion.h"
#include "parameters.h"
#include "wscvt/error.h"
#include "wscvt/execution.h"
#include "wscvt/remesh.h"

namespace {

using namespace wscvt::filter;

constexpr MeshFilterInterface::FilterIDType remeshing_filter = 0;

/// The parts of a result that MeshLab does not hold by default.
constexpr int result_mask = MeshModel::MM_VERTQUALITY;

/// Value of a parameter as a number. The host's getters end the program when a script gave the
/// parameter another type, so the type is checked first.
double value_of(const FilterParameter& parameter, const Value& value) {
  switch (parameter.kind) {
    case ParameterKind::Integer:
    case ParameterKind::Choice:
      if (value.isInt()) return value.getInt();
      break;
    case ParameterKind::Real:
      if (value.isFloat()) return typed_value(value.getFloat());
      if (value.isInt()) return value.getInt();
      break;
    case ParameterKind::Flag:
      if (value.isBool()) return value.getBool() ? 1.0 : 0.0;
      break;
  }
  throw wscvt::Error(wscvt::ErrorCode::InvalidInput,
                     "Parameter " + parameter.name + " has the type " +
                         value.typeName().toStdString() +
                         ", which does not fit; take the types from the filter's own scripts.");
}

ParameterValues values_of(const RichParameterList& parameters) {
  ParameterValues values;
  for (const FilterParameter& parameter : filter_parameters()) {
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

/// Puts the result into a layer, which keeps its transform.
void fill_layer(MeshModel& layer, const wscvt::RemeshResult& result,
                const FilterSettings& settings) {
  // Adjacency, colours, texture coordinates and the like belong to the elements that go.
  const int kept = MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL | MeshModel::MM_VERTFLAG |
                   MeshModel::MM_FACEVERT | MeshModel::MM_FACENORMAL | MeshModel::MM_FACEFLAG |
                   MeshModel::MM_TRANSFMATRIX;
  layer.clearDataMask(~kept);
  assign(layer.cm, wscvt::to_indexed(result.mesh), quality_values(result, settings.quality));
  layer.cm.svn = 0;
  layer.cm.sfn = 0;
  layer.updateDataMask(result_mask);
  if (settings.colour_by_quality) {
    layer.updateDataMask(MeshModel::MM_VERTCOLOR);
    vcg::tri::UpdateColor<CMeshO>::PerVertexQualityRamp(layer.cm);
  }
  layer.UpdateBoxAndNormals();
}

void add_layer(MeshDocument& document, MeshModel& source, const wscvt::RemeshResult& result,
               const FilterSettings& settings) {
  const QString label = QStringLiteral("%1 %2 %3")
                            .arg(QFileInfo(source.label()).completeBaseName())
                            .arg(QString::fromStdString(weighting_name(settings.options.weighting)))
                            .arg(settings.options.node_count);
  MeshModel* layer = document.addNewMesh(QString(), label, true);
  try {
    layer->cm.Tr = source.cm.Tr;
    fill_layer(*layer, result, settings);
  } catch (...) {
    document.delMesh(layer);
    document.setCurrentMesh(source.id());
    throw;
  }
}

}  // namespace

FilterWscvt::FilterWscvt() {
  typeList << remeshing_filter;
  for (const FilterIDType filter : types())
    actionList << new QAction(FilterWscvt::filterName(filter), this);
}

QString FilterWscvt::pluginName() const { return QStringLiteral("FilterWSCVT"); }

QString FilterWscvt::filterName(FilterIDType /*filter*/) const {
  return QString::fromStdString(wscvt::filter::filter_name());
}

QString FilterWscvt::filterInfo(FilterIDType /*filter*/) const {
  return QString::fromStdString(wscvt::filter::filter_help());
}

MeshFilterInterface::FilterClass FilterWscvt::getClass(QAction* /*action*/) {
  return MeshFilterInterface::Remeshing;
}

MeshFilterInterface::FILTER_ARITY FilterWscvt::filterArity(QAction* /*action*/) const {
  return MeshFilterInterface::SINGLE_MESH;
}

int FilterWscvt::getPreConditions(QAction* /*action*/) const { return MeshModel::MM_FACENUMBER; }

int FilterWscvt::postCondition(QAction* /*action*/) const {
  return MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL | MeshModel::MM_VERTNUMBER |
         MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR | MeshModel::MM_FACEVERT |
         MeshModel::MM_FACENORMAL | MeshModel::MM_FACENUMBER;
}

void FilterWscvt::initParameterSet(QAction* /*action*/, MeshDocument& /*document*/,
                                   RichParameterList& parameters) {
  for (const FilterParameter& parameter : filter_parameters()) {
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
    }
  }
}

bool FilterWscvt::applyFilter(QAction* /*action*/, MeshDocument& document,
                              const RichParameterList& parameters, vcg::CallBackPos* callback) {
  errorMessage.clear();
  // An exception that leaves this function ends MeshLab.
  try {
    remesh_current_layer(document, parameters, callback);
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
  const auto start = std::chrono::steady_clock::now();
  const FilterSettings settings = read_settings(values_of(parameters));
  MeshModel* source = document.mm();
  if (source == nullptr) {
    throw wscvt::Error(wscvt::ErrorCode::InvalidInput,
                       "There is no mesh to work on; open a scan first.");
  }

  const wscvt::Execution execution(0, progress_to(callback));
  const wscvt::RemeshResult result =
      wscvt::remesh(to_indexed_mesh(source->cm), settings.options, execution);
  if (settings.new_layer) {
    add_layer(document, *source, result, settings);
  } else {
    fill_layer(*source, result, settings);
  }

  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  const bool html = log_is_shown_as_html();
  for (const std::string& line : log_lines(result, settings, elapsed.count())) {
    Log(html ? html_line(line) : line);
  }
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
