#pragma once

// Private to io: what is the same for every format of sample files.

#include "model/SampleSet.h"

#include <filesystem>
#include <functional>
#include <map>
#include <stop_token>
#include <string>
#include <variant>
#include <vector>

namespace palp {

/// One array of a binary sample file, under its name: the numbers of each sample in order, and their unit.
struct SampleArray {
  std::string name; ///< "forces_N"
  std::string unit;
  std::vector<std::uint64_t> shape; ///< of one sample, the slowest index first: row-wires, column-wires
  Eigen::MatrixXd SampleSet::*values = nullptr;
};

constexpr const char* kAreaArray = "area";       ///< of each sample, whole numbers
constexpr const char* kColumnsArray = "columns"; ///< names of the columns that the same samples have in CSV

constexpr const char* kNamesArray = "arrays"; ///< names of the arrays, in the order of those columns

/// The arrays of the set other than `area`, in the order of the columns in CSV.
std::vector<SampleArray> sampleArrays(const SampleSet& head);

/// Gives each matrix `samples` columns; existing ones stay.
void resizeSamples(SampleSet& set, Eigen::Index samples);
/// Samples first .. first + count - 1.
SampleSet samplesBetween(const SampleSet& set, Eigen::Index first, Eigen::Index count);

/// The value of a key of the head.
using HeadValue = std::variant<std::string, std::uint64_t, double>;
/// The comment lines of the head as keys and values: whole numbers, numbers, texts.
std::vector<std::pair<std::string, HeadValue>> headValues(const SampleSet& head);
/// `area`, and the names of the other arrays.
std::vector<std::string> arrayNames(const SampleSet& head);
/// The names of the columns, one by one.
std::vector<std::string> columnNames(const SampleSet& head);
/// A set without samples from keys, values as text and names of columns. Throws Error with the file's name.
SampleSet headFrom(const std::filesystem::path& file, const std::map<std::string, std::string>& values,
                   const std::vector<std::string>& columns);

/// Refuses an area that the head does not allow and a number that is not finite, by the sample's number in the file,
/// which is that of the set's first column plus `before`. Looks at columns first .. first + count - 1; at their areas
/// alone where somebody saw before that all numbers are `finite`.
void requireSamples(const std::filesystem::path& file, const SampleSet& set, Eigen::Index first, Eigen::Index count,
                    Eigen::Index before, bool finite = false);

/// Samples that a writer requests block by block, as often as it needs.
struct SampleRows {
  SampleSet head; ///< without samples
  Eigen::Index count = 0;
  std::function<SampleSet(Eigen::Index first, Eigen::Index count)> block;
};

/// How many samples are handled together: a power of two, for about a megabyte in the largest array.
Eigen::Index samplesAtOnce(const SampleSet& head);

} // namespace palp
