// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/clump/clump_options.h"
#include "toolbox/convex/convex_parts.h"
#include "wscvt/base/error.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

/// Converts "error-measure" to "error_measure".
std::string keyword_of(std::string_view key) {
  std::string keyword(key);
  std::replace(keyword.begin(), keyword.end(), '-', '_');
  return keyword;
}

Remeshed remeshed_by(const std::string& function) {
  if (function == "create") return Remeshed::Surface;
  return function == "convex" ? Remeshed::Parts : Remeshed::Scan;
}

RemeshOptions usual_options(Remeshed remeshed) {
  RemeshOptions options;
  if (remeshed == Remeshed::Surface) {
    OnScanOptions on_surface;
    on_surface.placement = ScanPlacement::OnSurface;
    options.method = on_surface;
  }
  if (remeshed == Remeshed::Parts) options.node_count = convex_node_count;
  return options;
}

template <class Value>
Value cast_option(const std::string& keyword, const py::handle& value, const char* wanted) {
  try {
    return value.cast<Value>();
  } catch (const py::cast_error&) {
    throw py::type_error("The option " + keyword + " is " + py::repr(value).cast<std::string>() +
                         ". Give " + wanted + ".");
  }
}

/// pybind11 cuts the decimals of NumPy's numbers off.
void check_whole(const std::string& keyword, const py::handle& value, const std::string& wanted) {
  // Arrays have the function of a whole number too, and throw in it.
  if (py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()))) return;
  PyErr_Clear();
  throw py::type_error("The option " + keyword + " is " + py::repr(value).cast<std::string>() +
                       ". Give " + wanted + ".");
}

/// Reads the given options of a function.
class ReadOptions {
 public:
  ReadOptions(const py::dict& given, std::string function)
      : given_(given), function_(std::move(function)), remeshed_(remeshed_by(function_)) {}

  template <class Number>
  void operator()(Number& value, const NumberOption<Number>& option) {
    constexpr bool is_whole = std::is_integral_v<Number>;
    read(option.key, [&](const std::string& keyword, const py::handle& object) {
      const std::string wanted =
          std::string(is_whole ? "a whole number " : "a number ") + range_text(option);
      if (is_whole) check_whole(keyword, object, wanted);
      value = cast_option<Number>(keyword, object, wanted.c_str());
      require_in_range(value, option);
    });
  }
  void operator()(bool& value, const FlagOption& option) {
    read(option.key, [&](const std::string& keyword, const py::handle& object) {
      value = cast_option<bool>(keyword, object, "True or False");
    });
  }
  template <class Enumeration>
  void operator()(Enumeration& value) {
    read(EnumerationTable<Enumeration>::key, [&](const std::string& keyword,
                                                 const py::handle& object) {
      const std::string key =
          lower_case(cast_option<std::string>(keyword, object, keys_of<Enumeration>().c_str()));
      const Sentence refusal = refusal_of_value(EnumerationTable<Enumeration>::key, key, method_);
      if (!refusal.empty()) refuse("The option " + keyword + ": " + refusal);
      value = from_key<Enumeration>(key);
      if constexpr (std::is_same_v<Enumeration, Method>) method_ = value;
    });
  }

  /// Throws TypeError for unknown options.
  void finish() const {
    if (found_ == given_.size()) return;
    for (const auto& [name, value] : given_) {
      const auto keyword = name.cast<std::string>();
      if (is_known(keyword)) continue;
      if (is_known("method")) refuse_of_remesh(keyword);
      throw py::type_error("There is no option " + keyword + " of " + function_ + ". help(wscvt." +
                           function_ + ") lists the options.");
    }
  }

 private:
  bool is_known(const std::string& keyword) const {
    return std::find(known_.begin(), known_.end(), keyword) != known_.end();
  }

  /// Throws TypeError for an option of the other method, and for one of the result.
  void refuse_of_remesh(const std::string& keyword) const {
    std::string key = keyword;
    std::replace(key.begin(), key.end(), '_', '-');
    const Sentence refusal = refusal_of_option(key, method_);
    if (!refusal.empty() && is_option_of(key, remeshed_))
      throw py::type_error("The option " + keyword + ": " + in_words_of_python(refusal));
    if (keyword == "frame" || keyword == "scale" || keyword == "size") {
      throw py::type_error(
          "A result is in the frame of its scan. Call its in_frame(), or write "
          "its files with " +
          keyword + ".");
    }
  }

  template <class Read>
  void read(std::string_view key, const Read& read) {
    if (!is_option_of(key, remeshed_)) return;
    known_.push_back(keyword_of(key));
    const std::string& keyword = known_.back();
    if (!given_.contains(keyword.c_str())) return;
    ++found_;
    read(keyword, given_[keyword.c_str()]);
  }

  const py::dict& given_;
  std::string function_;
  Remeshed remeshed_;
  std::vector<std::string> known_;
  std::size_t found_ = 0;
  Method method_ = Method::OnScan;
};

class OptionsToDict {
 public:
  template <class Number>
  void operator()(const Number& value, const NumberOption<Number>& option) {
    options_[keyword_of(option.key).c_str()] = value;
  }
  void operator()(const bool& value, const FlagOption& option) {
    options_[keyword_of(option.key).c_str()] = value;
  }
  template <class Enumeration>
  void operator()(const Enumeration& value) {
    options_[keyword_of(EnumerationTable<Enumeration>::key).c_str()] = key_of(value);
  }
  py::dict options_;
};

