#include "app/study/StageLog.h"

namespace palp {

void StageLog::add(const std::string& stage, double seconds) {
  Count& count = counts_[stage];
  ++count.runs;
  count.seconds += seconds;
}

void StageLog::add(const StageLog& other) {
  for (const auto& [stage, count] : other.counts_) {
    counts_[stage].runs += count.runs;
    counts_[stage].seconds += count.seconds;
  }
}

int StageLog::runs(const std::string& stage) const {
  const auto found = counts_.find(stage);
  return found == counts_.end() ? 0 : found->second.runs;
}

} // namespace palp
