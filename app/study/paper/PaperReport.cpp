#include "app/study/paper/PaperReport.h"

#include "app/study/reports/ReportPage.h"
#include "model/base/Text.h"

#include <fstream>
#include <sys/utsname.h>
#include <thread>

namespace palp {

namespace {

constexpr const char* kForces[3] = {"Fx", "Fy", "Fz"};

using Cells = std::vector<std::string>;

void addForces(Cells& cells, const Eigen::Vector3d& values) {
  for (const double value : values) cells.push_back(shortNumber(value));
}

void addHeads(Cells& heads, const std::string& what) {
  for (const char* force : kForces) heads.push_back(what + " " + force);
}

std::string spreadText(const ProtocolRow& row) {
  return row.spread ? text(*row.spread) : "-";
}

/// Eq. (13) as it is: the paper beside each of our ways.
void comparison(ReportPage& page, const ProtocolResult& result, const std::string& figure) {
  Cells heads{"way", "spread"};
  addHeads(heads, "paper");
  addHeads(heads, "mean");
  addHeads(heads, "worst area");
  std::vector<Cells> rows;
  for (const ProtocolCurve& curve : result.curves) {
    if (curve.figure != figure) continue;
    for (const ProtocolRow& row : curve.rows) {
      Cells cells{curve.mode, spreadText(row)};
      if (row.published_percent)
        addForces(cells, *row.published_percent);
      else
        cells.insert(cells.end(), 3, "");
      addForces(cells, row.eq13Mean_percent());
      addForces(cells, row.eq13Worst_percent());
      rows.push_back(std::move(cells));
    }
  }
  page.table(heads, rows,
             "Eq. (13), mean relative error of 100 test forces [%]; mean: of the six test areas; worst area: the area "
             "with the largest error");
}

/// The measures that do not blow up where a force is near 0.
void fairMeasures(ReportPage& page, const ProtocolResult& result, const std::string& figure) {
  Cells heads{"way", "spread"};
  addHeads(heads, "floored %");
  addHeads(heads, "mean abs. N");
  addHeads(heads, "RMSE % range");
  heads.emplace_back("condition");
  std::vector<Cells> rows;
  for (const ProtocolCurve& curve : result.curves) {
    if (curve.figure != figure) continue;
    for (const ProtocolRow& row : curve.rows) {
      Cells cells{curve.mode, spreadText(row)};
      addForces(cells, row.eq13FlooredMean_percent());
      addForces(cells, row.meanAbsolute_N());
      addForces(cells, row.rmse_percentOfRange());
      cells.push_back(row.condition.empty() ? "-" : shortNumber(row.condition.front()));
      rows.push_back(std::move(cells));
    }
  }
  page.table(heads, rows,
             "The same fits: Eq. (13) with |F| >= 0.05 N in the denominator, mean absolute error, root mean square "
             "error in % of the force range, condition of the system that was solved");
}

void ways(ReportPage& page, const ProtocolResult& result, const std::string& figure) {
  std::vector<Cells> rows;
  for (const ProtocolCurve& curve : result.curves)
    if (curve.figure == figure) rows.push_back({curve.mode, curve.what});
  page.table({"way", "what it is"}, rows);
}

void pictures(ReportPage& page, const std::vector<ReportPicture>& all, const std::string& section) {
  for (const ReportPicture& picture : all)
    if (picture.section == section) page.picture(picture.png, picture.caption);
}

bool has(const ProtocolResult& result, const std::string& figure) {
  for (const ProtocolCurve& curve : result.curves)
    if (curve.figure == figure) return true;
  return false;
}

std::string cpuName() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line))
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

void figure(ReportPage& page, const ProtocolResult& result, const std::vector<ReportPicture>& all,
            const std::string& name) {
  comparison(page, result, name);
  ways(page, result, name);
  fairMeasures(page, result, name);
  pictures(page, all, name);
}

} // namespace

