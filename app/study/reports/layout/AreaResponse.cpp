#include "app/study/reports/layout/AreaResponse.h"

#include "model/DesignError.h"
#include "model/base/Parallel.h"
#include "solver/HyperelasticProblem.h"
#include "solver/PointProbe.h"

namespace palp {

namespace {

/// Steps in half of the central difference's width over the widest force range: the block is so nearly linear there
/// that the error is far below 1e-4, and the solver's tolerance far below it.
constexpr double kStepsOfRange = 120;

/// The widest force range over a force so small that the block is linear under it to 1e-6, and the tolerance at which
/// Newton's method stops after the first iteration, which is the linear answer.
constexpr double kSmallOfRange = 6e4;
constexpr double kLinear = 1e-3;

double widestRange_N(const SensorDesign& design) {
  return (design.forceRange.high_N - design.forceRange.low_N).maxCoeff();
}

LoadIncrement derivative(const LoadIncrement& above, const LoadIncrement& below, double step_N) {
  LoadIncrement result = above;
  result.displacements_mm = (above.displacements_mm - below.displacements_mm) / (2 * step_N);
  result.elementUnknowns = (above.elementUnknowns - below.elementUnknowns) / (2 * step_N);
  return result;
}

/// Index of the probe in the list of all electrodes.
struct Place {
  Eigen::Index first;
  Eigen::Index count;
};

ElectrodeDisplacements read(const SensorDesign& layout, const LoadIncrement& state, const PointProbe& upper,
                            const Place& place, const PointProbe* lower) {
  ElectrodeDisplacements result = ElectrodeDisplacements::atRest(layout);
  result.upper_mm.middleCols(place.first, place.count) = upper.displacements_mm(state);
  if (layout.pressureLaw) result.upperPressure_MPa.segment(place.first, place.count) = upper.pressures_MPa(state);
  if (lower) result.lower_mm = lower->displacements_mm(state);
  return result;
}

/// Reports progress after each solve. The mesh and its factorisation, before the first, take as long as some of them.
class SolveCount {
public:
  SolveCount(const ReportProgress& progress, int solves) : progress_(progress), solves_(solves) { tell("the solves"); }
  void done(int area) {
    ++done_;
    tell("response of area " + std::to_string(area));
  }

private:
  static constexpr int kPreparing = 8;

  void tell(const std::string& what) const {
    if (progress_) progress_(static_cast<double>(kPreparing + done_) / (kPreparing + solves_), what);
  }

