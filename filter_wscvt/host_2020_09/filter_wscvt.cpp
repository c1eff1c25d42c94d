// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_wscvt.h"

#include <QDir>
#include <optional>
#include <string>
#include <vector>

#include "filters.h"
#include "meshlab_host.h"
#include "meshlab_layers.h"
#include "meshlab_parameters.h"

namespace {

using namespace wscvt::filter;

/// This version's names for the shared code.
struct Api {
  using Document = MeshDocument;
  using Model = MeshModel;
  using List = RichParameterList;
  using Value = ::Value;
  using Scalar = float;
  using Integer = RichInt;
  using Real = RichFloat;
  using Choice = RichEnum;
  using Flag = RichBool;
  using Text = RichString;
  using InputFile = RichOpenFile;
  using OutputFile = RichSaveFile;

  /// The Help texts widen the dialog to at most two thirds of the screen, and it does not scroll.
  /// If the fields fill the height of a screen of 1280 x 1000, a text must not be higher than its
  /// field: two lines of about 70 characters, or one line next to a check box.
  static QString tooltip(const FilterParameter& parameter, const ParameterList& all) {
    constexpr int width = 350;
    constexpr std::size_t many_fields = 20;
    const std::size_t room = parameter.kind == ParameterKind::Flag ? 68 : 135;
    return shown_tooltip(
        all.size() > many_fields ? brief_tooltip(parameter, room) : whole_tooltip(parameter),
        width);
  }

  static std::vector<MeshModel*> all(MeshDocument& document) {
    return {document.meshList.begin(), document.meshList.end()};
  }
  static void remove(MeshDocument& document, MeshModel& model) { document.delMesh(&model); }
  static void update_box_and_normals(MeshModel& model) { model.UpdateBoxAndNormals(); }
  /// This version stores only names, relative to the layer's folder.
  static QImage texture_picture(const MeshModel& model, const std::string& name) {
    return QImage(QDir(model.pathName()).filePath(QString::fromStdString(name)));
  }

  template <class Rich, class... Arguments>
  static void add(RichParameterList& list, const FilterParameter& parameter, const QString& tooltip,
                  const Arguments&... arguments) {
    QString label = QString::fromStdString(parameter.label);
    // Typing into a file field has no effect in this version.
    if (holds_file(parameter.kind)) label += QStringLiteral(" (by button)");
    list.addParam(Rich(QString::fromStdString(parameter.name), arguments..., label, tooltip));
  }

  static std::optional<QString> text(const ::Value& value) {
    if (value.isString()) return value.getString();
    if (value.isFileName()) return value.getFileName();
    return std::nullopt;
  }
};

/// If this version cannot read a script's value ("abc", or 200.7 for an integer), it drops the
/// parameter and appends the filter's default to the list. Its own assertions end the program if
/// this happens to any but the first parameter.
void refuse_unreadable(const ParameterList& known, const RichParameterList& parameters) {
  if (known.size() < 2 || parameters.size() != known.size()) return;
  const std::string& first = known.front().name;
  if (parameters.at(parameters.size() - 1).name().toStdString() == first) refuse_without(first);
}

}  // namespace

FilterWscvt::FilterWscvt() {
  for (const Filter& filter : all_filters()) {
    typeList << static_cast<FilterIDType>(filter.id);
    actionList << new QAction(QString::fromStdString(filter.name), this);
  }
}

QString FilterWscvt::pluginName() const { return QStringLiteral("FilterWSCVT"); }

QString FilterWscvt::filterName(FilterIDType filter) const {
  return QString::fromStdString(filter_with_number(filter).name);
}

QString FilterWscvt::filterInfo(FilterIDType filter) const {
  const QString help = QString::fromStdString(filter_with_number(filter).help);
  return host_has_window() ? in_column(help, 455) : help;
}

MeshFilterInterface::FilterClass FilterWscvt::getClass(QAction* action) {
  switch (filter_with_number(ID(action)).id) {
    case FilterId::Create:
      return MeshFilterInterface::MeshCreation;
    case FilterId::Describe:
      return MeshFilterInterface::Measure;
    case FilterId::Remesh:
      break;
  }
  return MeshFilterInterface::Remeshing;
}

MeshFilterInterface::FILTER_ARITY FilterWscvt::filterArity(QAction* action) const {
  const bool alone = filter_with_number(ID(action)).id == FilterId::Create;
  return alone ? MeshFilterInterface::NONE : MeshFilterInterface::SINGLE_MESH;
}

int FilterWscvt::getPreConditions(QAction* action) const {
  return needed_parts<MeshModel>(filter_with_number(ID(action)));
}

int FilterWscvt::postCondition(QAction* action) const {
  return changed_parts<MeshModel>(filter_with_number(ID(action)));
}

void FilterWscvt::initParameterSet(QAction* action, MeshDocument& /*document*/,
                                   RichParameterList& parameters) {
  parameters = meshlab_parameters<Api>(filter_with_number(ID(action)).parameters);
}

bool FilterWscvt::applyFilter(QAction* action, MeshDocument& document,
                              const RichParameterList& parameters, vcg::CallBackPos* callback) {
  errorMessage.clear();
  // An exception that leaves this function ends MeshLab.
  try {
    const Filter filter = filter_with_number(ID(action));
    refuse_unreadable(filter.parameters, parameters);
    MeshlabLayers<Api> layers(document);
    const FilterOutcome outcome = run_filter(
        filter.id, values_of<Api>(filter.parameters, parameters), layers, progress_to(callback));
    for (const LogLine& line : outcome.log) Log(log_level(line), shown_line(line));
    return true;
  } catch (...) {
    const std::string sentence = sentence_of_current_exception();
    errorMessage = QString::fromStdString(sentence).toHtmlEscaped();
    // meshlabserver prints only the log, not the message.
    Log(std::string());
    const LogLine line{"Warning: " + sentence, true};
    Log(log_level(line), shown_line(line));
    return false;
  }
}

MESHLAB_PLUGIN_NAME_EXPORTER(FilterWscvt)

// Includes the metadata of the header's QObject here, to compile vcglib only once. Generated by Qt,
// so clang-tidy does not check it.
#ifndef __clang_analyzer__
#include "moc_filter_wscvt.cpp"
#endif
