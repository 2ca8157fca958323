#include "app/study/reports/errortime/ErrorTimeReport.h"

#include "app/study/reports/Csv.h"
#include "app/study/reports/MeshShare.h"
#include "app/study/reports/ReportPage.h"
#include "app/study/reports/errortime/ChainTimes.h"
#include "app/study/reports/errortime/SolverTimes.h"
#include "app/study/reports/errortime/TouchTimes.h"
#include "model/base/Error.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

std::string spread(const Timing& timing) {
  return shortNumber(timing.median()) + " (" + shortNumber(timing.least()) + " to " + shortNumber(timing.most()) + ")";
}

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Slope of log y against log x by least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a = std::log(x[i]), b = std::log(y[i]);
    sx += a;
    sy += b;
    sxx += a * a;
    sxy += a * b;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Writes the report section by section.
class ErrorTimeWriter {
public:
  ErrorTimeWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : request_(request), progress_(std::move(progress)), stop_(std::move(stop)) {}

  std::optional<ReportContent> run() {
    content_.title = "Error against run time";
    if (!solver()) return {};
    if (!addTouchTimes(request_, quick_, partOf(progress_, 0.35, 0.15), stop_, content_, csv_)) return {};
    decoding();
    if (stop_.stop_requested()) return {};
    use();
    content_.csv = csv_.text();
    return std::move(content_);
  }

private:
  /// A design whose samples have no solution keeps what was found of its solver.
  void decoding() {
    try {
      const auto sets = twoSets(request_.design, request_, content_.stages, partOf(progress_, 0.5, 0.05), stop_);
      if (!sets) return;
      networks(*sets);
      samples();
      chain();
    } catch (const Error& refused) {
      const std::string why = std::string("There are no samples to decode: ") + refused.what();
      content_.parts.push_back(ReportWords{why});
      content_.warnings.push_back(why);
    }
  }

  bool solver() {
    if (quick_) repeats_ = 1;
    const auto found =
        solverTimes(request_.design, quick_, repeats_, request_.threads, partOf(progress_, 0, 0.35), stop_);
    if (!found) return false;
    solver_ = *found;
    content_.parts.push_back(ReportHeading{"Solver: displacement error against wall time"});
    std::string words = "Error: relative L2 of the upper electrodes' displacements against Palp's own answer, "
                        "extrapolated (Richardson) from its three finest meshes of graded tetrahedra (sizes 1.5 apart) "
                        "with the order that they show, taken as 0.5 at least and 4 at most. ";
    for (const JudgedLoad& load : solver_.loads)
      words += "Load '" + load.name + "': " +
               (load.reference_mm.size() == 0
                    ? "no three meshes of neighbouring sizes have an answer, so there is nothing to judge by. "
                    : "order " + shortNumber(load.order) + ", the reference is uncertain by " +
                          shortNumber(100 * load.uncertainty) + " %; errors below that say nothing. ");
    content_.parts.push_back(ReportWords{words + "Wall time: from the mesh to the first answer, median of " +
                                         std::to_string(repeats_) +
                                         " runs (least to most); meshes above 60000 unknowns run once."});
    for (std::size_t l = 0; l < solver_.loads.size(); ++l) solverChart(l);
    solverTable();
    publishedTable();
    if (!solver_.deck.empty()) {
      content_.files.push_back({"calculix-mapped.inp", solver_.deck});
      content_.parts.push_back(ReportWords{
          "CalculiX (ccx) ran in the same session on the same meshes, material and nodal forces, under every load: "
          "its whole process, with as many threads; the first load three times, the others once. Its displacement "
          "elements are compared with the same reference. The deck of the paper's mapped mesh is calculix-mapped.inp; "
          "palp mesh --format inp writes any other."});
    }
    phases();
    return true;
  }

  std::vector<std::string> families() const {
    std::vector<std::string> names;
    for (const MeshTimes& mesh : solver_.meshes)
      if (std::find(names.begin(), names.end(), mesh.family) == names.end()) names.push_back(mesh.family);
    return names;
  }

