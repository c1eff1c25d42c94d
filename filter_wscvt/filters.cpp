// SPDX-License-Identifier: GPL-3.0-or-later
#include "filters.h"

#include <Eigen/LU>
#include <QDate>
#include <QDir>
#include <QFileInfo>
#include <algorithm>
#include <chrono>
#include <exception>
#include <new>
#include <optional>
#include <utility>

#include "creation_filter.h"
#include "descriptor_filter.h"
#include "log_text.h"
#include "remesh_filter.h"
#include "wscvt/base/error.h"
#include "wscvt/base/text.h"
#include "wscvt/measures/carried_attributes.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/remesh.h"
#include "wscvt/report/report.h"

namespace wscvt::filter {

namespace {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Returns the values with full file names: a name without a folder is in `folder`.
ParameterValues with_full_names(const ParameterList& parameters, ParameterValues values,
                                const std::string& folder) {
  for (const FilterParameter& parameter : parameters) {
    const auto value = values.find(parameter.name);
    if (!holds_file(parameter.kind) || value == values.end()) continue;
    auto* name = std::get_if<std::string>(&value->second);
    if (name == nullptr || name->empty()) continue;
    *name =
        QDir::cleanPath(
            QDir(QString::fromStdString(folder)).absoluteFilePath(QString::fromStdString(*name)))
            .toStdString();
  }
  return values;
}

void add_file_note(std::vector<std::string>& notes, const std::string& title,
                   const std::string& file) {
  if (!file.empty()) notes.push_back(title + file);
}

LayerContent content_of(const RemeshResult& result, const ResultSettings& settings) {
  return {result.mesh,
          quality_values(result, settings.quality),
          settings.colour_by_quality,
          settings.quality == VertexQuality::OriginalDistance,
          {}};
}

/// Adds a warning for each picture of the texture that could not be read.
void warn_of_pictures(const MeshTexture& texture, std::vector<Sentence>& warnings) {
  for (std::size_t k = 0; k < texture.pictures.size(); ++k) {
    if (!texture.pictures[k].empty()) continue;
    warnings.push_back("The picture \"" + texture.names[k] +
                       "\" of the texture could not be read. The result has no color from it.");
  }
}

/// Returns the layer's content, with the scan's attributes. The scan's quality replaces radial
/// distances, the default.
LayerContent content_of(const RemeshResult& result, const RemeshSettings& settings,
                        const IndexedMesh& scan, const MeshAttributes& attributes,
                        const Execution& execution) {
  LayerContent content = content_of(result, settings.result);
  content.attributes = carried_attributes(scan, attributes, result.mesh, execution);
  const MeshAttribute* quality = attribute_named(content.attributes.of_vertices, "quality");
  if (quality != nullptr && settings.result.quality == VertexQuality::RadialDistance) {
    content.quality = quality->values;
  }
  return content;
}

/// Writes the report of a layer with today's date. Writes nothing for an empty name.
template <class Content>
void save_report(const std::string& file, const std::string& label, const Content& content) {
  if (file.empty()) return;
  const std::string today = QDate::currentDate().toString(Qt::ISODate).toStdString();
  write_report(file, content, {label, today}, Execution());
}

/// Errors and values of a remesh, under the names of the reports.
std::map<std::string, double> values_of(const RemeshResult& result) {
  std::map<std::string, double> values;
  for (const DescriptorComparison& row :
       compare_descriptors(list_descriptors(result.scan), list_descriptors(result.remesh))) {
    values[row.key + "_scan"] = row.reference;
    values[row.key] = row.value;
    values[row.key + "_error_percent"] = row.error_percent;
  }
  values["vertices"] = static_cast<double>(result.mesh.points.size());
  values["faces"] = static_cast<double>(result.mesh.triangles.size());
  return values;
}

bool is_there(const Layers& layers, int number) {
  const std::vector<Layer> all = layers.list();
  return std::any_of(all.begin(), all.end(),
                     [&](const Layer& layer) { return layer.number == number; });
}

/// Marks the document as in use during its lifetime. The window accepts clicks while a filter runs,
/// and a second run would change the document of the first.
class RunOnDocument {
 public:
  explicit RunOnDocument(Layers& layers) : layers_(layers) {
    if (!layers_.note(key).empty()) {
      refuse(
          "A filter of this plugin is still running. Wait until it is done, then apply again. "
          "Nothing was changed.");
    }
    layers_.set_note(key, "running");
  }
  RunOnDocument(const RunOnDocument&) = delete;
  RunOnDocument& operator=(const RunOnDocument&) = delete;
  ~RunOnDocument() { layers_.set_note(key, ""); }

