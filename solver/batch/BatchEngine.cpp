#include "solver/batch/BatchEngine.h"

#include "model/base/Parallel.h"
#include "model/base/ProgressRelay.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace palp {

namespace {

constexpr int predictorDegree = 3;
// Touches' residuals are found in single precision for this tolerance, where the rubber rounds well.
constexpr double singleTolerance = 5e-7;
constexpr double predictorFitShare =
    10; // of the tolerance, for the predictors' solves: a correction follows, 20 times better

} // namespace

BatchEngine::BatchEngine(const HyperelasticProblem& problem, std::shared_ptr<const InitialTangent> rest,
                         double tolerance, int threads, std::optional<Rectangle> touched)
    : problem_(problem), rest_(std::move(rest)),
      model_(problem_.parts(), *rest_,
             touched ? ElementwiseTangent::Order::OfFactor : ElementwiseTangent::Order::OfMesh),
      polynomial_(problem.design().forceRange, predictorDegree),
      terms_((polynomial_.terms() + lanes - 1) / lanes * lanes), predictorTolerance_(predictorFitShare * tolerance),
      threads_(threads), touched_(std::move(touched)) {
  const int areas = problem.design().areas.count();
  for (int a = 0; a < areas; ++a)
    areaShares_.push_back(tractionShares(problem.mesh(), regionOf(problem.design().areaRectangle(a))));
  predictors_.resize(areas);
  tried_.resize(areas);
}

BatchEngine::BatchEngine(const HyperelasticProblem& problem, TouchedTangent tangent, double tolerance, int threads,
                         const Rectangle& touched)
    : BatchEngine(problem, tangent.rest, tolerance, threads, touched) {
  tangent.rest->tangents = {}; // the model has them in its own order
  tangent.rest->forces = {};
  top_ = std::make_shared<const TopCompliance>(model_, problem_.mesh(), touched, std::move(tangent.compliance));
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

std::unique_ptr<LoadBatch> BatchEngine::borrowBatch() {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      std::unique_ptr<LoadBatch> batch = std::move(idle_.back());
      idle_.pop_back();
      return batch;
    }
  }
  const SensorDesign& design = problem_.design();
  const LoadBatch::Watched watched{design.lowerFollowsRubber, design.pressureLaw ? design.pressureLaw->p0_MPa : 0,
                                   design.field() != nullptr};
  return std::make_unique<LoadBatch>(model_, problem_.parts().upperProbe(), problem_.parts().lowerProbe(), watched);
}

void BatchEngine::giveBack(std::unique_ptr<LoadBatch> batch) {
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(batch));
}

void BatchEngine::rest() {
  const std::lock_guard lock(mutex_);
  idle_.clear();
}

/// False: stopped.
bool BatchEngine::findCompliance(const std::vector<Job>& jobs, const std::stop_token& stop) {
  const bool wanted =
      std::any_of(jobs.begin(), jobs.end(), [](const Job& job) { return TouchLanes::isTouch(*job.load); });
  if (wanted && !top_) top_ = TopCompliance::find(model_, problem_.mesh(), touched_, threads_, stop);
  return !wanted || top_;
}

