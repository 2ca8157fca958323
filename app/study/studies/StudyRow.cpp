#include "app/study/studies/StudyRow.h"

#include "app/study/reports/Csv.h"
#include "app/study/reports/layout/DesignBounds.h"
#include "app/study/reports/layout/FieldResponse.h"
#include "app/study/reports/networks/NetworkCheck.h"
#include "app/study/reports/networks/NoiseAxis.h"
#include "app/study/touch/Touch.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "solver/DiscretisationError.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <set>

namespace palp {

namespace {

/// Works out the quantities of one design, one after the other.
class RowWork {
public:
  RowWork(const StudyPlan& plan, SensorDesign design, int areas, int threads, ReportProgress progress,
          std::stop_token stop)
      : plan_(plan), design_(std::move(design)), areas_(areas), threads_(threads), progress_(std::move(progress)),
        stop_(std::move(stop)) {
    mesh_.meshSize_mm = plan.meshSize_mm;
    mesh_.mapped = plan.mapped;
  }

  /// Throws Cancelled where it was stopped.
  StudyRow run() {
    if (plan_.computes(StudyQuantity::Bound)) bounds();
    if (plan_.computes(StudyQuantity::Decoders)) decoders();
    if (plan_.computes(StudyQuantity::Displacement) || plan_.computes(StudyQuantity::Error)) largestLoad();
    return std::move(row_);
  }

private:
  void bounds() {
    if (design_.field() != nullptr) requireSmoothAtRest(design_);
    const auto found = designBounds(design_, mesh_, plan_.noise, threads_, progress_, stop_);
    if (!found) throw Cancelled();
    const LayoutBound& bound = found->allRows;
    for (const double percent : bound.withoutPrior()) row_.values.emplace_back(percent);
    row_.values.emplace_back(bound.mean());
    for (Eigen::Index area = 0; area < areas_; ++area) {
      if (area < bound.withoutPrior_percent.cols())
        row_.values.emplace_back(std::cbrt(bound.withoutPrior_percent.col(area).prod()));
      else
        row_.values.emplace_back();
    }
  }

  void decoders() {
    ReportRequest request;
    request.design = design_;
    request.mesh = mesh_;
    request.perArea = plan_.perArea;
    request.seed = plan_.seed;
    request.threads = threads_;
    StageLog stages;
    const auto sets = twoSets(design_, request, stages, progress_, stop_);
    if (!sets) throw Cancelled();
    for (const DecoderKind kind : plan_.decoders) {
      TrainOptions options;
      options.input = InputKind::Resistance;
      options.rows = "all";
      options.decoder = kind;
      options.noise = plan_.noise;
      options.seed = plan_.seed;
      options.threads = threads_;
      const NoisyError error = noisyError(design_, *sets, options, plan_.noise, plan_.seed, stages, stop_);
      if (!error.failed.empty()) throw Error(kDecoderKinds.name(kind) + ": " + error.failed);
      for (const double percent : error.rmse_percentOfRange) row_.values.emplace_back(percent);
      row_.values.emplace_back(rootMeanSquare(error.rmse_percentOfRange));
    }
  }

  void largestLoad() {
    const Eigen::Vector3d force_N(design_.forceRange.high_N.x(), design_.forceRange.high_N.y(),
                                  design_.forceRange.low_N.z());
    NewtonOptions newton;
    newton.threads = threads_;
    Touch touch(design_, {{{0, force_N}}, {}, {}}, mesh_);
    const bool solved = touch.advance(Stage::Solution, newton, {{}, stop_});
    if (stop_.stop_requested()) throw Cancelled();
    if (!solved) throw Error("the largest load on area 0 has no solution: " + touch.solution()->stopReason);
    if (plan_.computes(StudyQuantity::Displacement))
      row_.values.emplace_back(touch.solution()->state().displacements_mm.colwise().norm().maxCoeff());
    if (!plan_.computes(StudyQuantity::Error)) return;
    const DiscretisationError error =
        discretisationError(*touch.problem(), touch.load(), *touch.solution(), stop_, threads_);
    if (error.relative)
      row_.values.emplace_back(100 * *error.relative);
    else
      row_.values.emplace_back();
  }

  const StudyPlan& plan_;
  SensorDesign design_;
  int areas_, threads_;
  ReportProgress progress_;
  std::stop_token stop_;
  MeshOptions mesh_;
  StudyRow row_;
};

} // namespace

int studyAreas(const StudyPlan& plan) {
  std::vector<std::size_t> ofAreas;
  for (std::size_t a = 0; a < plan.axes.size(); ++a)
    if (plan.axes[a].key.starts_with("areas.")) ofAreas.push_back(a);
  int most = 1;
  std::set<std::vector<std::string>> known; // most designs have the areas of one before
  for (std::size_t i = 0; i < (ofAreas.empty() ? 1 : plan.designs()); ++i) {
    const std::vector<std::string> all = plan.values(i);
    std::vector<std::string> chosen;
    for (const std::size_t a : ofAreas) chosen.push_back(all[a]);
    if (known.contains(chosen)) continue;
    try {
      most = std::max(most, plan.at(i).areas.count());
      known.insert(std::move(chosen));
    } catch (const Error&) {
      continue;
    }
  }
  return most;
}

std::vector<std::string> studyColumns(const StudyPlan& plan, int areas) {
  std::vector<std::string> columns{"design"};
  for (const StudyAxis& axis : plan.axes) columns.push_back(axis.key);
  columns.emplace_back("problem");
  const auto forces = [&columns](const std::string& before, const char* all) {
    for (const char* force : {"fx", "fy", "fz", all}) columns.push_back(before + force + "_percent");
  };
  if (plan.computes(StudyQuantity::Bound)) {
    forces("bound_", "mean");
    for (int area = 0; area < areas; ++area) columns.push_back("bound_area" + std::to_string(area) + "_percent");
  }
  if (plan.computes(StudyQuantity::Decoders))
    for (const DecoderKind kind : plan.decoders) forces(kDecoderKinds.name(kind) + "_", "rms");
  if (plan.computes(StudyQuantity::Displacement)) columns.emplace_back("largest_displacement_mm");
  if (plan.computes(StudyQuantity::Error)) columns.emplace_back("mesh_error_percent");
  return columns;
}

std::optional<StudyRow> studyRow(const StudyPlan& plan, std::size_t design, int areas, int threads,
                                 const ReportProgress& progress, const std::stop_token& stop) {
  try {
    SensorDesign chosen = plan.at(design);
    requireValid(chosen);
    return RowWork(plan, std::move(chosen), areas, threads, progress, stop).run();
  } catch (const Cancelled&) {
    return {};
  } catch (const Error& problem) { // a design without a result is a row with the reason
    return StudyRow{problem.what()};
  } catch (const std::bad_alloc&) {
    return StudyRow{"not enough memory for this design; use a coarser mesh or another machine"};
  }
}

std::string studyLine(const StudyPlan& plan, const std::vector<std::string>& columns, std::size_t design,
                      const StudyRow& row) {
  std::vector<CsvCell> cells{static_cast<int>(design)};
  for (const std::string& value : plan.values(design)) cells.emplace_back(value);
  cells.emplace_back(row.problem);
  for (const std::optional<double>& value : row.values) cells.push_back(value ? CsvCell(*value) : CsvCell(""));
  while (cells.size() < columns.size()) cells.emplace_back("");
  Csv csv(columns);
  csv.add(cells);
  return csv.text().substr(Csv(columns).text().size());
}

} // namespace palp
