// SPDX-License-Identifier: GPL-3.0-or-later
// What the browser's page calls: remeshes a scan of the file system in memory and writes there what
// the page shows and offers. The page sets options by their names in reports.
//   main: SCAN NAME=VALUE ...
#include <emscripten.h>

#include <exception>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "toolbox/exchange/node_table.h"
#include "wscvt/base/output_file.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh.h"
#include "wscvt/report/report.h"

EM_JS(void, tell_progress, (double fraction, const char* stage),
      { Module.onProgress(fraction, UTF8ToString(stage)); });
EM_JS(void, tell_error, (const char* text), { Module.onError(UTF8ToString(text)); });

namespace wscvt {

namespace {

/// Sets the options that the page names, and takes these names from its list.
struct Setter {
  std::map<std::string, std::string>& values;

  const std::string* value_of(std::string_view key) {
    const auto found = values.find(std::string(key));
    if (found == values.end()) return nullptr;
    taken = std::move(found->second);
    values.erase(found);
    return &taken;
  }
  template <class Number>
  void operator()(Number& value, const NumberOption<Number>& option) {
    if (const std::string* text = value_of(option.key)) value = from_typed(*text, option);
  }
  void operator()(bool& value, const FlagOption& option) {
    if (const std::string* text = value_of(option.key)) value = *text == "true";
  }
  template <class Enumeration>
  void operator()(Enumeration& value) {
    const std::string* text = value_of(EnumerationTable<Enumeration>::key);
    if (text != nullptr) value = from_key<Enumeration>(*text);
  }

  std::string taken = {};
};

RemeshOptions options_of(std::map<std::string, std::string> values) {
  RemeshOptions options;
  Setter setter{values};
  for_each_option(options, setter);
  if (!values.empty()) refuse("The method has no option " + values.begin()->first + ".");
  options.measures.repaired_scan = true;
  return options;
}

void run(const std::string& scan, const std::map<std::string, std::string>& values) {
  const Execution execution(1, [](double fraction, const std::string& stage) {
    tell_progress(fraction, stage.c_str());
    return true;
  });
  const RemeshOptions options = options_of(values);
  MeshFile file = read_mesh_file(scan, execution.part(0.0, 0.1));
  RemeshResult result = remesh(std::move(file.mesh), options, execution.part(0.1, 0.85));
  result.warnings.insert(result.warnings.begin(), file.warnings.begin(), file.warnings.end());
  execution.report(0.85, "writing");
  write_mesh(result.mesh, "/remesh.ply");
  write_mesh(result.mesh, "/remesh.stl");
  write_file("/nodes.csv", nodes_csv(node_table(result.mesh)));
  const ReportOrigin origin{scan, ""};
  write_file("/report.json", report_json(result, origin));
  // Its views are the page's too.
  write_file("/report.html", report_html(result, origin, execution.part(0.85, 1.0)));
}

}  // namespace

}  // namespace wscvt

int main(int count, char** words) try {
  std::map<std::string, std::string> values;
  for (int k = 2; k < count; ++k) {
    const std::string word = words[k];
    const std::size_t sign = word.find('=');
    values[word.substr(0, sign)] = word.substr(sign + 1);
  }
  wscvt::run(words[1], values);
  return 0;
} catch (const std::bad_alloc&) {
  tell_error(
      "The browser gives a page 2 GB of memory at most, and this scan needs more. Use the "
      "program.");
  return 1;
} catch (const std::exception& error) {
  tell_error(error.what());
  return 1;
}
