#include "app/study/decoding/measured/SampleSplit.h"

#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/NumberText.h"
#include "model/base/Text.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace palp {

namespace {

constexpr std::size_t kRunsNeeded = 5;

/// The first row of each run.
std::vector<Eigen::Index> beginsOfRuns(const SampleSet& samples) {
  std::vector<Eigen::Index> begins{0};
  for (Eigen::Index i = 1; samples.runs.rows() > 0 && i < samples.size(); ++i)
    if (samples.runs(0, i) != samples.runs(0, i - 1)) begins.push_back(i);
  return begins;
}

/// Number of `count` parts to train with: at least one on both sides.
Eigen::Index trained(std::size_t count, double share) {
  return std::clamp<Eigen::Index>(std::llround(share * static_cast<double>(count)), 1,
                                  static_cast<Eigen::Index>(count) - 1);
}

} // namespace

std::optional<SampleSplit> sampleSplit(const std::string& text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::optional<SplitBy> by = kSplits.find(text.substr(0, colon));
  if (!by) return {};
  SampleSplit split{*by};
  if (colon == text.size()) return split;
  const std::optional<double> share = numberIn(text.substr(colon + 1));
  if (!share || !(*share > 0 && *share < 1)) return {};
  split.share = *share;
  return split;
}

SplitSamples split(const SampleSet& samples, const SampleSplit& by) {
  if (samples.size() < 2)
    throw Error("split: " + gotExpected(std::to_string(samples.size()) + " samples", "2 or more"));
  Eigen::Index cut = 0;
  if (by.by == SplitBy::Runs) {
    const std::vector<Eigen::Index> begins = beginsOfRuns(samples);
    if (begins.size() < 2) throw Error("split: runs: " + gotExpected("1 run", "2 or more"));
    cut = begins[static_cast<std::size_t>(trained(begins.size(), by.share))];
  } else {
    cut = trained(static_cast<std::size_t>(samples.size()), by.share);
  }
  std::vector<Eigen::Index> first, last;
  for (Eigen::Index i = 0; i < samples.size(); ++i) (i < cut ? first : last).push_back(i);
  return {samplesAt(samples, first), samplesAt(samples, last)};
}

SampleSplit laterRows(const SampleSet& samples) {
  return {beginsOfRuns(samples).size() >= kRunsNeeded ? SplitBy::Runs : SplitBy::Time};
}

} // namespace palp
