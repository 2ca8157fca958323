#include "solver/batch/BatchEngine.h"

#include "model/base/Parallel.h"
#include "model/base/ProgressRelay.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace palp {

namespace {

constexpr int predictorDegree = 3;
// From this tolerance on, residuals of touches are computed in single precision where the rubber's law permits.
constexpr double singleTolerance = 5e-7;
constexpr double predictorFitShare =
    10; // times the tolerance, for the predictors' solves: the correction that follows is 20 times better

} // namespace

BatchEngine::BatchEngine(const HyperelasticProblem& problem, std::shared_ptr<const InitialTangent> rest,
                         double tolerance, int threads, std::optional<Rectangle> touched)
    : problem_(problem), rest_(std::move(rest)),
      model_(problem_.block(), *rest_,
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
  tangent.rest->tangents = {}; // the model has copied them
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

std::unique_ptr<LoadBatch> BatchEngine::acquireBatch() {
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
  return std::make_unique<LoadBatch>(model_, problem_.block().upperProbe(), problem_.block().lowerProbe(), watched);
}

void BatchEngine::releaseBatch(std::unique_ptr<LoadBatch> batch) {
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(batch));
}

void BatchEngine::releaseMemory() {
  const std::lock_guard lock(mutex_);
  idle_.clear();
}

/// Finds the compliance of the top face at the first load with an indenter. Returns false if cancelled.
bool BatchEngine::findCompliance(const std::vector<Job>& jobs, const std::stop_token& stop) {
  const bool needed =
      std::any_of(jobs.begin(), jobs.end(), [](const Job& job) { return ContactColumns::isTouch(*job.load); });
  if (needed && !top_) top_ = TopCompliance::find(model_, problem_.mesh(), touched_, threads_, stop);
  return !needed || top_;
}

/// Fits the predictors of these loads' areas, and frees the others: predictors are the largest part of the memory (20
/// MB per area on the default mesh), and samples come area by area. Returns false if cancelled.
bool BatchEngine::makePredictors(const std::vector<Job>& jobs, const std::stop_token& stop) {
  std::vector<char> touched(predictors_.size(), 0);
  for (const Job& job : jobs)
    for (int area : job.predicted) touched[area] = 1;
  for (std::size_t area = 0; area < predictors_.size(); ++area) {
    if (touched[area]) continue;
    predictors_[area].reset();
    tried_[area] = 0;
  }
  std::vector<int> needed;
  for (const Job& job : jobs)
    for (int area : job.predicted)
      if (!tried_[area]) {
        tried_[area] = 1;
        needed.push_back(area);
      }
  forChunks(static_cast<int>(needed.size()), 1, threads_,
            [&](int i, int) { predictors_[needed[i]] = fitPredictor(needed[i], stop); });
  if (!stop.stop_requested()) return true;
  for (int area : needed) tried_[area] = 0;
  return false;
}

/// Fits a predictor to solves of 32 covering forces from rest; nullopt where one of them does not converge.
std::optional<AreaPredictor> BatchEngine::fitPredictor(int area, const std::stop_token& stop) {
  std::vector<Eigen::Vector3d> forces;
  for (int i = 0; i < batchColumns; ++i) forces.push_back(coveringForce(problem_.design().forceRange, i));
  std::array<int, batchColumns> inColumn{}; // the smallest first, so that a block's forces converge together
  std::iota(inColumn.begin(), inColumn.end(), 0);
  std::stable_sort(inColumn.begin(), inColumn.end(), [&](int a, int b) { return forces[a].norm() < forces[b].norm(); });
  std::unique_ptr<LoadBatch> batch = acquireBatch();
  for (int b = 0; b < LoadBatch::blocks; ++b) batch->reset(b);
  ConvergenceMonitor watch(predictorTolerance_);
  for (int column = 0; column < batchColumns; ++column) {
    batch->addForce(column, {&areaShares_[area], forces[inColumn[column]]});
    watch.begin(column, 1);
  }
  std::array<double, batchColumns> worst{};
  for (int i = 0; watch.anyActive() && !stop.stop_requested(); ++i) {
    batch->iterate(watch.active, watch.change, stop);
    const auto wasActive = watch.active;
    watch.judge();
    for (int column = 0; column < batchColumns; ++column)
      if (i > 0 && wasActive[column]) worst[column] = std::max(worst[column], watch.contraction(column));
  }
  solves_ += batchColumns;
  std::optional<AreaPredictor> predictor;
  const bool converged = std::find(watch.failed.begin(), watch.failed.end(), true) == watch.failed.end();
  if (converged && !stop.stop_requested()) {
    for (int b = 0; b < LoadBatch::blocks; ++b) batch->updateInternal(b);
    predictor = fitted(*batch, forces, inColumn);
    predictor->contraction = *std::max_element(worst.begin(), worst.end());
  }
  releaseBatch(std::move(batch));
  return predictor;
}