/// Those of the areas that these loads do not touch are given back: they are the largest part of the memory (20 MB an
/// area on the default mesh), and samples come area by area. False: stopped.
bool BatchEngine::makePredictors(const std::vector<Job>& jobs, const std::stop_token& stop) {
  std::vector<char> touched(predictors_.size(), 0);
  for (const Job& job : jobs)
    for (int area : job.predicted) touched[area] = 1;
  for (std::size_t area = 0; area < predictors_.size(); ++area) {
    if (touched[area]) continue;
    predictors_[area].reset();
    tried_[area] = 0;
  }
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
  std::vector<Eigen::Vector3d> forces;
  for (int i = 0; i < batchLanes; ++i) forces.push_back(coveringForce(problem_.design().forceRange, i));
  std::array<int, batchLanes> inLane{}; // the smallest first: a block's forces end their iterations together
  std::iota(inLane.begin(), inLane.end(), 0);
  std::stable_sort(inLane.begin(), inLane.end(), [&](int a, int b) { return forces[a].norm() < forces[b].norm(); });
  std::unique_ptr<LoadBatch> batch = borrowBatch();
  for (int b = 0; b < LoadBatch::blocks; ++b) batch->reset(b);
  LaneWatch watch(predictorTolerance_);
  for (int lane = 0; lane < batchLanes; ++lane) {
    batch->addForce(lane, {&areaShares_[area], forces[inLane[lane]]});
    watch.begin(lane, 1);
  }
  std::array<double, batchLanes> worst{};
  for (int i = 0; watch.anyActive() && !stop.stop_requested(); ++i) {
    batch->iterate(watch.active, watch.change, stop);
    const auto wasActive = watch.active;
    watch.judge();
    for (int lane = 0; lane < batchLanes; ++lane)
      if (i > 0 && wasActive[lane]) worst[lane] = std::max(worst[lane], watch.contraction(lane));
  }
  solves_ += batchLanes;
  std::optional<AreaPredictor> predictor;
  const bool converged = std::find(watch.failed.begin(), watch.failed.end(), true) == watch.failed.end();
  if (converged && !stop.stop_requested()) {
    for (int b = 0; b < LoadBatch::blocks; ++b) batch->catchUp(b);
    predictor = fitted(*batch, forces, inLane);
    predictor->contraction = *std::max_element(worst.begin(), worst.end());
  }
  giveBack(std::move(batch));
  return predictor;
}

/// Coefficients by least squares: for each number of the state the row of 32 answers times the fit's matrix.
/// `inLane` is the force that each lane has.
AreaPredictor BatchEngine::fitted(const LoadBatch& batch, const std::vector<Eigen::Vector3d>& forces,
                                  const std::array<int, batchLanes>& inLane) const {
  const Eigen::MatrixXd fit = polynomial_.fit(forces); // points x terms
  LaneVector matrix(std::size_t(batchLanes) * terms_); // [terms / 8][points][8]
  for (int i = 0; i < batchLanes; ++i)
    for (int t = 0; t < polynomial_.terms(); ++t) matrix[(t / lanes * batchLanes + i) * lanes + t % lanes] = fit(i, t);
  constexpr int rowsAtOnce = 128; // 32 kB of answers
  LaneVector answers(std::size_t(rowsAtOnce) * batchLanes);
  const auto fitRows = [&](int rows, const auto& value, std::vector<double>& coefficients) {
    coefficients.resize(std::size_t(rows) * terms_);
    for (int first = 0; first < rows; first += rowsAtOnce) {
      const int some = std::min(rowsAtOnce, rows - first);
      for (int row = 0; row < some; ++row)
        for (int lane = 0; lane < batchLanes; ++lane)
          answers[row * batchLanes + inLane[lane]] = value(first + row, lane);
      for (int t = 0; t < terms_; t += lanes)
        laneKernels().addPolynomials(answers.data(), batchLanes, matrix.data() + std::size_t(t) * batchLanes, some,
                                     coefficients.data() + std::size_t(first) * terms_ + t, terms_);
    }
  };
  const int own = model_.mesh().unknowns();
  const LaneVector& displacements = batch.displacements();
  AreaPredictor predictor;
  fitRows(
      3 * model_.mesh().nodes(), [&](int row, int lane) { return displacements[std::size_t(row) * batchLanes + lane]; },
      predictor.displacements);
  fitRows(
      own * model_.mesh().elements(), [&](int row, int lane) { return batch.unknown(row / own, row % own, lane); },
      predictor.unknowns);
  return predictor;
}

/// Touches, and blocks of the other loads with the same predictors and about as much work each, so that the loads of a
/// block end their iterations together; those with most work first: a predictor's error relative to the answer falls
/// with the force, and touches take the more iterations the larger the strain, which goes with the force over the
/// square of the size.
void BatchEngine::arrange(std::vector<Job> jobs, Queue& queue) const {
  const auto work = [](const Job& job) {
    double sum = 0;
    for (const AreaLoad& area : job.areas) sum += area.force_N.norm();
    for (const Indenter& indenter : job.load->indenters) {
      const double size = indenter.shape == IndenterShape::Plane ? 1 : indenter.radius_mm;
      sum += indenter.press() ? indenter.press()->force_N.norm() / (size * size) : indenter.motion()->depth_mm / size;
    }
    return sum;
  };
  std::stable_sort(jobs.begin(), jobs.end(), [&](const Job& a, const Job& b) { return work(a) > work(b); });
  std::map<std::vector<int>, std::vector<Block>> alike;
  for (Job& job : jobs) {
    if (TouchLanes::isTouch(*job.load)) {
      queue.touches.push_back(std::move(job));
      continue;
    }
    std::erase_if(job.predicted, [&](int area) { return !predictors_[area]; });
    std::vector<Block>& blocks = alike[job.predicted];
    if (blocks.empty() || blocks.back().size() == lanes) blocks.emplace_back();
    blocks.back().push_back(std::move(job));
  }
  for (auto& [key, blocks] : alike) std::move(blocks.begin(), blocks.end(), std::back_inserter(queue.blocks));
}

