#include "app/study/reports/Csv.h"
#include "app/study/reports/ReportComputations.h"
#include "app/study/reports/Timing.h"
#include "io/AtomicFile.h"
#include "model/base/Error.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace {

/// On a mesh so coarse that little of it is true; touches must meet its nodes.
palp::ReportRequest quickRequest(const palp::TemporaryFolder& folder, const std::string& kind = {}) {
  palp::ReportRequest request;
  request.folder = folder.path();
  request.mesh.mapped = kind == "map" ? std::array{24, 24, 3} : std::array{4, 4, 2};
  request.perArea = 8;
  request.command = "palp report <kind>";
  return request;
}

class EveryReport : public testing::TestWithParam<std::string> {
protected:
  [[nodiscard]] const palp::ReportComputation& kind() const {
    for (const palp::ReportComputation& each : palp::reportComputations())
      if (each.name == GetParam()) return each;
    throw std::logic_error("no such report");
  }
};

/// Those that are computed to their end here; the stability report is, case by case, in its own test.
class FinishedReport : public EveryReport {};

std::string nameOf(const testing::TestParamInfo<std::string>& tested) {
  return tested.param == "error-time" ? std::string("errorTime") : tested.param;
}

} // namespace

TEST_P(FinishedReport, WritesOnePageWithItsNumbersAndACsv) {
  const palp::TemporaryFolder folder;
  std::set<std::string> drawn;
  const auto draw = [&](const auto& drawing, const std::filesystem::path& png) {
    EXPECT_TRUE(drawn.insert(drawing.file).second) << drawing.file << " is drawn twice";
    EXPECT_FALSE(drawing.caption.empty()) << drawing.file;
    palp::writeFile(png, "picture", false);
  };
  const palp::ReportOutcome outcome = runReport(kind(), quickRequest(folder, GetParam()), {}, {}, {draw, draw});
  ASSERT_TRUE(outcome.done);
  EXPECT_FALSE(outcome.summary.empty());
  const std::string page = palp::readFile(outcome.page);
  EXPECT_NE(page.find("palp report &lt;kind&gt;"), std::string::npos) << "the command is missing";
  EXPECT_EQ(page.find("src=\"http"), std::string::npos) << "the page needs a network";
  const std::string csv = palp::readFile(outcome.csv);
  EXPECT_GT(std::count(csv.begin(), csv.end(), '\n'), 20);
}

