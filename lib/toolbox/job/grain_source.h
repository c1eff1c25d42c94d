// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "toolbox/job/bodies.h"
#include "toolbox/job/grain_files.h"
#include "wscvt/base/error.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"

namespace wscvt {

/// Scan of a grain.
struct GrainScan {
  IndexedMesh mesh;
  MeshAttributes attributes = {};          ///< of a file; empty for a body or a label
  std::vector<std::string> warnings = {};  ///< about reading it
  double voxel_size = 0.0;                 ///< edge of its cubic voxels, length; 0: not known
  std::size_t place = 0;                   ///< in its source; of NamedGrains
  Sentence refused = {};                   ///< why there is no mesh; else empty
  /// Returns its record in the census of its source, for the file that is made of it; empty if
  /// there is no census.
  std::function<std::string(const std::string& file)> record = {};
};

/// What a job has made of a grain: its file, and its record in the census or the error.
struct MadeGrain {
  std::string file;
  std::string record = {};
  std::string error = {};
};

/// Grains in a fixed order, each with a name of its own.
class GrainSource {
 public:
  using MadeOf = std::function<MadeGrain(const std::string& grain)>;

  GrainSource() = default;
  GrainSource(const GrainSource&) = delete;
  GrainSource& operator=(const GrainSource&) = delete;
  virtual ~GrainSource() = default;

  virtual std::size_t size() const = 0;
  virtual std::string name(std::size_t grain) const = 0;

  /// Returns the file or folder that the grain is read from; empty if it is made.
  virtual std::string file(std::size_t grain) const { return static_cast<void>(grain), ""; }

  /// Declares which grains will be read, ascending. Without this call, all.
  virtual void want(const std::vector<std::size_t>& grains) { static_cast<void>(grains); }

  /// Reads a grain. Each wanted grain may be read once, on several threads at once.
  /// `with_pictures`: also reads the pictures of a file's texture. Throws Error if the grain cannot
  /// be read; a source with a census may say that in GrainScan::refused.
  virtual GrainScan read(std::size_t grain, bool with_pictures, const Execution& execution) = 0;

  /// Returns a table of all that the source contains, grains or not; empty if all are grains.
  virtual std::string census(const MadeOf& made_of) const {
    return static_cast<void>(made_of), std::string();
  }

  /// Returns the fraction of the source that belongs to grains but is in none.
  virtual double left_out() const { return 0.0; }

  /// Returns the unit of all lengths; empty: not known.
  virtual std::string unit() const { return {}; }

  /// Returns the number of volumes and meshes whose labels and bodies are grains.
  virtual std::size_t volumes() const { return 0; }
};

/// Grains that a job makes, with the names PREFIX00001, PREFIX00002, ...
class NamedGrains : public GrainSource {
 public:
  using Read = std::function<IndexedMesh(std::size_t grain, const Execution& execution)>;

  /// The numbers have as many digits as `count`, but at least `digits`. Without `read`, a scan has
  /// only its place.
  NamedGrains(std::string prefix, std::size_t count, std::size_t digits, Read read = {});

  std::size_t size() const override { return count_; }
  std::string name(std::size_t grain) const override;
  GrainScan read(std::size_t grain, bool with_pictures, const Execution& execution) override;

 private:
  std::string prefix_;
  std::size_t count_;
  std::size_t digits_;
  Read read_;
};

/// The grains of a mesh file: itself, or its bodies.
class MeshGrains : public GrainSource {
 public:
  /// The file is one grain, with its path as name. If it cannot be read, read() throws.
  explicit MeshGrains(std::string path) : path_(std::move(path)) {}

  /// Reads the file. Its bodies, if there are several, are grains with the names PATH/1, PATH/2,
  /// ... and stay in memory. If the file cannot be read or split, read() throws. Throws
  /// MachineRefused and Error(Cancelled).
  MeshGrains(std::string path, const Execution& execution);

  std::size_t size() const override { return is_file() ? 1 : bodies_.list.size(); }
  std::string name(std::size_t grain) const override;
  std::string file(std::size_t /*grain*/) const override { return path_; }
  void want(const std::vector<std::size_t>& grains) override;
  GrainScan read(std::size_t grain, bool with_pictures, const Execution& execution) override;
  std::size_t volumes() const override { return is_file() ? 0 : 1; }

  /// Several bodies; else an empty list.
  const MeshBodies& bodies() const { return bodies_; }

 private:
  bool is_file() const { return bodies_.list.empty(); }

  std::string path_;
  MeshBodies bodies_;
  Sentence refused_;  ///< why there are no bodies; empty: they were not asked for, or it is one
};

/// Sources one after another; of their grains, those of one part of the sample.
class JoinedGrains : public GrainSource {
 public:
  explicit JoinedGrains(const Shard& shard) : shard_(shard) {}
  /// Throws Error(InvalidInput) if the unit of its lengths is known and another than that of a
  /// source before: one table has one unit.
  void add(std::unique_ptr<GrainSource> source);

  std::size_t size() const override { return places_.size(); }
  std::string name(std::size_t grain) const override;
  std::string file(std::size_t grain) const override;
  void want(const std::vector<std::size_t>& grains) override;
  GrainScan read(std::size_t grain, bool with_pictures, const Execution& execution) override;
  std::string census(const MadeOf& made_of) const override;
  double left_out() const override;   ///< the largest of the sources
  std::string unit() const override;  ///< the first that is known
  std::size_t volumes() const override;

 private:
  /// A grain of a source.
  struct Place {
    std::size_t source;
    std::size_t grain;
  };
  Shard shard_;
  std::vector<std::unique_ptr<GrainSource>> sources_;
  std::vector<Place> places_;
};

}  // namespace wscvt
