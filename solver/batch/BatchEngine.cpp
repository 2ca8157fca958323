#include "solver/batch/BatchEngine.h"

#include "model/base/Parallel.h"

#include <algorithm>
#include <map>

namespace palp {

namespace {

constexpr int predictorDegree = 3;
constexpr int mostIterations = 30;
constexpr double fitShare = 10; // of the tolerance, for the predictors' solves: a correction follows, 20 times better
constexpr double slowestContraction = 0.8; // above it full Newton is the better way
constexpr double cautionary = 1.5;         // on measured contractions

/// Follows the change of each lane and tells when its error, by the geometric series, is below the tolerance.
class LaneWatch {
public:
  LaneWatch(double tolerance, const std::array<double, batchLanes>& assumedContraction)
      : tolerance_(tolerance), contraction_(assumedContraction) {}

  std::array<bool, batchLanes> active{}, failed{};
  std::array<double, batchLanes> change{};

  [[nodiscard]] bool anyActive() const { return std::find(active.begin(), active.end(), true) != active.end(); }
  [[nodiscard]] double contraction(int lane) const { return contraction_[lane]; }

  void judge(int iteration) {
    for (int lane = 0; lane < batchLanes; ++lane) {
      if (!active[lane]) continue;
      const double c = change[lane];
      if (iteration > 0 && previous_[lane] > 0) contraction_[lane] = cautionary * c / previous_[lane];
      const bool hopeless = iteration > 2 && contraction_[lane] > cautionary * slowestContraction;
      if (c < 0 || hopeless || iteration + 1 == mostIterations) {
        failed[lane] = true;
        active[lane] = false;
      } else if (c == 0 ||
                 (contraction_[lane] < 1 && c * contraction_[lane] / (1 - contraction_[lane]) <= tolerance_)) {
        active[lane] = false;
      }
      previous_[lane] = c;
    }
  }

private:
  double tolerance_;
  std::array<double, batchLanes> contraction_, previous_{};
};

} // namespace

BatchEngine::BatchEngine(const HyperelasticProblem& problem, std::shared_ptr<const InitialTangent> rest,
                         double tolerance, int threads)
    : problem_(problem), rest_(std::move(rest)), model_(problem_.parts(), *rest_),
      polynomial_(problem.design().forceRange, predictorDegree),
      terms_((polynomial_.terms() + lanes - 1) / lanes * lanes), predictorTolerance_(fitShare * tolerance),
      threads_(threads) {
  const int areas = problem.design().areas.count();
  for (int a = 0; a < areas; ++a)
    areaShares_.push_back(tractionShares(problem.mesh(), regionOf(problem.design().areaRectangle(a))));
  predictors_.resize(areas);
  tried_.resize(areas);
}

BatchEngine::Job BatchEngine::job(const LoadCase& load, std::size_t index) const {
  Job job;
  job.index = index;
  job.load = &load;
  std::map<int, Eigen::Vector3d> sums;
  for (const AreaLoad& a : load.areas) sums.try_emplace(a.area, Eigen::Vector3d::Zero()).first->second += a.force_N;
  for (const auto& [area, force_N] : sums) {
    job.areas.push_back({area, force_N});
    if (inRange(problem_.design().forceRange, force_N)) job.predicted.push_back(area);
  }
  for (const PatchLoad& patch : load.patches)
    job.patchShares.push_back(tractionShares(problem_.mesh(), regionOf(patch)));
  return job;
}

std::unique_ptr<LoadBatch> BatchEngine::borrowGroup() {
  std::unique_ptr<LoadBatch> group;
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      group = std::move(idle_.back());
      idle_.pop_back();
    }
  }
  if (!group) group = std::make_unique<LoadBatch>(model_, problem_.parts().upperProbe());
  group->reset();
  return group;
}

void BatchEngine::giveBack(std::unique_ptr<LoadBatch> group) {
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(group));
}

