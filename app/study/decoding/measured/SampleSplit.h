#pragma once

#include "model/SampleSet.h"
#include "model/base/NamedEnum.h"

#include <optional>
#include <string>

namespace palp {

/// What is kept back for a test: the last rows, or the last runs.
enum class SplitBy { Time, Runs };
inline constexpr NamedEnum kSplits("split",
                                   std::array{std::pair{SplitBy::Time, "time"}, std::pair{SplitBy::Runs, "runs"}});

/// How a set is divided into training and test.
struct SampleSplit {
  SplitBy by = SplitBy::Time;
  double share = 0.8; ///< for training, above 0 and below 1
};

/// The split of "time", "runs", "time:0.7" or "runs:0.7"; nullopt for other texts.
std::optional<SampleSplit> sampleSplit(const std::string& text);

struct SplitSamples {
  SampleSet training, test;
};
/// The first share of the rows (or runs) to train with, the others to test with. Throws Error if one of the two parts
/// would be empty, and for runs if the set has fewer than two.
SplitSamples split(const SampleSet& samples, const SampleSplit& by);

/// The split of measured samples that shows the error on later rows: the last fifth of the runs if there are five or
/// more, else the last fifth of the rows.
SampleSplit laterRows(const SampleSet& samples);

} // namespace palp
