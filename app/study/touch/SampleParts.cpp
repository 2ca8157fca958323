// How a SampleGenerator solves touches in parts of their rectangle, each on a mesh of its own.

#include "app/study/touch/SampleGenerator.h"

#include "model/base/Parallel.h"
#include "model/base/ProgressRelay.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <map>
#include <utility>

namespace palp {

/// Parts are solved side by side and share the threads, as many at a time as there are threads; the last of them, where
/// they are fewer, have all threads among them.
int SampleGenerator::concurrentParts(std::size_t index) const {
  const auto threads = static_cast<std::size_t>(threadCount(request_.threads)), last = parts_.size() % threads;
  return static_cast<int>(index < parts_.size() - last ? threads : last);
}

std::size_t SampleGenerator::partOf(const LoadCase& load) const {
  if (parts_.size() == 1) return 0;
  const Eigen::Vector2d from_mm = load.indenters.front().place_mm - solved_.low_mm;
  const Eigen::Vector2d extent_mm = solved_.high_mm - solved_.low_mm;
  std::array<int, 2> at{};
  for (int d = 0; d < 2; ++d)
    if (cuts_[d] > 1) at[d] = std::clamp(static_cast<int>(from_mm(d) / extent_mm(d) * cuts_[d]), 0, cuts_[d] - 1);
  return static_cast<std::size_t>(at[1] * cuts_[0] + at[0]);
}

void SampleGenerator::Part::release() {
  if (solver) {
    solves += solver->solves();
    leftToNewton += solver->leftToNewton();
    if (solver->measuredError())
      measuredError =
          std::max({measuredError.value_or(0), *solver->measuredError(), field ? field->surrogateError() : 0});
    doubts.insert(doubts.end(), solver->nonUniqueLoads().begin(), solver->nonUniqueLoads().end());
  }
  field.reset();
  solver.reset();
  problem.reset();
}

/// Parts with the most touches come first, so that the threads end together; the last block's give their memory back as
/// they are done.
ConductionBatch::Answers SampleGenerator::answers(const std::vector<LoadCase>& loads,
                                                  const std::vector<std::size_t>& numbers, bool last,
                                                  const std::function<void(std::size_t)>& progress,
                                                  const std::stop_token& stop) {
  if (parts_.size() == 1) return answers(parts_.front(), loads, numbers, progress, stop);
  std::vector<std::vector<std::size_t>> ofParts(parts_.size());
  for (std::size_t i = 0; i < loads.size(); ++i) ofParts[partOf(loads[i])].push_back(i);
  ConductionBatch::Answers all{std::vector<ElectrodeDisplacements>(loads.size()),
                               std::vector<Eigen::MatrixXd>(loads.size())};
  std::map<int, std::vector<std::size_t>, std::greater<>> inWork; // by how many are solved side by side
  for (std::size_t p = 0; p < parts_.size(); ++p)
    if (!ofParts[p].empty()) inWork[concurrentParts(p)].push_back(p);
  for (auto& [concurrent, some] : inWork)
    std::stable_sort(some.begin(), some.end(),
                     [&](std::size_t a, std::size_t b) { return ofParts[a].size() > ofParts[b].size(); });
  const bool first = std::none_of(parts_.begin(), parts_.end(), [](const Part& p) { return p.solver || p.solves > 0; });
  std::size_t done = 0;
  ProgressRelay relay([&](std::size_t more) {
    if (progress) progress(done += more);
  });
  std::atomic<bool> whole = true;
  const std::size_t checked = inWork.begin()->second.front();
  for (const auto& [concurrent, some] : inWork)
    inParallel(some.size(), concurrent, [&, &parts = some](std::size_t k) {
      const std::size_t p = parts[k];
      if (!answerPart(p, first && p == checked, loads, numbers, ofParts[p], relay, stop, all)) whole = false;
      if (last) parts_[p].release();
    });
  for (Part& p : parts_) stages_.add(std::exchange(p.stages, {}));
  return whole ? std::move(all) : ConductionBatch::Answers{};
}

bool SampleGenerator::answerPart(std::size_t index, bool checked, const std::vector<LoadCase>& loads,
                                 const std::vector<std::size_t>& numbers, std::span<const std::size_t> own,
                                 ProgressRelay& progress, const std::stop_token& stop, ConductionBatch::Answers& all) {
  Part& part = parts_[index];
  if (!prepare(part, checked, stop)) return false;
  std::vector<LoadCase> some;
  std::vector<std::size_t> ofSome;
  for (const std::size_t i : own) {
    some.push_back(loads[i]);
    ofSome.push_back(numbers[i]);
  }
  std::size_t done = 0;
  ConductionBatch::Answers found = answers(
      part, some, ofSome, [&](std::size_t solved) { progress.add(solved - std::exchange(done, solved)); }, stop);
  part.solver->releaseMemory();
  if (found.displacements.size() < own.size()) return false;
  for (std::size_t k = 0; k < own.size(); ++k) {
    all.displacements[own[k]] = std::move(found.displacements[k]);
    all.resistances_ohm[own[k]] = std::move(found.resistances_ohm[k]);
  }
  return true;
}

} // namespace palp
