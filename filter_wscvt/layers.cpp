// SPDX-License-Identifier: GPL-3.0-or-later
#include "layers.h"

#include <QDir>
#include <QFileInfo>
#include <QRegularExpression>
#include <QStringList>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>

#include "node_parameters.h"
#include "wscvt/repair/coordinates.h"

namespace wscvt::filter {

namespace {

/// Hash that shows whether a mesh has changed (FNV-1a, 64 bits).
std::uint64_t fingerprint(const IndexedMesh& mesh) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto add = [&](const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t k = 0; k < size; ++k) hash = (hash ^ bytes[k]) * 1099511628211ULL;
  };
  for (const Vector3& point : mesh.points) add(point.data(), 3 * sizeof(double));
  for (const Triangle& triangle : mesh.triangles) add(triangle.data(), sizeof(Triangle));
  return hash;
}

std::string source_key(int number) { return "wscvt_source_of_" + std::to_string(number); }

std::optional<Layer> layer_with_number(const Layers& layers, int number) {
  for (const Layer& layer : layers.list()) {
    if (layer.number == number) return layer;
  }
  return std::nullopt;
}

}  // namespace

Layer current_layer(const Layers& layers) {
  const std::optional<Layer> current = layers.current();
  if (!current) refuse("There is no mesh. Open a scan first.");
  return *current;
}

IndexedMesh transformed(IndexedMesh mesh, const Eigen::Matrix4d& transform) {
  // Without a transform, not even the sign of a zero changes.
  if (transform == Eigen::Matrix4d::Identity()) return mesh;
  for (Vector3& point : mesh.points) {
    point = (transform.topLeftCorner<3, 3>() * point + transform.topRightCorner<3, 1>()).eval();
  }
  return mesh;
}

IndexedMesh shown_mesh(const Layers& layers, int number) {
  return transformed(layers.mesh(number), layers.transform(number));
}

void warn_of_lost_digits(const Layers& layers, const Layer& layer,
                         std::vector<Sentence>& warnings) {
  if (layers.transform(layer.number) == Eigen::Matrix4d::Identity()) return;
  const std::string warning =
      single_precision_warning(layers.mesh(layer.number), "'" + layer.label + "' as stored");
  if (!warning.empty()) warnings.emplace_back(warning);
}

void set_source(Layers& layers, int number, int source) {
  layers.set_note(source_key(number),
                  std::to_string(source) + " " + std::to_string(fingerprint(layers.mesh(number))));
}

std::optional<Layer> source_of(const Layers& layers, int number) {
  const QStringList note =
      QString::fromStdString(layers.note(source_key(number))).split(QLatin1Char(' '));
  if (note.size() != 2) return std::nullopt;
  if (note[1].toULongLong() != fingerprint(layers.mesh(number))) return std::nullopt;
  return layer_with_number(layers, note[0].toInt());
}

Layer layer_named(const Layers& layers, const std::string& name, const std::string& parameter) {
  const std::vector<Layer> all = layers.list();
  // As in the list of layers, which has a star behind a layer that was changed.
  const auto plain = [](const std::string& text) {
    static const QRegularExpression star(QStringLiteral("\\*\\s*$"));
    return QString::fromStdString(text).remove(star).simplified().toStdString();
  };
  const std::string wanted = plain(name);
  // The first interpretation of the name that matches a layer is used.
  const std::vector<std::function<bool(const Layer&)>> readings = {
      [&](const Layer& layer) {
        return plain(layer.label) == wanted ||
               plain(std::to_string(layer.number) + " " + layer.label) == wanted;
      },
      [&](const Layer& layer) {
        return std::to_string(layer.number) == wanted ||
               without_ending(plain(layer.label)) == without_ending(wanted);
      }};
  for (const auto& fits : readings) {
    const auto found = std::find_if(all.begin(), all.end(), fits);
    if (found == all.end()) continue;
    if (std::find_if(found + 1, all.end(), fits) != all.end()) {
      refuse("Two layers could be '" + name +
             "'. Give the number and the name of one, as in the list of layers: " +
             std::to_string(found->number) + " " + found->label + ". Nothing was changed.");
    }
    return *found;
  }
  std::string labels;
  for (const Layer& layer : all) {
    if (!labels.empty()) labels += ", ";
    labels += "'" + layer.label + "'";
  }
  refuse("Parameter " + parameter + ": there is no layer called '" + name + "'. The layers are " +
         labels + ".");
}

std::string without_ending(const std::string& label) {
  static const QRegularExpression ending(QStringLiteral("\\.(?=\\w*[A-Za-z])\\w{1,5}$"));
  return QString::fromStdString(label).remove(ending).toStdString();
}

std::string remesh_label(const std::string& scan, const std::string& nodes, std::size_t count) {
  QString base = QString::fromStdString(without_ending(scan));
  QStringList known;
  for (const std::string& each : all_nodes_names()) {
    known << QRegularExpression::escape(QString::fromStdString(each));
  }
  const QRegularExpression added(QStringLiteral(" (%1) \\d+( ?\\(\\d+\\))?$").arg(known.join("|")));
  while (base.contains(added)) base.remove(added);
  return base.toStdString() + " " + nodes + " " + std::to_string(count);
}

std::string folder_of(const Layer& layer) {
  if (layer.file.empty()) return QDir::currentPath().toStdString();
  return QFileInfo(QString::fromStdString(layer.file)).absolutePath().toStdString();
}

}  // namespace wscvt::filter
