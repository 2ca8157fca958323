#include "app/study/paper/PaperReport.h"

#include "app/study/reports/Csv.h"
#include "app/study/reports/Report.h"
#include "app/study/reports/ReportPage.h"
#include "app/study/reports/ReportText.h"
#include "app/study/reports/networks/NoiseAxis.h"
#include "model/base/Text.h"

namespace palp {

namespace {

using Cells = std::vector<std::string>;

void addForces(Cells& cells, const Eigen::Vector3d& values) {
  for (const double value : values) cells.push_back(shortNumber(value));
}

/// A table of a figure; `addCells` adds the cells after mode and spread.
void addTable(ReportPage& page, const ReportTable& heads, const ProtocolResult& result, const std::string& figure,
              void (*addCells)(Cells&, const ProtocolRow&)) {
  std::vector<Cells> rows;
  for (const ProtocolCurve& curve : result.curves) {
    if (curve.figure != figure) continue;
    for (const ProtocolRow& row : curve.rows) {
      Cells& cells = rows.emplace_back(Cells{curve.mode, row.spread ? text(*row.spread) : "-"});
      addCells(cells, row);
    }
  }
  page.table(heads.heads, rows, heads.caption);
}

/// Eq. (13) as it is: the paper's numbers and ours.
void addComparison(Cells& cells, const ProtocolRow& row) {
  if (row.published_percent)
    addForces(cells, *row.published_percent);
  else
    cells.insert(cells.end(), 3, "");
  addForces(cells, row.eq13Mean_percent());
  addForces(cells, row.eq13Worst_percent());
}

/// The measures that stay finite where a force is near 0.
void addFairMeasures(Cells& cells, const ProtocolRow& row) {
  addForces(cells, row.eq13FlooredMean_percent());
  addForces(cells, row.meanAbsolute_N());
  addForces(cells, row.rmse_percentOfRange());
  cells.push_back(row.condition.empty() ? "-" : shortNumber(row.condition.front()));
}

void addPictures(ReportPage& page, const std::vector<ReportPicture>& all, const std::string& section) {
  for (const ReportPicture& picture : all)
    if (picture.section == section) page.picture(picture.png, picture.caption);
}

/// All of a figure; nothing where the result does not have it.
void addFigure(ReportPage& page, const ReportText& words, const ProtocolResult& result,
               const std::vector<ReportPicture>& all, const std::string& name) {
  ReportTable modes = words.table("modes table");
  for (const ProtocolCurve& curve : result.curves)
    if (curve.figure == name) modes.add({curve.mode, curve.what});
  if (modes.rows.empty()) return;
  page.heading(words(name + " heading"));
  if (name == "fig12") page.paragraph(words("fig12"));
  addTable(page, words.table("comparison table"), result, name, addComparison);
  page.table(modes.heads, modes.rows, modes.caption);
  addTable(page, words.table("fair table"), result, name, addFairMeasures);
  addPictures(page, all, name);
}

} // namespace

std::string protocolCsv(const ProtocolResult& result) {
  Csv csv({"figure", "mode", "spread", "repetition", "area", "force", "published_percent", "eq13_percent",
           "eq13_floored_percent", "mean_absolute_N", "rmse_percent_of_range", "condition"});
  for (const ProtocolCurve& curve : result.curves)
    for (const ProtocolRow& row : curve.rows)
      for (std::size_t seed = 0; seed < row.errors.size(); ++seed)
        for (Eigen::Index area = 0; area < row.errors[seed].eq13_percent.cols(); ++area)
          for (int f = 0; f < 3; ++f) {
            const ProtocolErrors& e = row.errors[seed];
            csv.add({curve.figure, curve.mode, row.spread ? CsvCell(*row.spread) : "", static_cast<int>(seed),
                     static_cast<int>(area), kForceNames[static_cast<std::size_t>(f)],
                     row.published_percent ? CsvCell((*row.published_percent)(f)) : "", e.eq13_percent(f, area),
                     e.eq13Floored_percent(f, area), e.meanAbsolute_N(f, area), e.rmse_percentOfRange(f, area),
                     row.condition[seed]});
          }
  return csv.text();
}

std::string paperReportHtml(const ProtocolResult& result, const std::vector<ReportPicture>& all, const ReportRun& run) {
  const ReportText words("paper"), common("common");
  ReportPage page(words("title"));
  page.paragraph(words("source"));
  page.code(run.command);
  if (!result.curves.empty()) {
    page.paragraph(words("samples", {{"samples", result.samples},
                                     {"repetitions", run.seeds},
                                     {"seed", run.firstSeed},
                                     {"mesh", result.mesh},
                                     {"error", result.batchError}}));
    page.paragraph(words("conventions"));
  }
  if (!all.empty()) {
    page.heading(words("deformation heading"));
    addPictures(page, all, "deformation");
  }
  addFigure(page, words, result, all, "table1");
  addFigure(page, words, result, all, "fig12");
  page.heading(common("left out heading"));
  page.paragraph(words("left out"));
  page.heading("How it was made");
  addTimes(page, result.stages, run.seconds);
  return page.html();
}

} // namespace palp