  const ReportProgress& progress_;
  int solves_;
  int done_ = 0;
};

} // namespace

std::optional<AreaResponse> AreaResponse::solve(const SensorDesign& design, const MeshOptions& mesh, int threads,
                                                StageLog& stages, const ReportProgress& progress,
                                                std::stop_token stop) {
  if (design.field()) return atRest(design, mesh, threads, stages, progress, std::move(stop));
  AreaResponse response;
  response.mesh_ = stages.measure("mesh", [&] { return sensorMesh(design, mesh, stop); });
  const HyperelasticProblem problem =
      stages.measure("factorise", [&] { return HyperelasticProblem(design, response.mesh_); });
  NewtonOptions newton;
  newton.threads = threads;
  const int areas = design.areas.count();
  SolveCount count{progress, 7 * areas}; // the middle and two steps an axis
  const auto solveFor = [&](int area, const Eigen::Vector3d& force_N) {
    LoadCase load;
    load.areas.push_back({area, force_N});
    Solution solution =
        stages.measure("solve", [&] { return problem.solve(load, newton, {.step = {}, .stop = stop}); });
    count.done(area);
    if (!solution.converged && !solution.cancelled)
      throw DesignError("force_range_N: its middle on area " + std::to_string(area) +
                        " has no solution: " + solution.stopReason);
    return std::move(solution.increments.back());
  };
  const double step_N = widestRange_N(design) / kStepsOfRange;
  const Eigen::Vector3d middle_N = (design.forceRange.low_N + design.forceRange.high_N) / 2;
  for (int area = 0; area < areas; ++area) {
    AreaState state;
    state.middle = solveFor(area, middle_N);
    for (int axis = 0; axis < 3; ++axis) {
      if (stop.stop_requested()) return {};
      const Eigen::Vector3d step = step_N * Eigen::Vector3d::Unit(axis);
      const LoadIncrement above = solveFor(area, middle_N + step);
      state.perNewton[static_cast<std::size_t>(axis)] = derivative(above, solveFor(area, middle_N - step), step_N);
    }
    if (stop.stop_requested()) return {};
    response.areas_.push_back(std::move(state));
  }
  return response;
}

std::optional<AreaResponse> AreaResponse::atRest(const SensorDesign& design, const MeshOptions& mesh, int threads,
                                                 StageLog& stages, const ReportProgress& progress,
                                                 std::stop_token stop) {
  AreaResponse response;
  response.mesh_ = stages.measure("mesh", [&] { return sensorMesh(design, mesh, stop); });
  const HyperelasticProblem problem =
      stages.measure("factorise", [&] { return HyperelasticProblem(design, response.mesh_); });
  NewtonOptions newton;
  newton.threads = threads;
  newton.relativeTolerance = kLinear;
  const double small_N = widestRange_N(design) / kSmallOfRange;
  const int areas = design.areas.count();
  SolveCount count{progress, 3 * areas};
  for (int area = 0; area < areas; ++area) {
    AreaState state;
    for (int axis = 0; axis < 3; ++axis) {
      const LoadCase load{{{area, small_N * Eigen::Vector3d::Unit(axis)}}, {}};
      const Solution solution =
          stages.measure("solve", [&] { return problem.solve(load, newton, {.step = {}, .stop = stop}); });
      if (stop.stop_requested()) return {};
      count.done(area);
      if (!solution.converged) throw DesignError("the block has no linear answer at rest: " + solution.stopReason);
      state.middle = solution.increments.front();
      LoadIncrement& slope = state.perNewton[static_cast<std::size_t>(axis)] = solution.increments.back();
      slope.displacements_mm /= small_N;
      slope.elementUnknowns /= small_N;
    }
    response.areas_.push_back(std::move(state));
  }
  return response;
}

std::vector<std::array<Eigen::Matrix3Xd, 3>>
AreaResponse::perNewtonAt(const Eigen::Ref<const Eigen::Matrix3Xd>& points_mm, int threads) const {
  std::vector<std::array<Eigen::Matrix3Xd, 3>> result(areas_.size());
  for (auto& slopes : result) slopes.fill(Eigen::Matrix3Xd(3, points_mm.cols()));
  constexpr int kChunk = 2500;
  forChunks(static_cast<int>(points_mm.cols()), kChunk, threads, [&](int begin, int end) {
    const PointProbe probe(mesh_, points_mm.middleCols(begin, end - begin));
    for (std::size_t area = 0; area < areas_.size(); ++area)
      for (std::size_t axis = 0; axis < 3; ++axis)
        result[area][axis].middleCols(begin, end - begin) = probe.displacements_mm(areas_[area].perNewton[axis]);
  });
  return result;
}

std::vector<ElectrodeResponse> AreaResponse::read(const SensorDesign& layout, int rowWire) const {
  const Place place = rowWire < 0 ? Place{0, layout.upper.electrodes()}
                                  : Place{static_cast<Eigen::Index>(rowWire) * layout.electrodesPerRowWire(),
                                          layout.electrodesPerRowWire()};
  const PointProbe upper(mesh_, layout.upperElectrodes_mm().middleCols(place.first, place.count));
  std::optional<PointProbe> lower;
  if (layout.lowerFollowsRubber) lower.emplace(mesh_, layout.lowerElectrodes_mm());
  std::vector<ElectrodeResponse> result;
  for (const AreaState& area : areas_) {
    ElectrodeResponse response;
    const PointProbe* const lowerProbe = lower ? &*lower : nullptr;
    response.middle = palp::read(layout, area.middle, upper, place, lowerProbe);
    for (std::size_t axis = 0; axis < 3; ++axis)
      response.perNewton[axis] = palp::read(layout, area.perNewton[axis], upper, place, lowerProbe);
    result.push_back(std::move(response));
  }
  return result;
}

} // namespace palp