/// False: stopped.
bool BatchEngine::makePredictors(const std::vector<Job>& jobs, const std::stop_token& stop) {
  std::vector<int> wanted;
  for (const Job& job : jobs)
    for (int area : job.predicted)
      if (!tried_[area]) {
        tried_[area] = 1;
        wanted.push_back(area);
      }
  forChunks(static_cast<int>(wanted.size()), 1, threads_,
            [&](int i, int) { predictors_[wanted[i]] = fitPredictor(wanted[i], stop); });
  if (!stop.stop_requested()) return true;
  for (int area : wanted) tried_[area] = 0;
  return false;
}

/// Solves 32 covering forces from rest; none where one of them does not converge.
std::optional<AreaPredictor> BatchEngine::fitPredictor(int area, const std::stop_token& stop) {
  std::unique_ptr<LoadBatch> group = borrowGroup();
  std::vector<Eigen::Vector3d> forces;
  std::array<double, batchLanes> unknown;
  unknown.fill(1);
  LaneWatch watch(predictorTolerance_, unknown);
  for (int lane = 0; lane < batchLanes; ++lane) {
    forces.push_back(coveringForce(problem_.design().forceRange, lane));
    group->addForce(lane, {&areaShares_[area], forces.back()});
  }
  watch.active.fill(true);
  std::array<double, batchLanes> worst{};
  for (int i = 0; watch.anyActive() && !stop.stop_requested(); ++i) {
    group->iterate(watch.active, watch.change, stop);
    const auto wasActive = watch.active;
    watch.judge(i);
    for (int lane = 0; lane < batchLanes; ++lane)
      if (i > 0 && wasActive[lane]) worst[lane] = std::max(worst[lane], watch.contraction(lane));
  }
  solves_ += batchLanes;
  std::optional<AreaPredictor> predictor;
  const bool converged = std::find(watch.failed.begin(), watch.failed.end(), true) == watch.failed.end();
  if (converged && !stop.stop_requested()) {
    predictor = fitted(*group, forces);
    predictor->contraction = *std::max_element(worst.begin(), worst.end());
  }
  giveBack(std::move(group));
  return predictor;
}

/// Coefficients by least squares: for each number of the state the row of 32 answers times the fit's matrix.
AreaPredictor BatchEngine::fitted(const LoadBatch& group, const std::vector<Eigen::Vector3d>& forces) const {
  const Eigen::MatrixXd fit = polynomial_.fit(forces); // points x terms
  AreaPredictor predictor;
  const int own = model_.mesh().unknowns(), rows = 3 * model_.mesh().nodes(), ownRows = own * model_.mesh().elements();
  predictor.displacements.resize(std::size_t(rows) * terms_);
  predictor.unknowns.resize(std::size_t(ownRows) * terms_);
  LaneVector answers(std::size_t(ownRows) * batchLanes);
  for (int row = 0; row < ownRows; ++row)
    for (int lane = 0; lane < batchLanes; ++lane)
      answers[std::size_t(row) * batchLanes + lane] =
          group.unknowns()[((std::size_t(row / own) * LoadBatch::blocks + lane / lanes) * own + row % own) * lanes +
                           lane % lanes];
  for (int first = 0; first < terms_; first += lanes) {
    LaneVector matrix(batchLanes * lanes);
    for (int lane = 0; lane < batchLanes; ++lane)
      for (int t = first; t < std::min(first + lanes, polynomial_.terms()); ++t)
        matrix[lane * lanes + t - first] = fit(lane, t);
    const auto& kernels = laneKernels();
    kernels.addPolynomials(group.displacements().data(), batchLanes, matrix.data(), rows,
                           predictor.displacements.data() + first, terms_);
    kernels.addPolynomials(answers.data(), batchLanes, matrix.data(), ownRows, predictor.unknowns.data() + first,
                           terms_);
  }
  return predictor;
}

