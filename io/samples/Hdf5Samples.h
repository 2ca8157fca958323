#pragma once

// Private to io.

#include "io/samples/SampleArrays.h"
#include "io/samples/SampleReader.h"

namespace palp {

/// Samples in HDF5: the keys of the head are attributes of the file; each array is a dataset in chunks, with its unit;
/// dataset `columns` holds the names that the numbers have in CSV (resources/docs/formats.md).
std::unique_ptr<SampleReader> openHdf5Samples(const std::filesystem::path& path, const std::stop_token& stop);

/// The same bytes at any number of threads. Throws Error, or Cancelled; what was written then is of no use.
void writeHdf5Samples(const std::filesystem::path& path, const SampleRows& rows, const std::stop_token& stop);

} // namespace palp
