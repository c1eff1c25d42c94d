// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <common/filterscript.h>
#include <common/mlexception.h>
#include <common/plugins/interfaces/filter_plugin.h>

#include <QImage>
#include <list>
#include <map>
#include <string>
#include <vector>

namespace wscvt::host_test {

// MeshLab 2021.10 to 2025.07 as the tests play them; see host_2020_09.h.

using Plugin = FilterPlugin;
using EnumValue = IntValue;

// Scripts keep these names also where the classes have others.
inline const char* const output_file_type = "RichSaveFile";
inline const char* const input_file_type = "RichOpenFile";

inline void set_text(RichParameter& parameter, const QString& text) {
  parameter.setValue(StringValue(text));
}

inline std::vector<QAction*> actions_of(Plugin& plugin) {
  const std::list<QAction*> actions = plugin.actions();
  return {actions.begin(), actions.end()};
}

inline RichParameterList parameters_of(Plugin& plugin, QAction* action, MeshDocument& document) {
  return plugin.initParameterList(action, document);
}

inline bool apply_filter(Plugin& plugin, QAction* action, MeshDocument& document,
                         const RichParameterList& parameters, vcg::CallBackPos* callback,
                         QString& message, std::map<std::string, double>& values) {
  message.clear();
  values.clear();
  unsigned int changes = MeshModel::MM_UNKNOWN;
  try {
    for (const auto& [name, value] :
         plugin.applyFilter(action, parameters, document, changes, callback)) {
      values[name] = value.toDouble();
    }
    return true;
  } catch (const MLException& error) {
    message = QString::fromLocal8Bit(error.what());
    return false;
  }
}

inline std::vector<MeshModel*> layers_of(MeshDocument& document) {
  std::vector<MeshModel*> layers;
  for (MeshModel& layer : document.meshIterator()) layers.push_back(&layer);
  return layers;
}

inline void update_box_and_normals(MeshModel& layer) { layer.updateBoxAndNormals(); }

/// Gives a layer the picture of a texture.
inline void add_picture(MeshModel& layer, const QString& name, const QImage& picture,
                        const QString& /*folder*/) {
  layer.addTexture(name.toStdString(), picture);
}

inline void remove_layer(MeshDocument& document, MeshModel& layer) { document.delMesh(layer.id()); }

inline constexpr bool host_takes_values = true;

inline bool is_shown(const MeshModel& layer) { return layer.isVisible(); }

inline bool is_advanced(const RichParameter& parameter) { return parameter.isAdvanced(); }
inline constexpr bool host_folds_parameters = true;

/// Pixels across for the text behind the Help button; what is wider is cut off.
inline constexpr int help_column = 250;

inline QString filter_of(FilterScript& script, int k) { return script[k].first; }
inline RichParameterList parameters_of(FilterScript& script, int k) { return script[k].second; }

}  // namespace wscvt::host_test
