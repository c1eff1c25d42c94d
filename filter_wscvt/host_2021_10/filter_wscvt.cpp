// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_wscvt.h"

#include <optional>
#include <string>
#include <vector>

#include "filters.h"
#include "meshlab_host.h"
#include "meshlab_layers.h"
#include "meshlab_parameters.h"

namespace {

using namespace wscvt::filter;

/// These versions' names for the shared code.
struct Api {
  using Document = MeshDocument;
  using Model = MeshModel;
  using List = RichParameterList;
  using Value = ::Value;
  using Scalar = Scalarm;
  using Integer = RichInt;
  using Real = RichFloat;
  using Choice = RichEnum;
  using Flag = RichBool;
  using Text = RichString;
#ifdef WSCVT_MESHLAB_NAMES_FILES_FIRST  // from 2023.12 on
  using InputFile = RichFileOpen;
  using OutputFile = RichFileSave;
#else
  using InputFile = RichOpenFile;
  using OutputFile = RichSaveFile;
#endif

  /// In a column of 250 pixels, whatever the width of the dialog.
  static QString tooltip(const FilterParameter& parameter, const ParameterList& /*all*/) {
    return shown_tooltip(whole_tooltip(parameter), 240);
  }

  static std::vector<MeshModel*> all(MeshDocument& document) {
    std::vector<MeshModel*> models;
    for (MeshModel& model : document.meshIterator()) models.push_back(&model);
    return models;
  }
  static void remove(MeshDocument& document, MeshModel& model) { document.delMesh(model.id()); }
  static void update_box_and_normals(MeshModel& model) { model.updateBoxAndNormals(); }
  static QImage texture_picture(const MeshModel& model, const std::string& name) {
    // Placeholder that these versions show for a missing picture.
    return name == "dummy.png" ? QImage() : model.getTexture(name);
  }

  template <class Rich, class... Arguments>
  static void add(RichParameterList& list, const FilterParameter& parameter, const QString& tooltip,
                  const Arguments&... arguments) {
    list.addParam(Rich(QString::fromStdString(parameter.name), arguments...,
                       QString::fromStdString(parameter.label), tooltip, parameter.advanced));
  }

  static std::optional<QString> text(const ::Value& value) {
    if (value.isString()) return value.getString();
    return std::nullopt;
  }
};

}  // namespace

FilterWscvt::FilterWscvt() {
  for (const Filter& filter : all_filters()) {
    typeList.push_back(static_cast<ActionIDType>(filter.id));
    actionList.push_back(new QAction(QString::fromStdString(filter.name), this));
  }
}

QString FilterWscvt::pluginName() const { return QStringLiteral("FilterWSCVT"); }

QString FilterWscvt::vendor() const { return QStringLiteral("wscvt"); }

QString FilterWscvt::filterName(ActionIDType filter) const {
  return QString::fromStdString(filter_with_number(filter).name);
}

QString FilterWscvt::pythonFilterName(ActionIDType filter) const {
  return QString::fromStdString(filter_with_number(filter).python_name);
}

QString FilterWscvt::filterInfo(ActionIDType filter) const {
  return QString::fromStdString(filter_with_number(filter).help);
}

FilterPlugin::FilterClass FilterWscvt::getClass(const QAction* action) const {
  switch (filter_with_number(ID(action)).id) {
    case FilterId::Create:
      return FilterPlugin::MeshCreation;
    case FilterId::Describe:
      return FilterPlugin::Measure;
    case FilterId::Remesh:
      break;
  }
  return FilterPlugin::Remeshing;
}

FilterPlugin::FilterArity FilterWscvt::filterArity(const QAction* action) const {
  const bool alone = filter_with_number(ID(action)).id == FilterId::Create;
  return alone ? FilterPlugin::NONE : FilterPlugin::SINGLE_MESH;
}

int FilterWscvt::getPreConditions(const QAction* action) const {
  return needed_parts<MeshModel>(filter_with_number(ID(action)));
}

int FilterWscvt::postCondition(const QAction* action) const {
  return changed_parts<MeshModel>(filter_with_number(ID(action)));
}

RichParameterList FilterWscvt::initParameterList(const QAction* action,
                                                 const MeshDocument& /*document*/) {
  return meshlab_parameters<Api>(filter_with_number(ID(action)).parameters);
}

std::map<std::string, QVariant> FilterWscvt::applyFilter(const QAction* action,
                                                         const RichParameterList& parameters,
                                                         MeshDocument& document,
                                                         unsigned int& /*postConditionMask*/,
                                                         vcg::CallBackPos* callback) {
  // The host shows an MLException. Any other exception ends it.
  try {
    const Filter filter = filter_with_number(ID(action));
    MeshlabLayers<Api> layers(document);
    const FilterOutcome outcome = run_filter(
        filter.id, values_of<Api>(filter.parameters, parameters), layers, progress_to(callback));
    for (const LogLine& line : outcome.log) log(log_level(line), shown_line(line));
    std::map<std::string, QVariant> values;
    for (const auto& [name, value] : outcome.values) values[name] = value;
    return values;
  } catch (...) {
    throw MLException(QString::fromStdString(shown_sentence(sentence_of_current_exception())));
  }
}

MESHLAB_PLUGIN_NAME_EXPORTER(FilterWscvt)

// Includes the metadata of the header's QObject here, to compile vcglib only once. Generated by Qt,
// so clang-tidy does not check it.
#ifndef __clang_analyzer__
#include "moc_filter_wscvt.cpp"
#endif
