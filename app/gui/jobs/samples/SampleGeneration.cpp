#include "app/gui/jobs/samples/SampleGeneration.h"

#include "app/study/paper/PaperProtocol.h"
#include "app/study/touch/SampleGenerator.h"
#include "solver/MeshCost.h"

#include <algorithm>
#include <utility>

namespace palp {

namespace {

constexpr double kFitsShare = 0.9; ///< of the time for samples by surrogates

/// An empty set with the size of the request.
SampleSet allocated(SampleSet set, std::size_t total) {
  const auto columns = static_cast<Eigen::Index>(total);
  set.area.resize(columns);
  for (const auto part : kSampleParts) (set.*part).resize((set.*part).rows(), columns);
  return set;
}

void put(SampleSet& set, const SampleSet& block, std::size_t at) {
  const auto first = static_cast<Eigen::Index>(at);
  set.area.segment(first, block.size()) = block.area;
  for (const auto part : kSampleParts)
    if ((set.*part).rows() > 0) (set.*part).middleCols(first, block.size()) = block.*part;
}

} // namespace

bool SampleGeneration::make(StageLog& stages, const std::stop_token& stop, JobProgress& progress) {
  progress.set(-1, "Meshing and preparing the solver");
  clock_.start();
  ++runs_;
  left_ = {};
  SampleRequest request;
  if (settings_.touches) {
    request.touches = rangeOf(*settings_.touches, design_);
    request.perArea = settings_.touches->count;
  } else {
    request.perArea = settings_.perArea;
    request.surrogate = settings_.surrogate;
  }
  request.mesh = mesh_;
  SampleGenerator generator(design_, request); // both sets need one preparation
  progress.set(-1, "Meshing and preparing the solver" + costInBrief(meshCost(design_, generator.meshing())));
  bool fits = false;
  generator.whileFitting([&](std::size_t done, std::size_t all) {
    if (!std::exchange(fits, true)) fitsBegun_s_ = now_s();
    reportFits(done, all, progress);
  });
  bool whole = true;
  for (const std::size_t set : {0, 1}) whole = whole && makeSet(set, generator, stop, progress);
  batchError_ = std::max(batchError_, generator.measuredError());
  redrawn_ += generator.redrawn();
  if (std::string doubts = generator.doubts(); !doubts.empty()) doubts_ = std::move(doubts);
  stages.add(generator.stages());
  took_s_ += now_s();
  return whole;
}

bool SampleGeneration::makeSet(std::size_t set, SampleGenerator& generator, const std::stop_token& stop,
                               JobProgress& progress) {
  generator.setSeed(set == 1 ? testSeed(settings_.seed) : settings_.seed);
  total_[set] = generator.total();
  const std::size_t kept = made_[set];
  if (kept == total_[set] && kept > 0) return true;
  SampleSet empty = generator.emptySet(stop); // prepares
  if (stop.stop_requested()) return false;
  if (kept == 0) sets_[set] = allocated(std::move(empty), total_[set]);
  left_.begin(static_cast<double>(made_[0] + made_[1]), now_s());
  generator.generate(
      {kept, total_[set]},
      [&](const SampleSet& block) {
        put(sets_[set], block, made_[set]);
        made_[set] += static_cast<std::size_t>(block.size());
      },
      [&](std::size_t done) { report(set, kept + done, progress); }, stop);
  left_.pause(static_cast<double>(made_[0] + made_[1]), now_s());
  return made_[set] == total_[set];
}

void SampleGeneration::report(std::size_t set, std::size_t done, JobProgress& progress) const {
  const std::size_t all = 2 * total_[set], there = done + (set == 1 ? total_[0] : 0);
  const auto made = static_cast<double>(there), wanted = static_cast<double>(all);
  const double fits = settings_.surrogate && !settings_.touches ? kFitsShare : 0;
  progress.set(fits + (1 - fits) * made / wanted, "Sample " + std::to_string(there) + " of " + std::to_string(all) +
                                                      leftInWords(left_.left_s(made, wanted, now_s())));
}

void SampleGeneration::reportFits(std::size_t done, std::size_t all, JobProgress& progress) const {
  TimeLeft left; // one area takes about as long as another
  left.begin(0, fitsBegun_s_);
  const auto made = static_cast<double>(done), wanted = static_cast<double>(all);
  progress.set(kFitsShare * made / wanted, "Surrogate of area " + std::to_string(done) + " (" +
                                               std::to_string(done + 1) + " of " + std::to_string(all) + ")" +
                                               leftInWords(left.left_s(made, wanted, now_s())));
}

std::shared_ptr<const NetworkSamples> SampleGeneration::samples() {
  auto all = std::make_shared<NetworkSamples>();
  all->training = std::move(sets_[0]);
  all->test = std::move(sets_[1]);
  all->batchError = batchError_;
  all->redrawn = redrawn_;
  all->doubts = QString::fromStdString(doubts_);
  all->settings = settings_;
  all->mesh = mesh_;
  all->seconds = took_s_;
  return all;
}

std::array<std::size_t, 2> SampleGeneration::state() const {
  if (made_[0] == 0) return {0, 0};
  return {made_[0] + made_[1], 2 * total_[0]};
}

} // namespace palp