  void solverChart(std::size_t l) {
    ReportChart chart{.file = "solver_" + std::to_string(l),
                      .caption = "Slopes of log error over log time: ",
                      .title = solver_.loads[l].name,
                      .xLabel = "wall time from nothing [s]",
                      .yLabel = "error of electrode displacements [%]",
                      .logX = true,
                      .logY = true};
    for (const std::string& family : families()) {
      ReportCurve curve{.name = family};
      std::vector<const MeshTimes*> meshes;
      for (const MeshTimes& mesh : solver_.meshes)
        if (mesh.family == family && l < mesh.errors.size() && std::isfinite(mesh.errors[l])) meshes.push_back(&mesh);
      std::sort(meshes.begin(), meshes.end(), [](const auto* a, const auto* b) { return a->dof < b->dof; });
      if (meshes.empty()) continue;
      for (const MeshTimes* mesh : meshes) {
        curve.x.push_back(mesh->total_s());
        curve.y.push_back(100 * mesh->errors[l]);
      }
      chart.caption += (chart.curves.empty() ? "" : "; ") + family + " " + shortNumber(slope(curve.x, curve.y));
      chart.curves.push_back(std::move(curve));
    }
    content_.parts.emplace_back(std::move(chart));
  }

  void solverTable() {
    ReportTable table{"Meshes; errors in the order of the loads above",
                      {"mesh", "elements", "unknowns", "factor [MB]", "process [MB]", "to the first answer [s]",
                       "each further load [s]", "errors [%]"},
                      {},
                      {}};
    for (const MeshTimes& mesh : solver_.meshes) {
      std::string errors;
      for (std::size_t l = 0; l < mesh.errors.size(); ++l) {
        errors += (l > 0 ? " / " : "") + shortNumber(100 * mesh.errors[l]);
        if (!std::isfinite(mesh.errors[l])) continue;
        csv_.add({"solver", mesh.family + ", " + mesh.mesh, solver_.loads[l].name, "electrode displacements",
                  100 * mesh.errors[l], mesh.total_s(), mesh.loadSeconds[l], mesh.dof, mesh.factor_MB,
                  mesh.process_MB});
      }
      table.rows.push_back({mesh.mesh, std::to_string(mesh.elements), std::to_string(mesh.dof),
                            shortNumber(mesh.factor_MB), shortNumber(mesh.process_MB), shortNumber(mesh.total_s()),
                            spread(mesh.solving), mesh.failed.empty() ? errors : "failed: " + mesh.failed});
      table.marks.push_back(mesh.failed.empty() ? ReportTable::Mark::Plain : ReportTable::Mark::Bad);
    }
    content_.parts.emplace_back(std::move(table));
  }

  /// Against another program's converged solutions, where they apply.
  void publishedTable() {
    if (solver_.published.empty()) return;
    ReportTable table{"Row-wire 4 against converged solutions of another program (hexahedra of high order), error [%]",
                      {"mesh", "to the first answer [s]"},
                      {},
                      {}};
    for (const PublishedSolution& published : solver_.published)
      table.heads.push_back("area " + std::to_string(published.area) + ", (" + shortNumber(published.force_N.x()) +
                            ", " + shortNumber(published.force_N.y()) + ", " + shortNumber(published.force_N.z()) +
                            ") N; stated to " + shortNumber(100 * published.statedError) + " %");
    for (const MeshTimes& mesh : solver_.meshes) {
      if (mesh.publishedErrors.empty()) continue;
      std::vector<std::string> cells{mesh.mesh, shortNumber(mesh.total_s())};
      for (std::size_t c = 0; c < mesh.publishedErrors.size(); ++c) {
        cells.push_back(shortNumber(100 * mesh.publishedErrors[c]));
        csv_.add({"published", mesh.family + ", " + mesh.mesh, solver_.published[c].name, "row-wire 4",
                  100 * mesh.publishedErrors[c], mesh.total_s(), "", mesh.dof, mesh.factor_MB, mesh.process_MB});
      }
      table.rows.push_back(std::move(cells));
    }
    content_.parts.emplace_back(std::move(table));
  }

  void phases() {
    ReportTable table{
        "Seconds of each phase, median (least to most) of " + std::to_string(repeats_),
        {"mesh", "meshing", "pattern and ordering", "assembly and factorisation at rest", "nonlinear solve"},
        {},
        {}};
    for (const MeshTimes& mesh : solver_.meshes) {
      if (mesh.pattern.seconds.empty()) continue; // CalculiX does not report its phases
      table.rows.push_back(
          {mesh.mesh, spread(mesh.meshing), spread(mesh.pattern), spread(mesh.factorisation), spread(mesh.solving)});
      for (const auto& [phase, timing] :
           {std::pair{"meshing", &mesh.meshing}, std::pair{"pattern", &mesh.pattern},
            std::pair{"factorisation", &mesh.factorisation}, std::pair{"solving", &mesh.solving}})
        for (const double seconds : timing->seconds)
          csv_.add({"phase", mesh.family + ", " + mesh.mesh, phase, "", "", seconds, "", mesh.dof, mesh.factor_MB,
                    mesh.process_MB});
    }
    content_.parts.emplace_back(std::move(table));
  }

