#include "app/study/reports/errortime/ErrorTimeReport.h"

#include "app/study/reports/Csv.h"
#include "app/study/reports/MeshShare.h"
#include "app/study/reports/ReportPage.h"
#include "app/study/reports/ReportText.h"
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
    content_.title = words_("title");
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
    content_.parts.push_back(ReportHeading{words_("solver heading")});
    std::string words = words_("reference");
    for (const JudgedLoad& load : solver_.loads)
      words += " " + (load.reference_mm.size() == 0
                          ? words_("load without reference", {{"load", load.name}})
                          : words_("load", {{"load", load.name},
                                            {"order", shortNumber(load.order)},
                                            {"uncertainty", shortNumber(100 * load.uncertainty)}}));
    content_.parts.push_back(ReportWords{words + " " + words_("times", {{"repeats", std::to_string(repeats_)}})});
    for (std::size_t l = 0; l < solver_.loads.size(); ++l) solverChart(l);
    solverTable();
    publishedTable();
    if (!solver_.deck.empty()) {
      content_.files.push_back({"calculix-mapped.inp", solver_.deck});
      content_.parts.push_back(ReportWords{words_("calculix")});
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
                      .caption = words_("slopes"),
                      .title = solver_.loads[l].name,
                      .xLabel = "wall time from scratch [s]",
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
      chart.caption += (chart.curves.empty() ? " " : "; ") + family + " " + shortNumber(slope(curve.x, curve.y));
      chart.curves.push_back(std::move(curve));
    }
    content_.parts.emplace_back(std::move(chart));
  }

  void solverTable() {
    ReportTable table{words_("meshes caption"),
                      {"mesh", "elements", "unknowns", "factor [MB]", "process [MB]", "to the first solution [s]",
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
    ReportTable table{words_("published caption"), {"mesh", "to the first solution [s]"}, {}, {}};
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
        words_("phases caption", {{"repeats", std::to_string(repeats_)}}),
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
    content_.parts.push_back(ReportHeading{words_("decoders heading")});
    content_.parts.push_back(ReportWords{words_("decoders", {{"samples", std::to_string(sets.training.size())}})});
    decoders_ = decoderTimes(request_, sets, content_.stages, partOf(progress_, 0.55, 0.2), stop_);
    decoderTable();
    leaveOneOut(sets);
    decoderChart(
        {.file = "training", .caption = words_("training caption"), .title = "Training", .xLabel = "training [s]"},
        [](const DecoderTimes& d) { return d.training.median(); });
    decoderChart({.file = "prediction",
                  .caption = words_("prediction caption"),
                  .title = "Prediction",
                  .xLabel = "prediction [us per sample]"},
                 [](const DecoderTimes& d) { return d.prediction.median(); });
  }

  void decoderTable() {
    ReportTable table{.caption = words_("decoder caption"),
                      .heads = {"decoder", "input", "error [%]", "training [s]", "prediction [us per sample]"}};
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
    content_.parts.emplace_back(ReportWords{words_("leave-one-out", {{"spreads", std::to_string(kLeaveOneOutSpreads)},
                                                                     {"samples", std::to_string(sets.training.size())},
                                                                     {"seconds", spread(leaving)}})});
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
    content_.parts.push_back(ReportHeading{words_("samples heading")});
    ReportTable table{
        words_("samples caption"), {"method", "samples", "seconds", "samples per second", "relative error"}, {}, {}};
    for (const SampleTimes& s : sampleTimes(request_, content_.stages, partOf(progress_, 0.75, 0.1), stop_)) {
      table.rows.push_back({s.what, std::to_string(s.samples), shortNumber(s.seconds),
                            shortNumber(s.samples / s.seconds), shortNumber(s.error)});
      csv_.add({"samples", s.what, std::to_string(s.samples), "electrode displacements, relative", s.error, s.seconds,
                s.seconds / s.samples, "", "", ""});
    }
    content_.parts.emplace_back(std::move(table));
  }

  void chain() {
    content_.parts.push_back(ReportHeading{words_("chain heading")});
    content_.parts.push_back(
        ReportWords{words_("chain", {{"size", shortNumber(kReferenceSize_mm * meshShare(request_.design))}})});
    chains_ = chainTimes(request_, content_.stages, partOf(progress_, 0.85, 0.15), stop_);
    ReportTable table{words_("chain caption"),
                      {"mesh", "samples per area", "mesh, factorisation [s]", "samples [s]", "training [s]",
                       "total [s]", "force error [% of range]"},
                      {},
                      {}};
    ReportChart chart{.file = "chain",
                      .caption = words_("chain chart"),
                      .title = "Complete chain",
                      .xLabel = "seconds from scratch",
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
    content_.parts.push_back(ReportHeading{words_("use heading")});
    ReportTable table{
        words_("use caption"),
        {"largest error", "mesh", "seconds to the first solution", "chain to the force", "seconds from scratch"},
        {},
        {}};
    for (const double percent : {10.0, 5.0, 2.0, 1.0, 0.5, 0.1}) {
      const MeshTimes* mesh = nullptr;
      for (const MeshTimes& m : solver_.meshes)
        if (m.failed.empty() && m.errors.size() == solver_.loads.size() && 100 * rms(m.errors) <= percent &&
            (!mesh || m.total_s() < mesh->total_s()))
          mesh = &m;
      const ChainTimes* fastest = nullptr;
      for (const ChainTimes& c : chains_)
        if (c.failed.empty() && c.error_percentOfRange <= percent && (!fastest || c.total_s() < fastest->total_s()))
          fastest = &c;
      table.rows.push_back(
          {shortNumber(percent) + " %", mesh ? mesh->mesh : "none measured", mesh ? shortNumber(mesh->total_s()) : "-",
           fastest ? fastest->mesh + ", " + std::to_string(fastest->perArea) + " per area" : "none measured",
           fastest ? shortNumber(fastest->total_s()) : "-"});
      if (percent == 1.0 && mesh)
        content_.summary += words_("displacement summary", {{"mesh", mesh->mesh},
                                                            {"seconds", shortNumber(mesh->total_s())},
                                                            {"error", shortNumber(100 * rms(mesh->errors))}}) +
                            " ";
      if (percent == 1.0 && fastest)
        content_.summary += words_("force summary", {{"mesh", fastest->mesh},
                                                     {"samples", std::to_string(fastest->perArea)},
                                                     {"seconds", shortNumber(fastest->total_s())}});
    }
    content_.parts.emplace_back(std::move(table));
    if (content_.summary.empty()) content_.summary = words_("no summary");
  }

  const ReportText words_{"error-time"};
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
