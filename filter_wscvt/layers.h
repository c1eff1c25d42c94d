// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"

namespace wscvt::filter {

/// A layer as its document lists it.
struct Layer {
  int number = 0;     ///< the document's own; given once
  std::string label;  ///< UTF-8
  std::string file;   ///< full name of the file it was read from, UTF-8; empty: none
};

/// What a layer is to hold.
struct LayerContent {
  IndexedMesh mesh;
  std::vector<double> quality;  ///< one a point; the attributes' own is not used
  bool coloured = false;        ///< from red (lowest quality) to blue
  /// "red", "green", "blue", "alpha" and "quality" of vertices and faces, as far as there are any.
  /// `coloured` takes the place of the vertices' colour.
  MeshAttributes attributes;
};

/// The layers of a document. Only the host folders know what a host calls them; everything else
/// asks here. A layer is known by its number, because the host may take it away at any call that
/// lets a user act, such as one that reports progress.
class Layers {
 public:
  virtual ~Layers() = default;
  Layers() = default;
  Layers(const Layers&) = delete;
  Layers& operator=(const Layers&) = delete;

  /// In the host's order.
  virtual std::vector<Layer> list() const = 0;

  /// None when the document is empty.
  virtual std::optional<Layer> current() const = 0;

  /// A layer's mesh as it is stored, its transform not applied. Throws Error(InvalidInput) for a
  /// number that is not in the list, as everything below.
  virtual IndexedMesh mesh(int number) const = 0;

  /// Colour and quality of a layer's vertices and faces, as far as it has them; see LayerContent.
  virtual MeshAttributes attributes(int number) const = 0;

  /// The mesh with the coordinates that a layer would hold of it.
  virtual IndexedMesh as_held(IndexedMesh mesh) const = 0;

  /// The transform with which a layer is shown.
  virtual Eigen::Matrix4d transform(int number) const = 0;

  /// Adds a layer, makes it the current one and gives its number. The document is as before when
  /// this throws.
  virtual int add(const std::string& label, const LayerContent& content,
                  const Eigen::Matrix4d& transform) = 0;

  /// Replaces what a layer holds; its transform stays.
  virtual void replace(int number, const LayerContent& content) = 0;

  virtual void rename(int number, const std::string& label) = 0;
  virtual void hide(int number) = 0;

  /// A text kept with the document as long as it is open; empty when there is none.
  virtual std::string note(const std::string& key) const = 0;
  virtual void set_note(const std::string& key, const std::string& text) = 0;
};

/// The current layer. Throws Error(InvalidInput) when there is none.
Layer current_layer(const Layers& layers);

/// A layer's points where the document shows them: its transform applied.
IndexedMesh shown_mesh(const Layers& layers, int number);

/// Notes that a layer is a remesh of another, so that source_of finds it.
void set_source(Layers& layers, int number, int source);

/// The layer that a layer is a remesh of; none when it is no remesh, has been changed since or its
/// source is gone.
std::optional<Layer> source_of(const Layers& layers, int number);

/// The layer that a person means by `name`: its label, with the file's ending or without it, its
/// number, or both as the list of layers shows them ("0 scan.ply", with a star when it was
/// changed). Throws Error(InvalidInput) with the list of labels when there is none or several;
/// `parameter` is where the name was given.
Layer layer_named(const Layers& layers, const std::string& name, const std::string& parameter);

/// A label without a file's ending: "sand" of "sand.ply", but "sand 0.5" stays.
std::string without_ending(const std::string& label);

/// Label of a remesh: the scan's without its ending, and without what an earlier remesh added, then
/// how the nodes were chosen and their number.
std::string remesh_label(const std::string& scan, const std::string& nodes, std::size_t count);

/// Folder of the file a layer was read from; when there is none, the process's own.
std::string folder_of(const Layer& layer);

}  // namespace wscvt::filter