void BatchEngine::addForces(LoadBatch& batch, int lane, const Job& job) const {
  for (const AreaLoad& area : job.areas) batch.addForce(lane, {&areaShares_[area.area], area.force_N});
  for (std::size_t p = 0; p < job.patchShares.size(); ++p)
    batch.addForce(lane, {&job.patchShares[p], job.load->patches[p].force_N});
}

/// Loads of a block and where its iteration starts: the predictors of its areas, superposed.
void BatchEngine::start(LoadBatch& batch, LaneWatch& watch, int block, const Block& jobs) const {
  batch.reset(block);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const int lane = block * lanes + static_cast<int>(i);
    addForces(batch, lane, jobs[i]);
    watch.begin(lane, assumedContraction(jobs[i]));
  }
  for (int area : jobs.front().predicted) {
    LaneVector monomials(std::size_t(terms_) * lanes);
    for (std::size_t i = 0; i < jobs.size(); ++i)
      for (const AreaLoad& load : jobs[i].areas)
        if (load.area == area) {
          const Eigen::VectorXd values = polynomial_.monomials(load.force_N);
          for (Eigen::Index t = 0; t < values.size(); ++t) monomials[t * lanes + i] = values(t);
        }
    batch.addPolynomials(block, predictors_[area]->displacements, predictors_[area]->unknowns, terms_,
                         monomials.data());
  }
}

/// That of its area's predictor where it says all about the load; 1: nothing is known.
double BatchEngine::assumedContraction(const Job& job) const {
  const bool predicted =
      job.predicted.size() == 1 && job.areas.size() == 1 && job.patchShares.empty() && job.load->indenters.empty();
  return predicted ? predictors_[job.predicted.front()]->contraction : 1;
}

/// Lane and free lane by which touches come to need one block less than they take, step by step.
std::optional<std::pair<int, int>> BatchEngine::gapOf(const Touching& touching) {
  std::array<int, LoadBatch::blocks> used{};
  for (int lane = 0; lane < batchLanes; ++lane) used[lane / lanes] += touching[lane] ? 1 : 0;
  int free = 0, emptiest = -1;
  for (int b = 0; b < LoadBatch::blocks; ++b) {
    if (used[b] == 0) continue;
    free += lanes - used[b];
    if (emptiest < 0 || used[b] < used[emptiest]) emptiest = b;
  }
  if (free < lanes) return {};
  const auto in = [&](int block, bool taken) {
    for (int lane = block * lanes; lane < (block + 1) * lanes; ++lane)
      if (bool(touching[lane]) == taken) return lane;
    return -1;
  };
  for (int b = 0; b < LoadBatch::blocks; ++b)
    if (b != emptiest && used[b] > 0 && used[b] < lanes) return std::pair{in(emptiest, true), in(b, false)};
  return {};
}

