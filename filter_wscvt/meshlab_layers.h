// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vcg/complex/algorithms/update/color.h>

#include <QImage>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "layers.h"
#include "mesh_conversion.h"
#include "wscvt/base/error.h"
#include "wscvt/report/picture.h"

namespace wscvt::filter {

/// The layers of a MeshLab document, in any version. Names that differ between versions are in
/// `Api`, next to each version's adapter: the types Document and Model, and
///   std::vector<Model*> all(Document&), void remove(Document&, Model&),
///   void update_box_and_normals(Model&), QImage texture_picture(const Model&, name), which is null
///   for one that is not there.
template <class Api>
class MeshlabLayers final : public Layers {
 public:
  using Document = typename Api::Document;
  using Model = typename Api::Model;

  explicit MeshlabLayers(Document& document) : document_(document) {}

  std::vector<Layer> list() const override {
    std::vector<Layer> layers;
    for (const Model* model : Api::all(document_)) layers.push_back(layer_of(*model));
    return layers;
  }

  std::optional<Layer> current() const override {
    const Model* model = document_.mm();
    if (model == nullptr) return std::nullopt;
    return layer_of(*model);
  }

  IndexedMesh mesh(int number) const override { return to_indexed_mesh(model(number).cm); }

  MeshAttributes attributes(int number) const override {
    const Model& layer = model(number);
    const bool of_corners = layer.hasDataMask(Model::MM_WEDGTEXCOORD);
    MeshTexture texture;
    if (!layer.cm.textures.empty() && (of_corners || layer.hasDataMask(Model::MM_VERTTEXCOORD))) {
      texture = texture_of(layer.cm, of_corners);
      for (const std::string& name : texture.names) {
        texture.pictures.push_back(picture_of(Api::texture_picture(layer, name)));
      }
    }
    return {attributes_of(layer.cm.vert, layer.hasDataMask(Model::MM_VERTCOLOR),
                          layer.hasDataMask(Model::MM_VERTQUALITY)),
            attributes_of(layer.cm.face, layer.hasDataMask(Model::MM_FACECOLOR),
                          layer.hasDataMask(Model::MM_FACEQUALITY)),
            std::move(texture)};
  }

  IndexedMesh as_held(IndexedMesh mesh) const override {
    for (Vector3& p : mesh.points) {
      for (double& coordinate : p) {
        // Volatile, because the optimiser of GCC 12 omits the rounding to single precision.
        volatile const auto held = static_cast<Scalar>(coordinate);
        coordinate = static_cast<double>(held);
      }
    }
    return mesh;
  }

