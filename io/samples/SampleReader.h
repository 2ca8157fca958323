#pragma once

// Private to io: sample files of any format, read in order.

#include "model/SampleSet.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>

namespace palp {

enum class SampleFormat { Csv, Hdf5, Npz };

/// Of a file that is written: by its ending, .h5, .hdf5 or .npz; else CSV.
SampleFormat formatToWrite(const std::filesystem::path& path);

struct SampleRows;
/// Writes a file of arrays, HDF5 or NPZ. Throws Error, or Cancelled; what was written then is of no use.
void writeSampleArrays(const std::filesystem::path& path, SampleFormat format, const SampleRows& rows,
                       const std::stop_token& stop);

/// Reads one sample file from its beginning to its end. Everything throws Error with the file's name and the place.
class SampleReader {
public:
  SampleReader() = default;
  virtual ~SampleReader() = default;
  SampleReader(const SampleReader&) = delete;
  SampleReader& operator=(const SampleReader&) = delete;

  /// Without samples; its matrices have their rows.
  [[nodiscard]] virtual const SampleSet& head() const = 0;
  /// Samples of the file, where the file has their number.
  [[nodiscard]] virtual std::optional<Eigen::Index> size() const = 0;
  /// Reads the next `count` samples, or as many as there are, into the columns of the set from `first` on, which are
  /// there; returns their number. Throws Cancelled after a request to stop.
  virtual Eigen::Index read(SampleSet& set, Eigen::Index first, Eigen::Index count, const std::stop_token& stop) = 0;
};

/// By what the file is, not by its name. The stop holds for the reader's complete life.
std::unique_ptr<SampleReader> openSamples(const std::filesystem::path& path, const std::stop_token& stop);

} // namespace palp
