#pragma once

#include "app/study/StageLog.h"
#include "app/study/reports/ReportValue.h"
#include "model/SensorDesign.h"
#include "model/TouchRange.h"
#include "solver/SensorMesh.h"

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace palp {

/// A curve of a chart, as values; app/scenes draws it.
struct ReportCurve {
  enum class Style { Line, Points, LineAndPoints };

  std::string name{};
  std::vector<double> x{};
  std::vector<double> y{};
  Style style = Style::LineAndPoints;
  bool dashed = false;
  int color = -1; ///< place among the series' colours, for what must look the same in several charts; -1: its own place
};

/// A chart of a report; labels carry their unit.
struct ReportChart {
  std::string file{}; ///< name of the picture, without folder and ending
  std::string caption{};
  std::string title{};
  std::string xLabel{};
  std::string yLabel{};
  bool logX = false;
  bool logY = false;
  std::vector<ReportCurve> curves{};
  std::string topLabel{};                                 ///< label of a second x axis along the top
  std::vector<std::pair<double, std::string>> topTicks{}; ///< and where; empty: none
};

struct ReportTable {
  /// How a row came out; plain rows have no colour.
  enum class Mark { Plain, Good, Doubtful, Bad };

  std::string caption{};
  std::vector<std::string> heads{};
  std::vector<std::vector<std::string>> rows{};
  std::vector<Mark> marks{}; ///< of the rows; plain beyond the last of them

  void add(std::initializer_list<ReportValue> cells, Mark mark = Mark::Plain);
};

/// Values over a rectangle of the sensor's face, as coloured cells; app/scenes draws them.
struct ReportMap {
  std::string file{}; ///< as ReportChart's
  std::string caption{};
  std::string title{};
  std::string quantity{}, unit{}; ///< of the colours
  Eigen::MatrixXd values{};       ///< along y x along x; not a number where there is none
  Eigen::Vector2d low_mm{0, 0};   ///< place of the first value
  Eigen::Vector2d high_mm{0, 0};  ///< of the last
};

struct ReportHeading {
  std::string text;
};

struct ReportWords {
  std::string text;
};

using ReportPart = std::variant<ReportHeading, ReportWords, ReportTable, ReportChart, ReportMap>;

/// A file that goes with a report (a better design, a deck for another program).
struct ReportFile {
  std::string name;
  std::string content;
};

/// Content of a report, in the order of its page.
struct ReportContent {
  std::string title;
  std::vector<ReportPart> parts;
  std::string csv; ///< every point of every curve and table
  std::vector<ReportFile> files;
  std::string summary;                                 ///< a sentence or two with the numbers that matter
  std::vector<std::pair<std::string, double>> figures; ///< such numbers by name with their unit, for programs
  StageLog stages;
  std::vector<std::string> warnings;
};

/// What every kind of report gets.
struct ReportRequest {
  SensorDesign design = paperDesign();
  std::filesystem::path folder; ///< of report.html, points.csv and the pictures
  MeshOptions mesh;             ///< none: the kind's own
  int perArea = 100;            ///< samples on each area, where the kind needs any
  std::uint64_t seed = 1;
  std::optional<TouchRange>
      touches{};       ///< of the map (none: the design's usual ones), and what a layout is to resolve (none: areas)
  int threads = 0;     ///< 0: all cores
  std::string command; ///< that makes the report again; printed in it
};

/// A part of a run, for those who wait for it: up to which share of its progress it goes, and how long it takes on two
/// cores with the paper's design and 100 samples per area.
struct RunPart {
  std::string name{};
  double until = 1;
  double seconds = 0;
  double drawn = 0; ///< share of them that grows with the number of samples
};

/// Gets a share 0..1 and what is being done; may be called from another thread, one call at a time.
using ReportProgress = std::function<void(double, const std::string&)>;
/// The progress of a part that begins at the share `from` of the total.
ReportProgress partOf(const ReportProgress& whole, double from, double width);

/// What a run of a report left behind.
struct ReportOutcome {
  bool done = false; ///< false: cancelled, and no file of it is left
  std::filesystem::path page;
  std::filesystem::path csv;
  std::string summary;
  std::vector<std::pair<std::string, double>> figures;
  StageLog stages;
  std::vector<std::string> warnings;
  double seconds = 0;
};

/// Draw charts and maps into PNG files.
struct ReportDrawer {
  std::function<void(const ReportChart&, const std::filesystem::path&)> chart{};
  std::function<void(const ReportMap&, const std::filesystem::path&)> map{};
};

class ReportPage;
/// Adds how often each stage ran and how long, the total time and the machine.
void addTimes(ReportPage& page, const StageLog& stages, double seconds);

/// Writes page, CSV, pictures and further files into the folder of the request. Without a drawer the page states that
/// this program draws no charts. Throws Error where a file cannot be written and Cancelled where it was stopped; then
/// none of its files stays.
ReportOutcome writeReport(const ReportContent& content, const ReportRequest& request, double seconds,
                          const ReportDrawer& draw, const std::stop_token& stop);

} // namespace palp