/// Coefficients by least squares: for each unknown of the state the row of 32 answers times the fit's matrix.
/// `inColumn` is the number of each column's force.
AreaPredictor BatchEngine::fitted(const LoadBatch& batch, const std::vector<Eigen::Vector3d>& forces,
                                  const std::array<int, batchColumns>& inColumn) const {
  const Eigen::MatrixXd fit = polynomial_.fit(forces);   // points x terms
  LaneVector matrix(std::size_t(batchColumns) * terms_); // [terms / 8][points][8]
  for (int i = 0; i < batchColumns; ++i)
    for (int t = 0; t < polynomial_.terms(); ++t)
      matrix[(t / lanes * batchColumns + i) * lanes + t % lanes] = fit(i, t);
  constexpr int rowsAtOnce = 128; // 32 kB of answers
  LaneVector answers(std::size_t(rowsAtOnce) * batchColumns);
  const auto fitRows = [&](int rows, const auto& value, std::vector<double>& coefficients) {
    coefficients.resize(std::size_t(rows) * terms_);
    for (int first = 0; first < rows; first += rowsAtOnce) {
      const int some = std::min(rowsAtOnce, rows - first);
      for (int row = 0; row < some; ++row)
        for (int column = 0; column < batchColumns; ++column)
          answers[row * batchColumns + inColumn[column]] = value(first + row, column);
      for (int t = 0; t < terms_; t += lanes)
        laneKernels().addPolynomials(answers.data(), batchColumns, matrix.data() + std::size_t(t) * batchColumns, some,
                                     coefficients.data() + std::size_t(first) * terms_ + t, terms_);
    }
  };
  const int own = model_.mesh().unknowns();
  const LaneVector& displacements = batch.displacements();
  AreaPredictor predictor;
  fitRows(
      3 * model_.mesh().nodes(),
      [&](int row, int column) { return displacements[std::size_t(row) * batchColumns + column]; },
      predictor.displacements);
  fitRows(
      own * model_.mesh().elements(), [&](int row, int column) { return batch.unknown(row / own, row % own, column); },
      predictor.unknowns);
  return predictor;
}