  void networks(const TwoSets& sets) {
    content_.parts.push_back(ReportHeading{"Decoders: force error against training and prediction time"});
    content_.parts.push_back(ReportWords{std::to_string(sets.training.size()) +
                                         " training samples, as many for testing; from clean displacements of the "
                                         "centre row-wire, and from all resistances with relative noise 1e-4, area "
                                         "unknown. Times: median (least to most) "
                                         "of 3 runs; what trains longer than 4 s runs once."});
    decoders_ = decoderTimes(request_, sets, content_.stages, partOf(progress_, 0.55, 0.2), stop_);
    decoderTable();
    leaveOneOut(sets);
    decoderChart({.file = "training",
                  .caption = "Error against training time; decoders by name in the table",
                  .title = "Training",
                  .xLabel = "training [s]"},
                 [](const DecoderTimes& d) { return d.training.median(); });
    decoderChart({.file = "prediction",
                  .caption = "Error against prediction time",
                  .title = "Prediction",
                  .xLabel = "prediction [us a sample]"},
                 [](const DecoderTimes& d) { return d.prediction.median(); });
  }

  void decoderTable() {
    ReportTable table{.caption = "Error: root mean square of the three forces in % of range",
                      .heads = {"decoder", "input", "error [%]", "training [s]", "prediction [us a sample]"}};
    for (const DecoderTimes& d : decoders_) {
      table.rows.push_back({d.what, d.input,
                            d.failed.empty() ? shortNumber(d.error_percentOfRange) : "failed: " + d.failed,
                            spread(d.training), spread(d.prediction)});
      table.marks.push_back(d.failed.empty() ? ReportTable::Mark::Plain : ReportTable::Mark::Bad);
      if (!d.failed.empty()) continue;
      for (std::size_t i = 0; i < d.training.seconds.size(); ++i)
        csv_.add({"decoder", d.what, d.input, "force [% of range]", d.error_percentOfRange, d.training.seconds[i],
                  d.prediction.seconds[i] * 1e-6, "", "", ""});
    }
    content_.parts.emplace_back(std::move(table));
  }

  void leaveOneOut(const TwoSets& sets) {
    const Timing leaving = leaveOneOutTimes(request_, sets, stop_);
    content_.parts.emplace_back(ReportWords{"Leave-one-out errors of " + std::to_string(kLeaveOneOutSpreads) +
                                            " spreads at once, " + std::to_string(sets.training.size()) +
                                            " samples as centres: " + spread(leaving) + " s."});
    for (const double seconds : leaving.seconds)
      csv_.add({"leave-one-out", std::to_string(kLeaveOneOutSpreads) + " spreads", std::to_string(sets.training.size()),
                "", "", seconds, seconds / kLeaveOneOutSpreads, "", "", ""});
  }

  /// Error of the decoders against one of their times, a cloud an input.
  void decoderChart(ReportChart chart, double (*time)(const DecoderTimes&)) {
    chart.yLabel = "error [% of range]";
    chart.logX = chart.logY = true;
    for (const DecoderTimes& d : decoders_) {
      if (!d.failed.empty()) continue;
      if (chart.curves.empty() || chart.curves.back().name != d.input)
        chart.curves.push_back({.name = d.input, .style = ReportCurve::Style::Points});
      chart.curves.back().x.push_back(time(d));
      chart.curves.back().y.push_back(d.error_percentOfRange);
    }
    content_.parts.emplace_back(std::move(chart));
  }

  void samples() {
    content_.parts.push_back(ReportHeading{"Samples: full solves and surrogates"});
    ReportTable table{"With mesh and factorisation; error of the electrode displacements, measured by the solver "
                      "against full Newton on a share of the loads",
                      {"way", "samples", "seconds", "samples a second", "relative error"},
                      {},
                      {}};
    for (const SampleTimes& s : sampleTimes(request_, content_.stages, partOf(progress_, 0.75, 0.1), stop_)) {
      table.rows.push_back({s.what, std::to_string(s.samples), shortNumber(s.seconds),
                            shortNumber(s.samples / s.seconds), shortNumber(s.error)});
      csv_.add({"samples", s.what, std::to_string(s.samples), "electrode displacements, relative", s.error, s.seconds,
                s.seconds / s.samples, "", "", ""});
    }
    content_.parts.emplace_back(std::move(table));
  }