std::string protocolCsv(const ProtocolResult& result) {
  std::string csv = "figure,mode,spread,repetition,area,force,published_percent,eq13_percent,eq13_floored_percent,"
                    "mean_absolute_N,rmse_percent_of_range,condition\n";
  for (const ProtocolCurve& curve : result.curves)
    for (const ProtocolRow& row : curve.rows)
      for (std::size_t seed = 0; seed < row.errors.size(); ++seed)
        for (Eigen::Index area = 0; area < row.errors[seed].eq13_percent.cols(); ++area)
          for (int f = 0; f < 3; ++f) {
            const ProtocolErrors& e = row.errors[seed];
            csv += curve.figure + ',' + curve.mode + ',' + (row.spread ? text(*row.spread) : "") + ',' +
                   std::to_string(seed) + ',' + std::to_string(area) + ',' + kForces[f] + ',' +
                   (row.published_percent ? text((*row.published_percent)(f)) : "") + ',' +
                   text(e.eq13_percent(f, area)) + ',' + text(e.eq13Floored_percent(f, area)) + ',' +
                   text(e.meanAbsolute_N(f, area)) + ',' + text(e.rmse_percentOfRange(f, area)) + ',' +
                   text(row.condition[seed]) + '\n';
          }
  return csv;
}

std::string machineLine() {
  utsname system{};
  uname(&system);
  return cpuName() + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads, " + system.sysname + " " +
         system.release + ", Eigen " + std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) +
         "." + std::to_string(EIGEN_MINOR_VERSION) + ", compiler " + __VERSION__;
}

std::string paperReportHtml(const ProtocolResult& result, const std::vector<ReportPicture>& all, const ReportRun& run) {
  ReportPage page("The paper's experiments, reproduced");
  page.paragraph(
      "F. Wang et al., Decoupling research of a three-dimensional force flexible tactile sensor based on radial "
      "basis function neural network, Sensors & Transducers 159 (11), 2013, 289-298. Every number in the "
      "columns 'paper' is printed there; all others were computed for this page.");
  page.code(run.command);
  if (!result.curves.empty()) {
    page.paragraph("Samples: " + std::to_string(result.samples) + " forces (" + std::to_string(run.seeds) +
                   " repetition(s), first seed " + std::to_string(run.firstSeed) + "), solved on " + result.mesh +
                   "; largest difference to full Newton on the share that was solved again: " +
                   shortNumber(result.batchError) + " (relative). Numbers are medians over the repetitions.");
    page.paragraph(
        "Conventions: spread is MATLAB's radbas, phi(r) = exp(-ln 2 (r/spread)^2); 'one scale' takes the mean from "
        "every input and divides all by one number, so that the training sample farthest from the mean is at distance "
        "1; 'min-max' scales each input separately to [-1, 1]. The paper does not say how it scaled its inputs, and a "
        "spread is a length in scaled inputs: positions on the spread axis are therefore ours. What can be compared "
        "with "
        "the paper is the shape of the curve, the error at its best spread, and the error at the spread that "
        "leave-one-out chooses. Networks are trained on 100 forces on each of the "
        "six areas and tested on 100 other forces on each. The paper tests one area that it does not name: "
        "which one it is changes the error by 10 to 1000 times, so the mean and the worst are given.");
  }
  if (!all.empty()) {
    page.heading("Deformation under a force on the first area (Figs. 4, 6, 7)");
    pictures(page, all, "deformation");
  }
  if (has(result, "table1")) {
    page.heading("Force from deformation (Table 1, Figs. 8-11)");
    figure(page, result, all, "table1");
  }
  if (has(result, "fig12")) {
    page.heading("Force from resistance (Fig. 12, Figs. 13-16)");
    page.paragraph(
        "The paper's text contradicts itself here: it states that errors fall with the spread, yet 0.5 is worse "
        "than 1. Its optimum near 1 appears with one scale for all inputs; with min-max for each input it "
        "moves to larger spreads (paper-minmax).");
    figure(page, result, all, "fig12");
  }
  page.heading("What the model leaves out");
  page.paragraph("Eq. (1) adds independent pairs of electrodes in a block that conducts everywhere: no sneak paths, no "
                 "field between them. The rubber has no hysteresis, creep or temperature, which in real conductive "
                 "rubber exceed 1e-4 of R by far. No noise is in these samples: the errors above say nothing about a "
                 "board's readings.");
  page.heading("How it was made");
  std::vector<Cells> stages;
  for (const auto& [stage, count] : result.stages.counts())
    stages.push_back({stage, std::to_string(count.runs), shortNumber(count.seconds)});
  page.table({"stage", "runs", "seconds"}, stages);
  page.paragraph("Total time " + shortNumber(run.seconds) + " s. " + machineLine() + ".");
  return page.html();
}

} // namespace palp