/// Blocks of loads with the same predictors, in the loads' order.
std::vector<BatchEngine::Block> BatchEngine::blocksOf(std::vector<Job> jobs) const {
  std::map<std::vector<int>, std::vector<Block>> byPredictors;
  for (Job& job : jobs) {
    std::erase_if(job.predicted, [&](int area) { return !predictors_[area]; });
    std::vector<Block>& blocks = byPredictors[job.predicted];
    if (blocks.empty() || blocks.back().size() == lanes) blocks.emplace_back();
    blocks.back().push_back(std::move(job));
  }
  std::vector<Block> all;
  for (auto& [key, blocks] : byPredictors) std::move(blocks.begin(), blocks.end(), std::back_inserter(all));
  return all;
}

/// Loads of a block and where its iteration starts: the predictors of its areas, superposed.
void BatchEngine::start(LoadBatch& group, int block, const Block& jobs) const {
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const int lane = block * lanes + static_cast<int>(i);
    for (const AreaLoad& area : jobs[i].areas) group.addForce(lane, {&areaShares_[area.area], area.force_N});
    for (std::size_t p = 0; p < jobs[i].patchShares.size(); ++p)
      group.addForce(lane, {&jobs[i].patchShares[p], jobs[i].load->patches[p].force_N});
  }
  for (int area : jobs.front().predicted) {
    LaneVector monomials(std::size_t(terms_) * lanes);
    for (std::size_t i = 0; i < jobs.size(); ++i)
      for (const AreaLoad& load : jobs[i].areas)
        if (load.area == area) {
          const Eigen::VectorXd values = polynomial_.monomials(load.force_N);
          for (Eigen::Index t = 0; t < values.size(); ++t) monomials[t * lanes + i] = values(t);
        }
    group.addPolynomials(block, predictors_[area]->displacements, predictors_[area]->unknowns, terms_,
                         monomials.data());
  }
}

void BatchEngine::solveGroup(std::span<const Block> blocks, double tolerance, std::vector<Answer>& answers,
                             const std::stop_token& stop) {
  std::unique_ptr<LoadBatch> group = borrowGroup();
  std::array<double, batchLanes> contraction;
  contraction.fill(1);
  std::array<bool, batchLanes> used{};
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    start(*group, static_cast<int>(b), blocks[b]);
    for (std::size_t i = 0; i < blocks[b].size(); ++i) {
      const Job& job = blocks[b][i];
      used[b * lanes + i] = true;
      if (job.predicted.size() == 1 && job.areas.size() == 1 && job.patchShares.empty())
        contraction[b * lanes + i] = predictors_[job.predicted.front()]->contraction;
    }
  }
  LaneWatch watch(tolerance, contraction);
  watch.active = used;
  for (int i = 0; watch.anyActive() && !stop.stop_requested(); ++i) {
    group->iterate(watch.active, watch.change, stop);
    watch.judge(i);
  }
  if (!stop.stop_requested()) {
    std::vector<ElectrodeDisplacements> all = group->electrodes(problem_.parts().lowerProbe());
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (std::size_t i = 0; i < blocks[b].size(); ++i)
        if (const std::size_t lane = b * lanes + i; !watch.failed[lane])
          answers[blocks[b][i].index] = std::move(all[lane]);
  }
  giveBack(std::move(group));
}

std::vector<BatchEngine::Answer> BatchEngine::solve(std::span<const LoadCase> loads, double tolerance,
                                                    const std::function<void(std::size_t)>& done,
                                                    const std::stop_token& stop) {
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < loads.size(); ++i) jobs.push_back(job(loads[i], i));
  if (!makePredictors(jobs, stop)) return {};
  const std::vector<Block> blocks = blocksOf(std::move(jobs));
  std::vector<Answer> answers(loads.size());
  std::mutex doneMutex;
  forChunks(static_cast<int>(blocks.size()), LoadBatch::blocks, threads_, [&](int begin, int end) {
    if (stop.stop_requested()) return;
    const std::span<const Block> group(blocks.data() + begin, blocks.data() + end);
    solveGroup(group, tolerance, answers, stop);
    std::size_t count = 0;
    for (const Block& block : group) count += block.size();
    const std::lock_guard lock(doneMutex);
    if (done && !stop.stop_requested()) done(count);
  });
  if (stop.stop_requested()) return {};
  solves_ += loads.size();
  return answers;
}

} // namespace palp