 private:
  static constexpr const char* key = "wscvt_running";
  Layers& layers_;
};

/// Returns a sentence about parameters without a value, if there are any. Dialogs give all
/// parameters. Scripts may omit some, and hosts silently drop values that they cannot read.
std::optional<std::string> remark_on_missing(const ParameterList& parameters,
                                             const ParameterValues& values) {
  std::vector<std::string> given;
  std::vector<std::string> missing;
  for (const FilterParameter& parameter : parameters) {
    (values.count(parameter.name) > 0 ? given : missing).push_back(parameter.name);
  }
  if (missing.empty()) return std::nullopt;
  if (given.empty())
    return "The script has no readable parameter. All parameters have their defaults.";
  // A script with only the changed parameters lacks many.
  if (given.size() < missing.size()) {
    return "Only " + enumerated(given, " and ") +
           " could be read from the script. All other parameters have their defaults.";
  }
  return enumerated(missing, " and ") + (missing.size() == 1 ? " is" : " are") +
         " missing from the script or not readable. The default was used.";
}

/// Returns a function that gives a result as a layer with this transform stores it. The layers must
/// outlive it.
auto as_layer(const Layers& layers, const Eigen::Matrix4d& transform) {
  return [&layers, from_shown = Eigen::Matrix4d(transform.inverse())](const RemeshResult& result) {
    return layers.as_held(transformed(result.mesh, from_shown));
  };
}

FilterOutcome remesh_layer(const ParameterList& parameters, const ParameterValues& values,
                           Layers& layers, const Execution& execution) {
  const Stopwatch stopwatch;
  const Layer current = current_layer(layers);
  // A remesh of a remesh would add errors, so its scan is remeshed again.
  const std::optional<Layer> origin = source_of(layers, current.number);
  const Layer scan = origin.value_or(current);
  RemeshSettings settings =
      read_remesh_settings(with_full_names(parameters, values, folder_of(scan)));
  const std::string& report = settings.result.report_file;
  settings.options.measures.repaired_scan = !report.empty() && shows_scan(report);
  // Remeshed and measured as it is shown, where the result goes.
  const Eigen::Matrix4d transform =
      layers.transform(settings.new_layer ? scan.number : current.number);
  settings.options.measures.written = as_layer(layers, transform);
  IndexedMesh mesh = transformed(layers.mesh(scan.number), transform);
  std::vector<Sentence> warnings;
  warn_of_lost_digits(layers, scan, warnings);
  const MeshAttributes attributes =
      settings.keep_attributes ? layers.attributes(scan.number) : MeshAttributes();
  const IndexedMesh read = attributes.empty() ? IndexedMesh() : mesh;
  RemeshResult result = remesh(std::move(mesh), settings.options, execution);
  warn_of_pictures(attributes.texture, warnings);
  result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
  LayerContent content = content_of(result, settings, read, attributes, execution.part(1.0, 1.0));
  content.mesh = settings.options.measures.written(result);
  // Files first: if they cannot be written, the document stays unchanged.
  save_report(report, scan.label, result);
  if (!settings.coefficients_file.empty()) {
    write_coefficients(settings.coefficients_file, result);
  }

  const std::string label =
      remesh_label(scan.label, nodes_name(result.options), result.mesh.points.size());
  if (settings.new_layer) {
    const int added = layers.add(label, content, transform);
    // The scan may have been deleted while the filter ran.
    if (is_there(layers, scan.number)) {
      set_source(layers, added, scan.number);
      // The scan would hide the result.
      layers.hide(scan.number);
    }
    if (origin && is_there(layers, current.number)) layers.hide(current.number);
  } else {
    layers.replace(current.number, content);
    if (origin) {
      layers.rename(current.number, label);
      set_source(layers, current.number, scan.number);
    }
  }

  std::vector<std::string> notes;
  if (origin) {
    notes.push_back(
        "'" + current.label + "' is a remesh of '" + scan.label +
        "'. The scan was remeshed again. To remesh the remesh itself, duplicate its layer.");
  }
  if (transform != Eigen::Matrix4d::Identity()) {
    notes.push_back(
        "The layer has a transform. All measures are those of the grain as shown. MeshLab saves a "
        "mesh without its transform: apply Matrix: Freeze Current Matrix before you save.");
  }
  add_file_note(notes, "Report in ", settings.result.report_file);
  add_file_note(notes, "Coefficients in ", settings.coefficients_file);
  FilterOutcome outcome;
  outcome.log = log_lines(result, stopwatch.seconds(), notes);
  outcome.values = values_of(result);
  return outcome;
}

/// Folder for file names without a folder if there is no scan: the folder of the current layer.
std::string folder_at_hand(const Layers& layers) {
  const std::optional<Layer> current = layers.current();
  if (!current) return folder_of(Layer());
  return folder_of(source_of(layers, current->number).value_or(*current));
}

FilterOutcome create_layer(const ParameterList& parameters, const ParameterValues& values,
                           Layers& layers, const Execution& execution) {
  const Stopwatch stopwatch;
  CreationSettings settings =
      read_creation_settings(with_full_names(parameters, values, folder_at_hand(layers)));
  const Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();
  settings.options.measures.written = as_layer(layers, transform);
  const RemeshResult result = remesh(settings.surface, settings.options, execution);
  const std::string name = surface_name(settings.surface);
  save_report(settings.result.report_file, name, result);
  layers.add(remesh_label(name, nodes_name(result.options), result.mesh.points.size()),
             content_of(result, settings.result), transform);

  std::vector<std::string> notes;
  add_file_note(notes, "Report in ", settings.result.report_file);
  FilterOutcome outcome;
  outcome.log = log_lines(result, stopwatch.seconds(), notes);
  outcome.values = values_of(result);
  return outcome;
}

FilterOutcome describe_layer(const ParameterList& parameters, const ParameterValues& values,
                             Layers& layers, const Execution& execution) {
  const Stopwatch stopwatch;
  const DescriptorSettings settings =
      read_descriptor_settings(with_full_names(parameters, values, folder_at_hand(layers)));
  const Layer current = current_layer(layers);
  std::vector<Sentence> warnings;
  warn_of_lost_digits(layers, current, warnings);
  std::optional<NamedMesh> reference;
  if (!settings.reference_layer.empty()) {
    const Layer layer = layer_named(layers, settings.reference_layer, "ReferenceLayer");
    warn_of_lost_digits(layers, layer, warnings);
    reference = NamedMesh{layer.label, shown_mesh(layers, layer.number)};
  }
  const GrainMeasures result = measure_grain({current.label, shown_mesh(layers, current.number)},
                                             std::move(reference), settings.options, execution);
  save_report(settings.report_file, current.label, result);

  FilterOutcome outcome;
  outcome.log = log_lines(result, stopwatch.seconds(), warnings);
  if (!settings.report_file.empty()) outcome.log.push_back({"Report in " + settings.report_file});
  for (const DescriptorValue& row : list_descriptors(result.grain.descriptors)) {
    outcome.values[row.key] = row.value;
  }
  return outcome;
}

FilterOutcome run_on(FilterId filter, const ParameterList& parameters,
                     const ParameterValues& values, Layers& layers, const Execution& execution) {
  switch (filter) {
    case FilterId::Create:
      return create_layer(parameters, values, layers, execution);
    case FilterId::Describe:
      return describe_layer(parameters, values, layers, execution);
    case FilterId::Remesh:
      break;
  }
  return remesh_layer(parameters, values, layers, execution);
}

}  // namespace

std::vector<Filter> all_filters() {
  return {
      {FilterId::Remesh, remesh_name(), "meshing_weighted_spherical_voronoi", remesh_help(),
       remesh_parameters()},
      {FilterId::Create, creation_name(), "create_grain", creation_help(), creation_parameters()},
      {FilterId::Describe, descriptor_name(), "get_grain_shape_descriptors", descriptor_help(),
       descriptor_parameters()},
  };
}

Filter filter_with_number(int number) {
  for (Filter& filter : all_filters()) {
    if (static_cast<int>(filter.id) == number) return std::move(filter);
  }
  return filter_with_number(static_cast<int>(FilterId::Remesh));
}

FilterOutcome run_filter(FilterId filter, const ParameterValues& values, Layers& layers,
                         const ProgressCallback& progress) {
  const RunOnDocument run(layers);
  const ParameterList parameters = filter_with_number(static_cast<int>(filter)).parameters;
  FilterOutcome outcome = run_on(filter, parameters, values, layers, Execution(0, progress));
  if (const std::optional<std::string> remark = remark_on_missing(parameters, values)) {
    outcome.log.push_back({"Warning: " + *remark, true});
  }
  return outcome;
}

std::string sentence_of_current_exception() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return "There is not enough memory for this mesh. Simplify it or use fewer nodes.";
  } catch (const Error& error) {
    // The library does not know the document. A run changes it only at its end.
    const std::string sentence = shown_words(error.sentence());
    return error.code() == ErrorCode::Cancelled ? sentence + " Nothing was changed." : sentence;
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "The filter failed for an unknown reason.";
  }
}

}  // namespace wscvt::filter
