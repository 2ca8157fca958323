#pragma once

// Private to io.

#include "io/samples/SampleArrays.h"
#include "io/samples/SampleReader.h"

namespace palp {

/// Samples in NPZ: the keys of the head are arrays without dimensions; then the arrays of numbers, and `columns` with
/// the names that they have in CSV (resources/docs/formats.md).
std::unique_ptr<SampleReader> openNpzSamples(const std::filesystem::path& path);

/// Asks for the rows once an array. Throws Error, or Cancelled; what was written then is of no use.
void writeNpzSamples(const std::filesystem::path& path, const SampleRows& rows, const std::stop_token& stop);

} // namespace palp
