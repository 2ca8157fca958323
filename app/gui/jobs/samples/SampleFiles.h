#pragma once

#include "model/SensorDesign.h"

#include <filesystem>
#include <stop_token>
#include <vector>

namespace palp {

class FilesTogether;
struct NetworkSamples;

/// Files of samples that the window opens and saves; all of it is work for a job. Training samples are in NAME.csv
/// and those for testing in NAME-test.csv next to it (resources/docs/formats.md).

/// The name of the file with the test samples that belong to this one.
std::filesystem::path testFileOf(const std::filesystem::path& file);

/// Both sets, or neither where they cannot be written. Throws Error.
void saveSampleFiles(const std::filesystem::path& file, const NetworkSamples& samples);
/// The same next to other files. Throws Error.
void addSamples(FilesTogether& writing, const std::filesystem::path& file, const NetworkSamples& samples);

/// "every fifth sample": which samples are for testing where a file has no others for it.
QString heldOutWords(const SampleSet& training);

/// By what its first lines say. Throws Error where it begins as no file of samples does, and names it by what it is.
void requireSamples(const std::filesystem::path& file);

/// Samples from files in any order: shards of one request are joined; where they are of two requests, the second one's
/// are for testing (the one with the seed of a test, where there is one), and so is NAME-test.csv next to a single
/// NAME.csv, or else test.csv next to a single train.csv. Without any, every fifth sample of each area is kept for
/// testing, or of measured samples the last fifth (SampleSplit.h). Throws Error where they are not samples, or of
/// another design than this (but imported ones, which may be of none), of two rigs, leave a gap or were made with all
/// areas loaded together.
NetworkSamples openSampleFiles(const std::vector<std::filesystem::path>& files, const SensorDesign& design,
                               const std::stop_token& stop);
/// The same, whatever files are next to a single one.
NetworkSamples openTheseSampleFiles(const std::vector<std::filesystem::path>& files, const SensorDesign& design,
                                    const std::stop_token& stop);

} // namespace palp
