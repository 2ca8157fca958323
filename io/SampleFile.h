#pragma once

#include "model/SampleSet.h"

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// Samples are CSV: comment lines `# key: value` with the origin and the counts, one line of column names, one line per
/// sample; numbers read back to the same bits. Displacements or resistances that have no rows have no columns. Under a
/// name that ends with .h5 or .hdf5 they are HDF5, with .npz arrays of NumPy, with the same head and numbers; which a
/// file is follows from its content when it is read (resources/docs/formats.md).

/// The comment lines and the line of column names.
std::string sampleFileHead(const SampleSet& set);

/// Throws Error if the file exists and `force` is not given; Cancelled after a request to stop, and then writes
/// nothing.
void saveSamples(const std::filesystem::path& path, const SampleSet& set, bool force, const std::stop_token& stop = {});

/// Whether a file of arrays, HDF5 or NPZ, has the head of samples. True for a damaged file, so that its reader reports
/// what is wrong.
bool hasSampleArrays(const std::filesystem::path& path);

/// Reads strictly: a wrong count of numbers, anything that is not a finite number, or a truncated line throws Error
/// with the line number (in files of arrays with the sample's). Throws Cancelled after a request to stop. Samples of
/// two touches together only if requested.
SampleSet loadSamples(const std::filesystem::path& path, const std::stop_token& stop = {}, bool alsoTwoAtOnce = false);

/// What was merged.
struct MergedSamples {
  std::size_t samples = 0;
  std::string warning; ///< the shards are of several programs or instruction sets; empty: of one
};

/// Joins shards, of any formats and in any order, to the bytes that one run would have written (with the names of all
/// programs where several made them). Throws Error if they do not belong together, overlap or leave a gap; Cancelled
/// after a request to stop. Holds no more samples in memory than a block.
MergedSamples mergeSampleFiles(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& path,
                               bool force, const std::stop_token& stop = {});

/// Why two sets without samples cannot share one file; empty if they can.
std::string differenceOfHeads(const SampleSet& a, const SampleSet& b);

/// The text of a CSV file of samples.
std::string samplesText(const SampleSet& set);

/// Reads it back as strictly as the file; `name` is for refusals. Throws Error.
SampleSet parseSamples(const std::string& text, const std::string& name);

} // namespace palp