/// Fills the queue with the touches, and with blocks of other loads that have the same predictors and about the same
/// work, so that the loads of a block converge together; those with most work first. A predictor's relative error falls
/// with the force; touches take more iterations the larger the strain, which is proportional to the force over the
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
    if (ContactColumns::isTouch(*job.load)) {
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

void BatchEngine::addForces(LoadBatch& batch, int column, const Job& job) const {
  for (const AreaLoad& area : job.areas) batch.addForce(column, {&areaShares_[area.area], area.force_N});
  for (std::size_t p = 0; p < job.patchShares.size(); ++p)
    batch.addForce(column, {&job.patchShares[p], job.load->patches[p].force_N});
}

/// Starts a block: its loads, and as initial guess the superposed predictors of its areas.
void BatchEngine::start(LoadBatch& batch, ConvergenceMonitor& watch, int block, const Block& jobs) const {
  batch.reset(block);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const int column = block * lanes + static_cast<int>(i);
    addForces(batch, column, jobs[i]);
    watch.begin(column, assumedContraction(jobs[i]));
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

/// Contraction of its area's predictor where that is the complete initial guess; 1: unknown.
double BatchEngine::assumedContraction(const Job& job) const {
  const bool predicted =
      job.predicted.size() == 1 && job.areas.size() == 1 && job.patchShares.empty() && job.load->indenters.empty();
  return predicted ? predictors_[job.predicted.front()]->contraction : 1;
}

/// A column to move and a free column to move it to, so that the touches need one block fewer; nullopt: none.
std::optional<std::pair<int, int>> BatchEngine::gapOf(const Touching& touching) {
  std::array<int, LoadBatch::blocks> used{};
  for (int column = 0; column < batchColumns; ++column) used[column / lanes] += touching[column] ? 1 : 0;
  int free = 0, emptiest = -1;
  for (int b = 0; b < LoadBatch::blocks; ++b) {
    if (used[b] == 0) continue;
    free += lanes - used[b];
    if (emptiest < 0 || used[b] < used[emptiest]) emptiest = b;
  }
  if (free < lanes) return {};
  const auto in = [&](int block, bool taken) {
    for (int column = block * lanes; column < (block + 1) * lanes; ++column)
      if (bool(touching[column]) == taken) return column;
    return -1;
  };
  for (int b = 0; b < LoadBatch::blocks; ++b)
    if (b != emptiest && used[b] > 0 && used[b] < lanes) return std::pair{in(emptiest, true), in(b, false)};
  return {};
}

/// Solves the loads of the queue and reports each with its column and answer. A finished block or touch is replaced by
/// the next, so that the columns of the sweeps stay full.
template <class Report>
void BatchEngine::process(Queue& queue, double tolerance, const Report& report, const std::stop_token& stop) {
  std::unique_ptr<LoadBatch> batch = acquireBatch();
  ConvergenceMonitor watch(tolerance);
  ContactColumns touches(top_, problem_);
  const bool inSingle = tolerance >= singleTolerance && model_.rubber().roundsWell();
  std::array<const Block*, LoadBatch::blocks> blocks{};
  Touching touching{}; // loads with indenters, in the other blocks
  while (!stop.stop_requested()) {
    for (int b = 0; b < LoadBatch::blocks; ++b) {
      const auto first = touching.begin() + b * lanes;
      const bool free = !blocks[b] && std::all_of(first, first + lanes, [](const Job* job) { return !job; });
      if (free && (blocks[b] = queue.nextBlock())) start(*batch, watch, b, *blocks[b]);
    }
    for (int column = 0; column < batchColumns; ++column) {
      if (blocks[column / lanes] || touching[column] || !(touching[column] = queue.nextTouch())) continue;
      touches.begin(column, *touching[column]->load, *batch, watch, inSingle);
      addForces(*batch, column, *touching[column]);
    }
    if (!watch.anyActive()) break;
    while (const auto gap = gapOf(touching)) { // the queue is empty
      const auto [from, to] = *gap;
      batch->move(from, to);
      watch.move(from, to);
      touches.move(from, to);
      touching[to] = std::exchange(touching[from], nullptr);
      if (!watch.anyActive(from / lanes)) batch->finish(from / lanes);
    }
    touches.iterate(*batch, watch, stop);
    if (stop.stop_requested()) break; // the iteration may be unfinished
    const std::array<bool, batchColumns> wasActive = watch.active;
    watch.judge();
    touches.continueIncrements(*batch, watch, wasActive);
    for (int b = 0; b < LoadBatch::blocks; ++b) {
      std::vector<std::pair<int, const Job*>> ended;
      for (int column = b * lanes; column < (b + 1) * lanes; ++column)
        if (touching[column] && !watch.active[column])
          ended.emplace_back(column, std::exchange(touching[column], nullptr));
      if (blocks[b] && !watch.anyActive(b)) {
        for (std::size_t i = 0; i < blocks[b]->size(); ++i) ended.emplace_back(b * lanes + int(i), &(*blocks[b])[i]);
        blocks[b] = nullptr;
      }
      if (ended.empty()) continue;
      std::vector<ElectrodeDisplacements> found = batch->electrodes(b);
      for (const auto& [column, job] : ended) {
        report(*job, column, watch.failed[column] ? Answer() : std::move(found[std::size_t(column % lanes)]), *batch);
        touches.end(column);
      }
      if (!watch.anyActive(b)) batch->finish(b);
    }
  }
  releaseBatch(std::move(batch));
}

std::vector<BatchEngine::Answer> BatchEngine::solve(std::span<const LoadCase> loads, double tolerance,
                                                    const std::function<void(std::size_t)>& done,
                                                    const std::stop_token& stop, const BatchSolver::TakeState& state) {
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < loads.size(); ++i)
    if (!ContactColumns::hasFriction(loads[i]) || (loads[i].areas.empty() && loads[i].patches.empty()))
      jobs.push_back(job(loads[i], i)); // the others are solved by full Newton
  const std::size_t unsupported = loads.size() - jobs.size();
  if (!findCompliance(jobs, stop) || !makePredictors(jobs, stop)) return {};
  Queue queue;
  arrange(std::move(jobs), queue);
  std::vector<Answer> answers(loads.size());
  ProgressRelay progress(done);
  if (unsupported > 0) progress.add(unsupported);
  const auto report = [&](const Job& job, int column, Answer found, LoadBatch& batch) {
    const bool withUnknowns = state && problem_.design().pressureLaw;
    if (withUnknowns) batch.updateInternal(column / lanes);
    if (state && found)
      state(job.index, *found,
            {1, batch.displacementsOf(column), withUnknowns ? batch.unknownsOf(column) : Eigen::MatrixXd()});
    answers[job.index] = std::move(found);
    progress.add(1);
  };
  const std::size_t blocks = queue.blocks.size() + (queue.touches.size() + lanes - 1) / lanes;
  const auto batches = static_cast<int>((blocks + LoadBatch::blocks - 1) / LoadBatch::blocks);
  forChunks(std::min(batches, threadCount(threads_)), 1, threads_, [&](int, int) {
    try {
      process(queue, tolerance, report, stop);
    } catch (...) {
      queue.abandon(); // the other threads stop
      throw;
    }
  });
  if (stop.stop_requested()) return {};
  solves_ += loads.size() - unsupported;
  return answers;
}

} // namespace palp