  void chain() {
    content_.parts.push_back(ReportHeading{"The whole chain: force error against time from nothing"});
    content_.parts.push_back(ReportWords{"Samples are made on a mesh, a network (mode default, all resistances, noise "
                                         "1e-4) is trained on them and tested "
                                         "at the same noise on samples of a finer mesh of tetrahedra (size " +
                                         shortNumber(kReferenceSize_mm * meshShare(request_.design)) +
                                         " mm): a "
                                         "coarse mesh's error becomes a force error, whatever the network."});
    chains_ = chainTimes(request_, content_.stages, partOf(progress_, 0.85, 0.15), stop_);
    ReportTable table{"What each stage costs",
                      {"mesh", "samples an area", "mesh, factorisation [s]", "samples [s]", "training [s]", "whole [s]",
                       "force error [% of range]"},
                      {},
                      {}};
    ReportChart chart{.file = "chain",
                      .caption = "From nothing to a trained network",
                      .title = "Whole chain",
                      .xLabel = "seconds from nothing",
                      .yLabel = "force error [% of range]",
                      .logX = true,
                      .logY = true};
    for (const ChainTimes& c : chains_) {
      table.rows.push_back({c.mesh, std::to_string(c.perArea), shortNumber(c.prepare_s), shortNumber(c.sample_s),
                            shortNumber(c.train_s), shortNumber(c.total_s()),
                            c.failed.empty() ? shortNumber(c.error_percentOfRange) : "failed: " + c.failed});
      table.marks.push_back(c.failed.empty() ? ReportTable::Mark::Plain : ReportTable::Mark::Bad);
      if (!c.failed.empty()) continue;
      csv_.add({"chain", c.mesh, std::to_string(c.perArea), "force [% of range]", c.error_percentOfRange, c.total_s(),
                c.sample_s, "", "", ""});
      if (chart.curves.empty() || chart.curves.back().name != c.mesh) chart.curves.push_back({.name = c.mesh});
      chart.curves.back().x.push_back(c.total_s());
      chart.curves.back().y.push_back(c.error_percentOfRange);
    }
    content_.parts.emplace_back(std::move(table));
    content_.parts.emplace_back(std::move(chart));
  }

  /// The fastest that reaches an error, for several errors.
  void use() {
    content_.parts.push_back(ReportHeading{"For this error use this"});
    ReportTable table{
        "The fastest of what was measured above; the solver's error is the root mean square over the loads",
        {"error wanted", "mesh", "seconds to the first answer", "chain to the force", "seconds from nothing"},
        {},
        {}};
    for (const double percent : {10.0, 5.0, 2.0, 1.0, 0.5, 0.1}) {
      const MeshTimes* mesh = nullptr;
      for (const MeshTimes& m : solver_.meshes)
        if (m.failed.empty() && m.errors.size() == solver_.loads.size() && 100 * rms(m.errors) <= percent &&
            (!mesh || m.total_s() < mesh->total_s()))
          mesh = &m;
      const ChainTimes* way = nullptr;
      for (const ChainTimes& c : chains_)
        if (c.failed.empty() && c.error_percentOfRange <= percent && (!way || c.total_s() < way->total_s())) way = &c;
      table.rows.push_back({shortNumber(percent) + " %", mesh ? mesh->mesh : "none measured",
                            mesh ? shortNumber(mesh->total_s()) : "-",
                            way ? way->mesh + ", " + std::to_string(way->perArea) + " an area" : "none measured",
                            way ? shortNumber(way->total_s()) : "-"});
      if (percent == 1.0 && mesh)
        content_.summary += "For 1 % in the electrode displacements: " + mesh->mesh + ", " +
                            shortNumber(mesh->total_s()) + " s from nothing (error " +
                            shortNumber(100 * rms(mesh->errors)) + " %). ";
      if (percent == 1.0 && way)
        content_.summary += "For 1 % of range in the force: " + way->mesh + " with " + std::to_string(way->perArea) +
                            " samples an area, " + shortNumber(way->total_s()) + " s from nothing.";
    }
    content_.parts.emplace_back(std::move(table));
    if (content_.summary.empty()) content_.summary = "Nothing measured here reaches 1 %.";
  }

  const ReportRequest& request_;
  ReportProgress progress_;
  std::stop_token stop_;
  ReportContent content_;
  bool quick_ = request_.mesh.mapped.has_value();
  int repeats_ = 3;
  Csv csv_{{"what", "way", "case", "error_of", "error_percent", "seconds", "seconds_each", "dof", "factor_MB",
            "process_MB"}};
  SolverTimes solver_;
  std::vector<DecoderTimes> decoders_;
  std::vector<ChainTimes> chains_;
};

} // namespace

std::optional<ReportContent> errorTimeReport(const ReportRequest& request, const ReportProgress& progress,
                                             std::stop_token stop) {
  requireValid(request.design);
  return ErrorTimeWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