  Eigen::Matrix4d transform(int number) const override {
    const auto& transform = model(number).cm.Tr;
    Eigen::Matrix4d matrix;
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) {
        matrix(row, column) = transform.ElementAt(row, column);
      }
    }
    return matrix;
  }

  int add(const std::string& label, const LayerContent& content,
          const Eigen::Matrix4d& transform) override {
    const std::optional<Layer> before = current();
    Model& model = *document_.addNewMesh(QString(), QString::fromStdString(label), true);
    try {
      for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
          model.cm.Tr.ElementAt(row, column) = static_cast<Scalar>(transform(row, column));
        }
      }
      fill(model, content);
    } catch (...) {
      Api::remove(document_, model);
      if (before) document_.setCurrentMesh(before->number);
      throw;
    }
    return static_cast<int>(model.id());
  }

  void replace(int number, const LayerContent& content) override { fill(model(number), content); }

  void rename(int number, const std::string& label) override {
    model(number).setLabel(QString::fromStdString(label));
  }

  void hide(int number) override {
    document_.setVisible(static_cast<int>(model(number).id()), false);
  }

  std::string note(const std::string& key) const override {
    return document_.property(key.c_str()).toString().toStdString();
  }

  void set_note(const std::string& key, const std::string& text) override {
    document_.setProperty(key.c_str(), QString::fromStdString(text));
  }

 private:
  using Mesh = decltype(Model::cm);
  using Scalar = typename Mesh::ScalarType;

  static Layer layer_of(const Model& model) {
    return {static_cast<int>(model.id()), model.label().toStdString(),
            model.fullName().toStdString()};
  }

  Model& model(int number) const {
    for (Model* model : Api::all(document_)) {
      if (static_cast<int>(model->id()) == number) return *model;
    }
    refuse("The layer with number " + std::to_string(number) +
           " no longer exists. Choose another layer. Nothing was changed.");
  }

  /// Replaces the content of a layer, but not its transform.
  static void fill(Model& model, const LayerContent& content) {
    // Built separately and swapped, so a failure leaves the layer unchanged.
    Mesh made;
    assign(made, content.mesh, content.quality);
    exchange_elements(model.cm, made);
    // Adjacency, colours, texture coordinates and similar data belong to the removed elements.
    const int kept = Model::MM_VERTCOORD | Model::MM_VERTNORMAL | Model::MM_VERTFLAG |
                     Model::MM_FACEVERT | Model::MM_FACENORMAL | Model::MM_FACEFLAG |
                     Model::MM_TRANSFMATRIX;
    model.clearDataMask(~kept);
    model.cm.svn = 0;
    model.cm.sfn = 0;
    // The part of a result that MeshLab does not store by default.
    model.updateDataMask(Model::MM_VERTQUALITY);
    if (content.coloured) {
      model.updateDataMask(Model::MM_VERTCOLOR);
      if (content.is_signed) {
        colour_by_sign(model.cm, content.quality);
      } else {
        colour_by_rank(model.cm, content.quality);
      }
    }
    set_attributes(model, content);
    Api::update_box_and_normals(model);
  }

  /// From red (lowest) over green to blue.
  static void colour_by_rank(Mesh& mesh, const std::vector<double>& quality) {
    // Without a given range, the ramp adds an attribute to the mesh that is never freed.
    const auto [low, high] = std::minmax_element(quality.begin(), quality.end());
    const auto red = static_cast<Scalar>(*low);
    const auto blue = std::max(static_cast<Scalar>(*high),
                               std::nextafter(red, std::numeric_limits<Scalar>::max()));
    vcg::tri::UpdateColor<Mesh>::PerVertexQualityRamp(mesh, red, blue);
  }

  /// From blue (negative) over white (0) to red (positive), as far as the largest absolute value.
  static void colour_by_sign(Mesh& mesh, const std::vector<double>& quality) {
    double largest = std::numeric_limits<double>::min();
    for (const double value : quality) largest = std::max(largest, std::abs(value));
    for (std::size_t v = 0; v < quality.size(); ++v) {
      const Colour colour = diverging_colour(quality[v] / largest);  // as on the report's page
      mesh.vert[v].C() = vcg::Color4b(colour[0], colour[1], colour[2], 255);
    }
  }

  /// Empty if a picture could not be read.
  static TexturePicture picture_of(const QImage& image) {
    const QImage colours = image.convertToFormat(QImage::Format_RGB888);
    TexturePicture picture{colours.width(), colours.height(), {}};
    for (int row = 0; row < colours.height(); ++row) {
      const uchar* const line = colours.constScanLine(row);
      picture.colours.insert(picture.colours.end(), line,
                             line + std::ptrdiff_t{3} * colours.width());
    }
    return picture;
  }

  static void set_attributes(Model& model, const LayerContent& content) {
    const MeshAttributes& attributes = content.attributes;
    const auto enable = [&](const std::vector<MeshAttribute>& all, const char* name, int part) {
      if (attribute_named(all, name) != nullptr) model.updateDataMask(part);
    };
    if (!content.coloured) {
      enable(attributes.of_vertices, "red", Model::MM_VERTCOLOR);
      set_colours(model.cm.vert, attributes.of_vertices);
    }
    enable(attributes.of_faces, "red", Model::MM_FACECOLOR);
    set_colours(model.cm.face, attributes.of_faces);
    enable(attributes.of_faces, "quality", Model::MM_FACEQUALITY);
    if (const MeshAttribute* quality = attribute_named(attributes.of_faces, "quality")) {
      for (std::size_t f = 0; f < model.cm.face.size(); ++f) {
        model.cm.face[f].Q() = static_cast<Scalar>(quality->values[f]);
      }
    }
  }

  Document& document_;
};

}  // namespace wscvt::filter
