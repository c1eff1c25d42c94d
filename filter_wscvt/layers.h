// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"

namespace wscvt::filter {

/// A layer as its document lists it.
struct Layer {
  int number = 0;     ///< the document's own; given once
  std::string label;  ///< UTF-8
  std::string file;   ///< full name of the file it was read from, UTF-8; empty: none
};

/// New content of a layer.
struct LayerContent {
  IndexedMesh mesh;
  std::vector<double> quality;  ///< one per point; replaces the attributes' quality
  bool coloured = false;        ///< from red (lowest quality) to blue
  bool is_signed = false;       ///< coloured: from blue (negative) over white (0) to red (positive)
  /// "red", "green", "blue", "alpha" and "quality" of vertices and faces, if present. `coloured`
  /// replaces the vertices' colour.
  MeshAttributes attributes;
};

/// The layers of a document. Only the host folders use the host's own types. A layer is identified
/// by its number, because the user may delete it during any call that processes events, such as a
/// progress report.
class Layers {
 public:
  virtual ~Layers() = default;
  Layers() = default;
  Layers(const Layers&) = delete;
  Layers& operator=(const Layers&) = delete;

  /// In the host's order.
  virtual std::vector<Layer> list() const = 0;

  /// Empty if the document is empty.
  virtual std::optional<Layer> current() const = 0;

  /// Returns a layer's mesh as stored, without its transform. Like all functions below, throws
  /// Error(InvalidInput) for a number that is not in the list.
  virtual IndexedMesh mesh(int number) const = 0;

  /// Returns colour and quality of a layer's vertices and faces, if present; see LayerContent.
  virtual MeshAttributes attributes(int number) const = 0;

  /// Returns the mesh with its coordinates rounded as a layer stores them.
  virtual IndexedMesh as_held(IndexedMesh mesh) const = 0;

  /// The transform with which a layer is shown.
  virtual Eigen::Matrix4d transform(int number) const = 0;

  /// Adds a layer, makes it current and returns its number. If it throws, the document is
  /// unchanged.
  virtual int add(const std::string& label, const LayerContent& content,
                  const Eigen::Matrix4d& transform) = 0;

  /// Replaces the content of a layer, but not its transform.
  virtual void replace(int number, const LayerContent& content) = 0;

  virtual void rename(int number, const std::string& label) = 0;
  virtual void hide(int number) = 0;

  /// A text stored with the open document; empty if not set.
  virtual std::string note(const std::string& key) const = 0;
  virtual void set_note(const std::string& key, const std::string& text) = 0;
};

/// The current layer. Throws Error(InvalidInput) when there is none.
Layer current_layer(const Layers& layers);

/// Returns a mesh with its points moved by a transform.
IndexedMesh transformed(IndexedMesh mesh, const Eigen::Matrix4d& transform);

/// Returns a layer's points with its transform applied.
IndexedMesh shown_mesh(const Layers& layers, int number);

/// Adds a warning if the points of a layer with a transform lost digits where they are stored.
/// Without a transform the library warns.
void warn_of_lost_digits(const Layers& layers, const Layer& layer, std::vector<Sentence>& warnings);

/// Notes that a layer is a remesh of another, so that source_of finds it.
void set_source(Layers& layers, int number, int source);

/// Returns the layer from which a remesh was made. Empty if the layer is no remesh, was changed
/// since, or its source is gone.
std::optional<Layer> source_of(const Layers& layers, int number);

/// Finds a layer by `name`: its label with or without the file's ending, its number, or both as in
/// the list of layers ("0 scan.ply", with a star if it was changed). Throws Error(InvalidInput)
/// with the list of labels if no layer matches, with a name that matches one if several do.
/// `parameter` is the parameter with the name.
Layer layer_named(const Layers& layers, const std::string& name, const std::string& parameter);

/// Removes a file's ending from a label: "sand.ply" becomes "sand", but "sand 0.5" stays.
std::string without_ending(const std::string& label);

/// Label of a remesh: the scan's label without its ending and without the text of an earlier
/// remesh, then node distribution and number of nodes.
std::string remesh_label(const std::string& scan, const std::string& nodes, std::size_t count);

/// Folder of the layer's file. Without a file, the current folder of the process.
std::string folder_of(const Layer& layer);

}  // namespace wscvt::filter