/// Works the queue off and gives back each load with its lane and answer. A block or touch that has been iterated makes
/// room for the next, so that the substitutions' lanes stay full.
template <class Give>
void BatchEngine::workOff(Queue& queue, double tolerance, const Give& give, const std::stop_token& stop) {
  std::unique_ptr<LoadBatch> batch = borrowBatch();
  LaneWatch watch(tolerance);
  TouchLanes touches(top_, problem_);
  const bool inSingle = tolerance >= singleTolerance && model_.rubber().roundsWell();
  std::array<const Block*, LoadBatch::blocks> blocks{};
  Touching touching{}; // in the other blocks
  while (!stop.stop_requested()) {
    for (int b = 0; b < LoadBatch::blocks; ++b) {
      const auto first = touching.begin() + b * lanes;
      const bool free = !blocks[b] && std::all_of(first, first + lanes, [](const Job* job) { return !job; });
      if (free && (blocks[b] = queue.nextBlock())) start(*batch, watch, b, *blocks[b]);
    }
    for (int lane = 0; lane < batchLanes; ++lane) {
      if (blocks[lane / lanes] || touching[lane] || !(touching[lane] = queue.nextTouch())) continue;
      touches.begin(lane, *touching[lane]->load, *batch, watch, inSingle);
      addForces(*batch, lane, *touching[lane]);
    }
    if (!watch.anyActive()) break;
    while (const auto gap = gapOf(touching)) { // there were no more to fill it
      const auto [from, to] = *gap;
      batch->move(from, to);
      watch.move(from, to);
      touches.move(from, to);
      touching[to] = std::exchange(touching[from], nullptr);
      if (!watch.anyActive(from / lanes)) batch->retire(from / lanes);
    }
    touches.iterate(*batch, watch, stop);
    if (stop.stop_requested()) break; // the iteration may be unfinished
    const std::array<bool, batchLanes> wasActive = watch.active;
    watch.judge();
    touches.goOn(*batch, watch, wasActive);
    for (int b = 0; b < LoadBatch::blocks; ++b) {
      std::vector<std::pair<int, const Job*>> ended;
      for (int lane = b * lanes; lane < (b + 1) * lanes; ++lane)
        if (touching[lane] && !watch.active[lane]) ended.emplace_back(lane, std::exchange(touching[lane], nullptr));
      if (blocks[b] && !watch.anyActive(b)) {
        for (std::size_t i = 0; i < blocks[b]->size(); ++i) ended.emplace_back(b * lanes + int(i), &(*blocks[b])[i]);
        blocks[b] = nullptr;
      }
      if (ended.empty()) continue;
      std::vector<ElectrodeDisplacements> found = batch->electrodes(b);
      for (const auto& [lane, job] : ended) {
        give(*job, lane, watch.failed[lane] ? Answer() : std::move(found[std::size_t(lane % lanes)]), *batch);
        touches.end(lane);
      }
      if (!watch.anyActive(b)) batch->retire(b);
    }
  }
  giveBack(std::move(batch));
}

std::vector<BatchEngine::Answer> BatchEngine::solve(std::span<const LoadCase> loads, double tolerance,
                                                    const std::function<void(std::size_t)>& done,
                                                    const std::stop_token& stop, const BatchSolver::TakeState& state) {
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < loads.size(); ++i)
    if (!TouchLanes::hasFriction(loads[i]) || (loads[i].areas.empty() && loads[i].patches.empty()))
      jobs.push_back(job(loads[i], i)); // the others grow with it
  const std::size_t leftOut = loads.size() - jobs.size();
  if (!findCompliance(jobs, stop) || !makePredictors(jobs, stop)) return {};
  Queue queue;
  arrange(std::move(jobs), queue);
  std::vector<Answer> answers(loads.size());
  ProgressRelay progress(done);
  if (leftOut > 0) progress.add(leftOut);
  const auto give = [&](const Job& job, int lane, Answer found, LoadBatch& batch) {
    const bool withUnknowns = state && problem_.design().pressureLaw;
    if (withUnknowns) batch.catchUp(lane / lanes);
    if (state && found)
      state(job.index, *found,
            {1, batch.displacementsOf(lane), withUnknowns ? batch.unknownsOf(lane) : Eigen::MatrixXd()});
    answers[job.index] = std::move(found);
    progress.add(1);
  };
  const std::size_t blocks = queue.blocks.size() + (queue.touches.size() + lanes - 1) / lanes;
  const auto batches = static_cast<int>((blocks + LoadBatch::blocks - 1) / LoadBatch::blocks);
  forChunks(std::min(batches, threadCount(threads_)), 1, threads_, [&](int, int) {
    try {
      workOff(queue, tolerance, give, stop);
    } catch (...) {
      queue.leave(); // the other threads need not go on
      throw;
    }
  });
  if (stop.stop_requested()) return {};
  solves_ += loads.size() - leftOut;
  return answers;
}

} // namespace palp