/// A line of help for each option: name, subject, method, range or values, default, meaning.
class OptionsToHelp {
 public:
  explicit OptionsToHelp(Remeshed remeshed) : remeshed_(remeshed) {}

  /// Options that follow belong to one method.
  void begin_method(Method method) {
    if (is_option_of(EnumerationTable<Method>::key, remeshed_))
      of_method_ = " (" + key_of(method) + ")";
  }
  void end_methods() { of_method_.clear(); }

  template <class Number>
  void operator()(const Number& value, const NumberOption<Number>& option) {
    const std::string meaning =
        option.meaning.empty() ? "" : " " + capitalised(option.meaning) + ".";
    add(option.key, option.subject,
        ": " + range_text(option) + ". Default: " + typed_text(value) + "." + meaning);
  }
  void operator()(const bool& value, const FlagOption& option) {
    // Subject and meaning are one sentence.
    add(option.key, "True or False",
        ". Default: " + std::string(value ? "True" : "False") + ". " + capitalised(option.subject) +
            " " + std::string(option.meaning) + ".");
  }
  template <class Enumeration>
  void operator()(const Enumeration& value) {
    std::string values;
    for (const auto& row : enumerators<Enumeration>()) {
      values += (values.empty() ? "\"" : ", \"") + std::string(row.key) + "\"";
      if (!row.meaning.empty()) values += " (" + std::string(row.meaning) + ")";
    }
    using Table = EnumerationTable<Enumeration>;
    add(Table::key, Table::subject, ": " + values + ". Default: \"" + key_of(value) + "\".");
  }
  py::dict lines_;

 private:
  void add(std::string_view key, std::string_view subject, const std::string& rest) {
    if (!is_option_of(key, remeshed_)) return;
    const std::string keyword = keyword_of(key);
    std::string line = capitalised(subject) + of_method_ + rest;
    if (lines_.contains(keyword.c_str())) {
      // Both methods have the option, with the same values or each with its own.
      const auto before = lines_[keyword.c_str()].cast<std::string>();
      const bool is_same = before.find(rest) != std::string::npos;
      line = is_same ? capitalised(subject) + rest : before + " " + line;
    }
    lines_[keyword.c_str()] = line;
  }

  Remeshed remeshed_;
  std::string of_method_;
};

/// The names of each option's values, by the option.
class ChoicesToDict {
 public:
  template <class Number>
  void operator()(const Number&, const NumberOption<Number>&) {}
  void operator()(const bool&, const FlagOption&) {}
  template <class Enumeration>
  void operator()(const Enumeration&) {
    py::list names;
    const std::string keyword = keyword_of(EnumerationTable<Enumeration>::key);
    // Both methods may have the option, each with its own values.
    if (choices_.contains(keyword.c_str())) names = choices_[keyword.c_str()];
    for (const auto& row : enumerators<Enumeration>()) {
      if (!names.contains(std::string(row.key))) names.append(std::string(row.key));
    }
    choices_[keyword.c_str()] = names;
  }
  py::dict choices_;
};

}  // namespace

RemeshOptions options_of(const py::dict& given, const std::string& function) {
  RemeshOptions options = usual_options(remeshed_by(function));
  ReadOptions read(given, function);
  for_each_option(options, read);
  read.finish();
  if (given.contains("nodes")) limit_search_to_given_nodes(options);
  return options;
}

ClumpOptions clump_options_of(const py::dict& given) {
  ClumpOptions options;
  ReadOptions read(given, "clump");
  for_each_clump_option(options, read);
  read.finish();
  // As of the program: with an allowed error, a given number is the limit.
  if (given.contains("count")) options.most_spheres = options.sphere_count;
  return options;
}

void bind_options(py::module_& module) {
  module.def(
      "options",
      [](const std::string& method) {
        OptionsToDict dict;
        RemeshOptions defaults;
        if (value_of_name<Method>(method) == Method::AsPublished) {
          defaults.method = AsPublishedOptions();
        }
        for_each_option(defaults, dict);
        return dict.options_;
      },
      py::arg("method") = key_of(Method::OnScan),
      "Returns all options of remesh for a method, with their defaults. The names are the "
      "command-line names, with _ for -.");
  module.def("_option_help", [](const std::string& function) {
    const Remeshed remeshed = remeshed_by(function);
    const RemeshOptions options = usual_options(remeshed);
    const AsPublishedOptions published;
    OptionsToHelp help(remeshed);
    help(method_of(options));
    help.begin_method(Method::OnScan);
    for_each_method_option(std::get<OnScanOptions>(options.method), help);
    help.begin_method(Method::AsPublished);
    for_each_method_option(published, help);
    help.end_methods();
    for_each_common_option(options, help);
    if (remeshed == Remeshed::Parts) {
      help.lines_.attr("pop")(std::string(node_count_option.key));
      help(options.node_count, convex_nodes_option);
    }
    return help.lines_;
  });
  module.def("_choices", [] {
    ChoicesToDict dict;
    const RemeshOptions options;
    for_each_option(options, dict);
    const AsPublishedOptions published;
    for_each_method_option(published, dict);
    return dict.choices_;
  });
}

}  // namespace wscvt::python
