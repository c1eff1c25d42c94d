// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <common/filterscript.h>
#include <common/interfaces.h>
#include <common/mlexception.h>

#include <QImage>
#include <QTextDocumentFragment>
#include <map>
#include <string>
#include <vector>

namespace wscvt::host_test {

// MeshLab 2020.09 as the tests play it; host_2021_10.h has the same for the later versions.

using Plugin = MeshFilterInterface;

/// Type names of files in scripts.
inline const char* const output_file_type = "RichSaveFile";
inline const char* const input_file_type = "RichOpenFile";

/// A text as the value of a parameter: a plain one or a file's name.
inline void set_text(RichParameter& parameter, const QString& text) {
  if (parameter.value().isString()) {
    parameter.setValue(StringValue(text));
  } else {
    parameter.setValue(FileValue(text));
  }
}

inline std::vector<QAction*> actions_of(Plugin& plugin) {
  const QList<QAction*> actions = plugin.actions();
  return {actions.begin(), actions.end()};
}

inline RichParameterList parameters_of(Plugin& plugin, QAction* action, MeshDocument& document) {
  RichParameterList list;
  plugin.initParameterSet(action, document, list);
  return list;
}

/// Applies a filter; `message` is the sentence of a failure. The version hands back no values.
inline bool apply_filter(Plugin& plugin, QAction* action, MeshDocument& document,
                         const RichParameterList& parameters, vcg::CallBackPos* callback,
                         QString& message, std::map<std::string, double>& /*values*/) {
  const bool applied = plugin.applyFilter(action, document, parameters, callback);
  message = QTextDocumentFragment::fromHtml(plugin.errorMsg()).toPlainText();
  return applied;
}

inline std::vector<MeshModel*> layers_of(MeshDocument& document) {
  return {document.meshList.begin(), document.meshList.end()};
}

inline void update_box_and_normals(MeshModel& layer) { layer.UpdateBoxAndNormals(); }

/// Gives a layer the picture of a texture, which this version reads from a file of `folder`.
inline void add_picture(MeshModel& layer, const QString& name, const QImage& picture,
                        const QString& folder) {
  picture.save(folder + "/" + name);
  layer.setFileName(folder + "/scan.obj");
  layer.cm.textures.push_back(name.toStdString());
}

inline void remove_layer(MeshDocument& document, MeshModel& layer) { document.delMesh(&layer); }

/// Whether what a filter hands back reaches a caller.
inline constexpr bool host_takes_values = false;

inline bool is_shown(const MeshModel& layer) { return layer.isVisible(); }

/// Whether the host can tell the parameters of an expert; where it cannot, none is.
inline bool is_advanced(const RichParameter& /*parameter*/) { return false; }
inline constexpr bool host_folds_parameters = false;

/// Pixels across for the text behind the Help button: beside the fields, on a screen 1280 wide.
inline constexpr int help_column = 400;

inline QString filter_of(FilterScript& script, int k) { return script[k].filterName(); }
inline RichParameterList parameters_of(FilterScript& script, int k) { return script[k].second; }

}  // namespace wscvt::host_test