TEST_P(EveryReport, StopsAndWritesNothing) {
  const palp::TemporaryFolder folder;
  std::stop_source source;
  source.request_stop();
  EXPECT_FALSE(runReport(kind(), quickRequest(folder), {}, source.get_token(), {}).done);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST_P(EveryReport, RefusesADesignThatCannotBe) {
  const palp::TemporaryFolder folder;
  palp::ReportRequest request = quickRequest(folder);
  std::get<MooneyRivlin>(request.design.material.law).c10_MPa = -1;
  EXPECT_THROW(runReport(kind(), request, {}, {}, {}), palp::Error);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryReport,
                         testing::Values("error-time", "stability", "networks", "noise", "layout", "readout", "map",
                                         "scenes"),
                         nameOf);

INSTANTIATE_TEST_SUITE_P(Kinds, FinishedReport,
                         testing::Values("error-time", "networks", "noise", "layout", "readout", "map", "scenes"),
                         nameOf);

/// Draws nothing, and asks for a stop with the second picture.
TEST(WrittenReport, IsGoneWhereItIsStoppedBetweenTwoPictures) {
  const palp::TemporaryFolder folder;
  palp::ReportComputation kind{"two",
                               "two pictures",
                               [](const auto&, const auto&, const auto&) {
                                 palp::ReportContent content;
                                 for (const char* file : {"a", "b"})
                                   content.parts.emplace_back(palp::ReportChart{.file = file, .caption = file});
                                 return std::optional(content);
                               },
                               {}};
  std::stop_source source;
  int drawn = 0;
  const auto outcome = runReport(kind, quickRequest(folder), {}, source.get_token(),
                                 {.chart = [&](const palp::ReportChart&, const std::filesystem::path& png) {
                                   palp::writeFile(png, "picture", false);
                                   if (++drawn == 1) source.request_stop();
                                 }});
  EXPECT_FALSE(outcome.done);
  EXPECT_EQ(drawn, 1);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(WrittenReport, HasThePointsOfEachChartBesideItsPicture) {
  const palp::TemporaryFolder folder;
  palp::ReportContent content;
  palp::ReportChart chart{.file = "a", .xLabel = "x [mm]", .yLabel = "y [N]"};
  chart.curves.push_back({.name = "one, two", .x = {1, 2.5}, .y = {3, 0.1}});
  content.parts.emplace_back(chart);
  const auto draw = [](const palp::ReportChart&, const std::filesystem::path& png) {
    palp::writeFile(png, "picture", false);
  };
  writeReport(content, quickRequest(folder), 0, {.chart = draw}, {});
  EXPECT_EQ(palp::readFile(folder / "a.csv"), "curve,x [mm],y [N]\n\"one, two\",1,3\n\"one, two\",2.5,0.1\n");
}

TEST(WrittenReport, IsGoneWhereAPictureCannotBeDrawn) {
  const palp::TemporaryFolder folder;
  palp::ReportContent content;
  content.parts.emplace_back(palp::ReportChart{.file = "a", .caption = "a"});
  content.parts.emplace_back(palp::ReportChart{.file = "b", .caption = "b"});
  const auto draw = [](const palp::ReportChart& chart, const std::filesystem::path& png) {
    if (chart.file == "b") throw palp::Error("the disk is full");
    palp::writeFile(png, "picture", false);
  };
  EXPECT_THROW(writeReport(content, quickRequest(folder), 0, {.chart = draw}, {}), palp::Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(WrittenReport, OfBeforeStaysWholeWhereTheNextOneFails) {
  const palp::TemporaryFolder folder;
  palp::ReportContent content;
  content.parts.emplace_back(palp::ReportChart{.file = "a", .caption = "a"});
  content.csv = "x\n1\n";
  std::string picture = "picture";
  const auto draw = [&](const palp::ReportChart&, const std::filesystem::path& png) {
    if (picture.empty()) throw palp::Error("the disk is full");
    palp::writeFile(png, picture, true);
  };
  writeReport(content, quickRequest(folder), 0, {.chart = draw}, {});
  const std::string page = palp::readFile(folder / "report.html");
  content.csv = "x\n2\n";
  picture.clear();
  EXPECT_THROW(writeReport(content, quickRequest(folder), 0, {.chart = draw}, {}), palp::Error);
  EXPECT_EQ(palp::readFile(folder / "points.csv"), "x\n1\n");
  EXPECT_EQ(palp::readFile(folder / "a.png"), "picture");
  EXPECT_EQ(palp::readFile(folder / "report.html"), page);
  picture = "another";
  writeReport(content, quickRequest(folder), 0, {.chart = draw}, {});
  EXPECT_EQ(palp::readFile(folder / "points.csv") + palp::readFile(folder / "a.png"), "x\n2\nanother");
}

TEST(Report, WithoutADrawerPageAndWarningSayThatChartsAreMissing) {
  palp::ReportContent content;
  content.parts.emplace_back(palp::ReportChart{.file = "a", .title = "Errors"});
  const palp::TemporaryFolder folder;
  const palp::ReportOutcome outcome = writeReport(content, quickRequest(folder), 0, {}, {});
  ASSERT_EQ(outcome.warnings.size(), 1U);
  EXPECT_NE(outcome.warnings.front().find("1 charts or maps are not drawn"), std::string::npos)
      << outcome.warnings.front();
  EXPECT_NE(palp::readFile(outcome.page).find("Errors: not drawn"), std::string::npos);
}

TEST(Csv, QuotesWhatHoldsACommaAndWritesNumbersExactly) {
  palp::Csv csv({"a", "b"});
  csv.add({"x, \"y\"", 0.1});
  EXPECT_EQ(csv.text(), "a,b\n\"x, \"\"y\"\"\",0.1\n");
}

TEST(Timing, MedianIsTheMiddleOne) {
  EXPECT_EQ((palp::Timing{{5, 1, 3}}.median()), 3);
  EXPECT_EQ((palp::Timing{{1, 3}}.median()), 2);
}
