#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "file_places.h"
#include "interruption.h"
#include "unsnarl/document.h"
#include "unsnarl/scene_document.h"

namespace unsnarl::app {

/// Says whether an output of this SHA-256 is noted for a frame as what is asked for now.
using IsRecorded = std::function<bool(std::size_t frame, const std::string& output_hash)>;

/// The frames of a sequence on disk, and the place where repaired ones go. Frames count from 0.
class SequenceFiles {
 public:
  virtual ~SequenceFiles() = default;

  virtual std::size_t count() const = 0;
  /// The name of a frame in messages and in the record of what is done.
  virtual std::string name(std::size_t frame) const = 0;
  /// The mesh whose faces all frames have, and whose parts may be held.
  virtual const SceneDocument& mesh() const = 0;
  virtual bool stores_float32() const = 0;
  /// SHA-256 of all that is given of a frame. Throws FileError where it cannot be read, or has other faces than mesh().
  virtual std::string content_hash(std::size_t frame) = 0;
  virtual std::vector<double> positions(std::size_t frame) = 0;
  /// The positions that will be read back. May be called from any thread, for a frame whose positions were asked for
  /// and that is not yet written.
  virtual std::vector<double> as_written(std::size_t frame, std::span<const double> positions, bool float32) = 0;
  /// SHA-256 of the output of a frame as it is there; empty: none is.
  virtual std::string output_hash(std::size_t frame) = 0;
  /// The positions in that output.
  virtual std::vector<double> output_positions(std::size_t frame) = 0;
  /// Writes a frame, or keeps it for flush(), and returns what was read back. Throws WriteError.
  virtual std::vector<double> write(std::size_t frame, std::span<const double> positions, bool float32) = 0;

  /// Keeps what was reached of a frame that did not end clean beside its output, which stays as it is; on the disk
  /// after flush_partial(). Returns the path. Throws WriteError.
  virtual std::string write_partial(std::size_t frame, std::span<const double> positions, bool float32) = 0;
  virtual void flush_partial() = 0;

  // Frames that share one file, where several calls may be at work on different ones: the record is locked for these
  // three, and what is not recorded is taken from the input, never from an output that happens to be there.
  virtual bool is_one_file() const = 0;
  /// Takes what is recorded from the outputs on the disk.
  virtual void gather(const IsRecorded& is_recorded) = 0;
  /// After this all frames written are on the disk. Throws WriteError.
  virtual void flush(const IsRecorded& is_recorded) = 0;
  /// Gives the output its name if all frames of the sequence are recorded. False: some are not. Throws WriteError.
  virtual bool finish(const IsRecorded& is_recorded) = 0;

  /// How many frames may be lost by a sudden end without flush().
  virtual std::size_t frames_between_flushes() const = 0;
  /// Names what is read, and the places of outputs. Throws UsageError where two are the same.
  virtual void claim(FilePlaces& places) const = 0;
  /// The path of the output, or of the folder of all.
  virtual std::string output() const = 0;
};

/// Frames by the paths or patterns (*, ?, [...]) of numbered mesh files, in natural order; or a mesh and a point cache.
/// Outputs go to `folder`, which is there. Throws UsageError, FileError.
std::unique_ptr<SequenceFiles> open_sequence(const std::vector<std::string>& inputs, std::optional<Format> format,
                                             const std::string& folder, bool recompute_normals,
                                             Interruption& interruption);

/// Is `a` before `b` where runs of digits are compared as numbers? "f2.obj" is before "f10.obj".
bool natural_order(const std::string& a, const std::string& b);

}  // namespace unsnarl::app
