#pragma once

#include "app/gui/jobs/NetworkSession.h"

#include <filesystem>
#include <stop_token>
#include <vector>

namespace palp {

/// Files of samples and networks that the window opens and saves; all of it is work for a job. Training samples stand
/// in NAME.csv and those for testing in NAME-test.csv beside it (resources/docs/formats.md).

/// The name of the file with the test samples that belong to this one.
std::filesystem::path testFileOf(const std::filesystem::path& file);

/// Both sets, each written beside and renamed. Throws Error.
void saveSampleFiles(const std::filesystem::path& file, const NetworkSamples& samples);

/// Samples from files in any order: shards of one request are joined; where they are of two requests, the second one's
/// are for testing (the one with the seed of a test, where there is one), and so is NAME-test.csv beside a single
/// NAME.csv. Without any, every fifth sample of each area is kept for testing. Throws Error where they are no samples,
/// of another design than this, leave a gap or were made with all areas loaded together.
NetworkSamples openSampleFiles(const std::vector<std::filesystem::path>& files, const SensorDesign& design,
                               const std::stop_token& stop);

/// The decoder tried on the test samples. Throws Error where it does not fit them.
std::shared_ptr<const NetworkFit> triedOn(Decoder decoder, const NetworkSamples& samples);

/// Samples and networks of a design in a folder of their own, which is made: samples.csv, samples-test.csv,
/// network.json and, in networks, those that can be gone back to, each with the settings it was trained with. Throws
/// Error.
void saveResults(const std::filesystem::path& folder, const NetworkResults& results);

/// What saveResults() wrote; nothing where the folder holds no samples. Throws Error where it cannot be read or is of
/// another design.
NetworkResults openResults(const std::filesystem::path& folder, const SensorDesign& design,
                           const std::stop_token& stop);

} // namespace palp
