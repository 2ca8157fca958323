#include "app/study/reports/Report.h"

#include "app/study/reports/Csv.h"
#include "app/study/reports/ReportPage.h"
#include "io/DesignFile.h"
#include "io/FilesTogether.h"
#include "model/base/Cancelled.h"

#include <fstream>
#include <sys/utsname.h>
#include <thread>

namespace palp {

namespace {

std::string rowClass(ReportTable::Mark mark) {
  switch (mark) {
  case ReportTable::Mark::Plain:
    return {};
  case ReportTable::Mark::Good:
    return "good";
  case ReportTable::Mark::Doubtful:
    return "doubtful";
  case ReportTable::Mark::Bad:
    return "bad";
  }
  return {};
}

/// Adds the parts of a report to its page, one overload a kind of part.
class PageWriter {
public:
  PageWriter(ReportPage& page, FilesTogether& files, const ReportDrawer& draw, const std::stop_token& stop)
      : page_(page), files_(files), draw_(draw), stop_(stop) {}

  void operator()(const ReportHeading& heading) const { page_.heading(heading.text); }
  void operator()(const ReportWords& words) const { page_.paragraph(words.text); }
  void operator()(const ReportTable& table) const {
    std::vector<std::string> classes;
    for (const ReportTable::Mark mark : table.marks) classes.push_back(rowClass(mark));
    page_.table(table.heads, table.rows, table.caption, classes);
  }
  void operator()(const ReportChart& chart) {
    picture(chart, draw_.chart);
    if (!draw_.chart) return;
    Csv points({"curve", chart.xLabel, chart.yLabel});
    for (const ReportCurve& curve : chart.curves)
      for (std::size_t i = 0; i < curve.x.size(); ++i) points.add({curve.name, curve.x[i], curve.y[i]});
    files_.add(chart.file + ".csv", points.text());
  }
  void operator()(const ReportMap& map) { picture(map, draw_.map); }

  /// Charts and maps that had no drawer.
  int notDrawn() const { return notDrawn_; }

private:
  template <class Drawing, class Draw> void picture(const Drawing& drawing, const Draw& draw) {
    if (!draw) {
      ++notDrawn_;
      page_.paragraph(drawing.title + ": not drawn, this palp was built without VTK; its points are in the CSV.");
      return;
    }
    throwIfStopped(stop_);
    page_.picture(files_.add(drawing.file + ".png", [&](const auto& png) { draw(drawing, png); }), drawing.caption);
  }

  ReportPage& page_;
  FilesTogether& files_;
  const ReportDrawer& draw_;
  const std::stop_token& stop_;
  int notDrawn_ = 0;
};

std::string processorName() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line))
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

/// Machine and versions.
std::string machineLine() {
  utsname system{};
  uname(&system);
  return processorName() + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads, " + system.sysname +
         " " + system.release + ", Eigen " + std::to_string(EIGEN_WORLD_VERSION) + "." +
         std::to_string(EIGEN_MAJOR_VERSION) + "." + std::to_string(EIGEN_MINOR_VERSION) + ", compiler " + __VERSION__;
}

} // namespace

void ReportTable::add(std::initializer_list<ReportValue> cells, Mark mark) {
  marks.resize(rows.size(), Mark::Plain);
  marks.push_back(mark);
  std::vector<std::string>& row = rows.emplace_back();
  for (const ReportValue& cell : cells) row.push_back(cell.text());
}

void addTimes(ReportPage& page, const StageLog& stages, double seconds) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [stage, count] : stages.counts())
    rows.push_back({stage, std::to_string(count.runs), shortNumber(count.seconds)});
  if (!rows.empty()) page.table({"stage", "runs", "seconds"}, rows);
  page.paragraph("Total time " + shortNumber(seconds) + " s. " + machineLine() + ".");
}

ReportProgress partOf(const ReportProgress& whole, double from, double width) {
  return [whole, from, width](double share, const std::string& what) {
    if (whole) whole(from + width * share, what);
  };
}

ReportOutcome writeReport(const ReportContent& content, const ReportRequest& request, double seconds,
                          const ReportDrawer& draw, const std::stop_token& stop) {
  FilesTogether files(request.folder);
  ReportPage page(content.title);
  page.paragraph(content.summary);
  PageWriter writer(page, files, draw, stop);
  for (const ReportPart& part : content.parts) std::visit(writer, part);
  for (const std::string& warning : content.warnings) page.paragraph("Note: " + warning);
  page.heading("How it was made");
  page.code(request.command);
  page.paragraph("Design " + designFingerprint(request.design) + ", seed " + std::to_string(request.seed) + ".");
  addTimes(page, content.stages, seconds);

  ReportOutcome outcome;
  outcome.done = true;
  outcome.page = request.folder / "report.html";
  outcome.csv = request.folder / "points.csv";
  for (const ReportFile& file : content.files) files.add(file.name, file.content);
  files.add("points.csv", content.csv);
  files.add("report.html", page.html());
  files.commit();
  outcome.summary = content.summary;
  outcome.figures = content.figures;
  outcome.stages = content.stages;
  outcome.warnings = content.warnings;
  if (writer.notDrawn() > 0)
    outcome.warnings.push_back(std::to_string(writer.notDrawn()) +
                               " charts or maps are not drawn: this palp was built without VTK");
  outcome.seconds = seconds;
  return outcome;
}

} // namespace palp
