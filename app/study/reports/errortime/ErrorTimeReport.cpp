#include "app/study/reports/errortime/ErrorTimeReport.h"

#include "app/study/reports/MeshShare.h"
#include "app/study/reports/ReportWriter.h"
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
class ErrorTimeWriter : ReportWriter {
public:
  ErrorTimeWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : ReportWriter(request, std::move(progress), std::move(stop), "error-time",
                     {"what", "way", "case", "error_of", "error_percent", "seconds", "seconds_each", "dof", "factor_MB",
                      "process_MB"}) {}

  std::optional<ReportContent> run() {
    if (!solver()) return {};
    if (!addTouchTimes(request_, quick_, partOf(progress_, 0.35, 0.15), stop_, content_, csv_)) return {};
    decoding();
    if (stop_.stop_requested()) return {};
    use();
    return finished();
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
      content_.warnings.push_back(words_("no samples", {{"why", refused.what()}}));
      add(ReportWords{content_.warnings.back()});
    }
  }

  bool solver() {
    if (quick_) repeats_ = 1;
    const auto found =
        solverTimes(request_.design, quick_, repeats_, request_.threads, partOf(progress_, 0, 0.35), stop_);
    if (!found) return false;
    solver_ = *found;
    heading("solver heading");
    std::string words = words_("reference");
    for (const JudgedLoad& load : solver_.loads)
      words +=
          " " +
          (load.reference_mm.size() == 0
               ? words_("load without reference", {{"load", load.name}})
               : words_("load", {{"load", load.name}, {"order", load.order}, {"uncertainty", 100 * load.uncertainty}}));
    add(ReportWords{words + " " + words_("times", {{"repeats", repeats_}})});
    for (std::size_t l = 0; l < solver_.loads.size(); ++l) solverChart(l);
    solverTable();
    publishedTable();
    if (!solver_.deck.empty()) {
      content_.files.push_back({"calculix-mapped.inp", solver_.deck});
      paragraph("calculix");
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
    ReportChart chart = words_.chart("solver_" + std::to_string(l), "solver chart", {{"load", solver_.loads[l].name}});
    chart.logX = chart.logY = true;
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
    add(std::move(chart));
  }

  void solverTable() {
    ReportTable table = words_.table("meshes table");
    for (const MeshTimes& mesh : solver_.meshes) {
      std::string errors;
      for (std::size_t l = 0; l < mesh.errors.size(); ++l) {
        errors += (l > 0 ? " / " : "") + shortNumber(100 * mesh.errors[l]);
        if (!std::isfinite(mesh.errors[l])) continue;
        csv_.add({"solver", mesh.family + ", " + mesh.mesh, solver_.loads[l].name, "electrode displacements",
                  100 * mesh.errors[l], mesh.total_s(), mesh.loadSeconds[l], mesh.dof, mesh.factor_MB,
                  mesh.process_MB});
      }
      table.add({mesh.mesh, mesh.elements, mesh.dof, mesh.factor_MB, mesh.process_MB, mesh.total_s(),
                 spread(mesh.solving), mesh.failed.empty() ? errors : "failed: " + mesh.failed},
                mesh.failed.empty() ? ReportTable::Mark::Plain : ReportTable::Mark::Bad);
    }
    add(std::move(table));
  }

  /// Against another program's converged solutions, where they apply.
  void publishedTable() {
    if (solver_.published.empty()) return;
    ReportTable table = words_.table("published table");
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
    add(std::move(table));
  }

  void phases() {
    ReportTable table = words_.table("phases table", {{"repeats", repeats_}});
    for (const MeshTimes& mesh : solver_.meshes) {
      if (mesh.pattern.seconds.empty()) continue; // CalculiX does not report its phases
      table.add(
          {mesh.mesh, spread(mesh.meshing), spread(mesh.pattern), spread(mesh.factorisation), spread(mesh.solving)});
      for (const auto& [phase, timing] :
           {std::pair{"meshing", &mesh.meshing}, std::pair{"pattern", &mesh.pattern},
            std::pair{"factorisation", &mesh.factorisation}, std::pair{"solving", &mesh.solving}})
        for (const double seconds : timing->seconds)
          csv_.add({"phase", mesh.family + ", " + mesh.mesh, phase, "", "", seconds, "", mesh.dof, mesh.factor_MB,
                    mesh.process_MB});
    }
    add(std::move(table));
  }

  void networks(const TwoSets& sets) {
    heading("decoders heading");
    paragraph("decoders", {{"samples", sets.training.size()}});
    decoders_ = decoderTimes(request_, sets, content_.stages, partOf(progress_, 0.55, 0.2), stop_);
    decoderTable();
    leaveOneOut(sets);
    decoderChart("training", [](const DecoderTimes& d) { return d.training.median(); });
    decoderChart("prediction", [](const DecoderTimes& d) { return d.prediction.median(); });
  }

  void decoderTable() {
    ReportTable table = words_.table("decoder table");
    for (const DecoderTimes& d : decoders_) {
      table.add({d.what, d.input, d.failed.empty() ? shortNumber(d.error_percentOfRange) : "failed: " + d.failed,
                 spread(d.training), spread(d.prediction)},
                d.failed.empty() ? ReportTable::Mark::Plain : ReportTable::Mark::Bad);
      if (!d.failed.empty()) continue;
      for (std::size_t i = 0; i < d.training.seconds.size(); ++i)
        csv_.add({"decoder", d.what, d.input, "force [% of range]", d.error_percentOfRange, d.training.seconds[i],
                  d.prediction.seconds[i] * 1e-6, "", "", ""});
    }
    add(std::move(table));
  }

  void leaveOneOut(const TwoSets& sets) {
    const Timing leaving = leaveOneOutTimes(request_, sets, stop_);
    paragraph("leave-one-out",
              {{"spreads", kLeaveOneOutSpreads}, {"samples", sets.training.size()}, {"seconds", spread(leaving)}});
    for (const double seconds : leaving.seconds)
      csv_.add({"leave-one-out", std::to_string(kLeaveOneOutSpreads) + " spreads", std::to_string(sets.training.size()),
                "", "", seconds, seconds / kLeaveOneOutSpreads, "", "", ""});
  }

  /// Error of the decoders against one of their times, a cloud an input.
  void decoderChart(const std::string& time, double (*secondsOfIt)(const DecoderTimes&)) {
    ReportChart chart = words_.chart(time, time + " chart");
    chart.logX = chart.logY = true;
    for (const DecoderTimes& d : decoders_) {
      if (!d.failed.empty()) continue;
      if (chart.curves.empty() || chart.curves.back().name != d.input)
        chart.curves.push_back({.name = d.input, .style = ReportCurve::Style::Points});
      chart.curves.back().x.push_back(secondsOfIt(d));
      chart.curves.back().y.push_back(d.error_percentOfRange);
    }
    add(std::move(chart));
  }

  void samples() {
    heading("samples heading");
    ReportTable table = words_.table("samples table");
    for (const SampleTimes& s : sampleTimes(request_, content_.stages, partOf(progress_, 0.75, 0.1), stop_)) {
      table.add({s.what, s.samples, s.seconds, s.samples / s.seconds, s.error});
      csv_.add({"samples", s.what, std::to_string(s.samples), "electrode displacements, relative", s.error, s.seconds,
                s.seconds / s.samples, "", "", ""});
    }
    add(std::move(table));
  }

  void chain() {
    heading("chain heading");
    paragraph("chain", {{"size", kReferenceSize_mm * meshShare(request_.design)}});
    chains_ = chainTimes(request_, content_.stages, partOf(progress_, 0.85, 0.15), stop_);
    ReportTable table = words_.table("chain table");
    ReportChart chart = words_.chart("chain", "chain chart");
    chart.logX = chart.logY = true;
    for (const ChainTimes& c : chains_) {
      table.add({c.mesh, c.perArea, c.prepare_s, c.sample_s, c.train_s, c.total_s(),
                 c.failed.empty() ? shortNumber(c.error_percentOfRange) : "failed: " + c.failed},
                c.failed.empty() ? ReportTable::Mark::Plain : ReportTable::Mark::Bad);
      if (!c.failed.empty()) continue;
      csv_.add({"chain", c.mesh, std::to_string(c.perArea), "force [% of range]", c.error_percentOfRange, c.total_s(),
                c.sample_s, "", "", ""});
      if (chart.curves.empty() || chart.curves.back().name != c.mesh) chart.curves.push_back({.name = c.mesh});
      chart.curves.back().x.push_back(c.total_s());
      chart.curves.back().y.push_back(c.error_percentOfRange);
    }
    add(std::move(table));
    add(std::move(chart));
  }

  /// The fastest that reaches an error, for several errors.
  void use() {
    heading("use heading");
    ReportTable table = words_.table("use table");
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
      table.add({shortNumber(percent) + " %", mesh ? mesh->mesh : "none measured",
                 mesh ? shortNumber(mesh->total_s()) : "-",
                 fastest ? fastest->mesh + ", " + std::to_string(fastest->perArea) + " per area" : "none measured",
                 fastest ? shortNumber(fastest->total_s()) : "-"});
      if (percent == 1.0 && mesh)
        content_.summary +=
            words_("displacement summary",
                   {{"mesh", mesh->mesh}, {"seconds", mesh->total_s()}, {"error", 100 * rms(mesh->errors)}}) +
            " ";
      if (percent == 1.0 && fastest)
        content_.summary += words_(
            "force summary", {{"mesh", fastest->mesh}, {"samples", fastest->perArea}, {"seconds", fastest->total_s()}});
    }
    add(std::move(table));
    if (content_.summary.empty()) content_.summary = words_("no summary");
  }

  bool quick_ = request_.mesh.mapped.has_value();
  int repeats_ = 3;
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
