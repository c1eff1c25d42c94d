// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStringList>
#include <optional>
#include <string>

#include "log_text.h"
#include "parameters.h"
#include "wscvt/base/error.h"

namespace wscvt::filter {

// Parameters of a filter for any version of MeshLab. Names that differ between versions are in
// `Api`, next to each version's adapter: the types List, Value, Scalar, Integer, Real, Choice,
// Flag, Text, InputFile and OutputFile, and
//   QString tooltip(const FilterParameter&, const ParameterList&), as its dialog has room for it,
//   void add<Rich>(List&, const FilterParameter&, tooltip, arguments...),
//   std::optional<QString> text(const Value&).

/// Name filter of a file dialog: "Report (*.html *.json)".
inline QString file_dialog_filter(const FilterParameter& parameter) {
  QStringList patterns;
  for (const std::string& extension : parameter.extensions) {
    patterns << "*" + QString::fromStdString(extension);
  }
  return QString::fromStdString(parameter.label) + " (" + patterns.join(' ') + ")";
}

/// HTML in a column of fixed width, in pixels. MeshLab reserves too little height for texts in a
/// narrow column, and cuts them off or overlaps them. A fixed column gets the height it needs.
inline QString in_column(const QString& html, int width) {
  return QStringLiteral("<table width=\"%1\" cellspacing=\"0\" cellpadding=\"0\"><tr><td>")
             .arg(width) +
         html + QStringLiteral("</td></tr></table>");
}

/// A tooltip for the host, also shown by its Help button.
inline QString shown_tooltip(const std::string& tooltip, int width) {
  const QString text = QString::fromStdString(tooltip);
  return host_has_window() ? in_column(text.toHtmlEscaped(), width) : text;
}

template <class Api>
typename Api::List meshlab_parameters(const ParameterList& parameters) {
  typename Api::List list;
  for (const FilterParameter& parameter : parameters) {
    const QString tooltip = Api::tooltip(parameter, parameters);
    switch (parameter.kind) {
      case ParameterKind::Integer:
        Api::template add<typename Api::Integer>(list, parameter, tooltip,
                                                 static_cast<int>(parameter.default_value));
        break;
      case ParameterKind::Real:
        Api::template add<typename Api::Real>(
            list, parameter, tooltip, static_cast<typename Api::Scalar>(parameter.default_value));
        break;
      case ParameterKind::Choice: {
        QStringList choices;
        for (const std::string& choice : parameter.choices) {
          choices << QString::fromStdString(choice);
        }
        Api::template add<typename Api::Choice>(list, parameter, tooltip,
                                                static_cast<int>(parameter.default_value), choices);
        break;
      }
      case ParameterKind::Flag:
        Api::template add<typename Api::Flag>(list, parameter, tooltip,
                                              parameter.default_value != 0.0);
        break;
      case ParameterKind::Text:
        Api::template add<typename Api::Text>(list, parameter, tooltip, QString());
        break;
      case ParameterKind::InputFile:
        Api::template add<typename Api::InputFile>(list, parameter, tooltip, QString(),
                                                   QStringList(file_dialog_filter(parameter)));
        break;
      case ParameterKind::OutputFile:
        Api::template add<typename Api::OutputFile>(list, parameter, tooltip, QString(),
                                                    file_dialog_filter(parameter));
        break;
    }
  }
  return list;
}

/// Returns the value of a parameter. The host's getters end the program if the script gives another
/// type, so the type is checked first.
template <class Api>
ParameterValue value_of(const FilterParameter& parameter, const typename Api::Value& value) {
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
    case ParameterKind::InputFile:
    case ParameterKind::OutputFile:
      // Older scripts have files as texts.
      if (const std::optional<QString> text = Api::text(value)) {
        return text->trimmed().toStdString();
      }
  }
  refuse("Parameter " + parameter.name + " has the type " + value.typeName().toStdString() +
         ", which does not fit. Use the types of the filter's own scripts.");
}

/// For a parameter that is missing or unreadable in a script.
[[noreturn]] inline void refuse_without(const std::string& name) {
  refuse(name +
         " is missing from the script, or its value cannot be read. Give a whole number, at the "
         "position that it has in the filter's own scripts. Nothing was changed.");
}

/// Returns the values of the parameters in a list. Throws Error if a required parameter is missing.
template <class Api>
ParameterValues values_of(const ParameterList& known, const typename Api::List& list) {
  ParameterValues values;
  for (const FilterParameter& parameter : known) {
    const QString name = QString::fromStdString(parameter.name);
    if (!list.hasParameter(name)) {
      if (parameter.required) refuse_without(parameter.name);
      continue;
    }
    values[parameter.name] = value_of<Api>(parameter, list.getParameterByName(name).value());
  }
  return values;
}

}  // namespace wscvt::filter
