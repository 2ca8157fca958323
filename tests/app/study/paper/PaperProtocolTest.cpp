#include "app/study/paper/PaperProtocol.h"
#include "app/study/paper/PaperReport.h"
#include "app/study/reports/ReportPage.h"
#include "model/base/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

using namespace palp;

namespace {

/// Few samples on a mesh of few elements: what is tested is the bookkeeping, not the errors.
ProtocolOptions small() {
  ProtocolOptions options;
  options.perArea = 12;
  options.mesh.mapped = std::array<int, 3>{3, 4, 2};
  return options;
}

} // namespace

TEST(PublishedNumbers, AreThePapersTableAndFigure) {
  EXPECT_EQ(publishedPoints("table1").size(), 5U);
  EXPECT_EQ(publishedPoints("fig12").size(), 2U);
  EXPECT_EQ(publishedPoints("table1")[4].spread, 1.5);
  EXPECT_EQ(publishedPoints("table1")[4].error_percent, Eigen::Vector3d(0.16, 0.39, 3.44));
}

TEST(PaperProtocol, GivesEveryWayItsErrorsOnEveryArea) {
  const auto result = runPaperProtocol(paperDesign(), {"table1", "fig12"}, small());
  ASSERT_TRUE(result);
  EXPECT_EQ(result->curves.size(), 7U); // default, paper, linear; for Fig. 12 also paper-minmax
  EXPECT_EQ(result->samples, 2U * 6U * 12U);
  for (const ProtocolCurve& curve : result->curves)
    for (const ProtocolRow& row : curve.rows) {
      ASSERT_EQ(row.errors.size(), 1U);
      EXPECT_EQ(row.errors[0].eq13_percent.cols(), 6);
      EXPECT_TRUE(row.errors[0].eq13_percent.allFinite()) << curve.figure << ' ' << curve.mode;
      EXPECT_TRUE((row.eq13Worst_percent().array() >= row.eq13Mean_percent().array()).all());
    }
  const std::string csv = protocolCsv(*result);
  // Table 1: 5 + 5 + 1 rows, Fig. 12: 10 + 10 + 10 + 1, each for 6 areas and 3 forces, and the heads.
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), (11 + 31) * 18 + 1);
}

TEST(PaperProtocol, RepeatsToTheSameNumbers) {
  const auto a = runPaperProtocol(paperDesign(), {"table1"}, small());
  const auto b = runPaperProtocol(paperDesign(), {"table1"}, small());
  EXPECT_EQ(protocolCsv(*a), protocolCsv(*b));
}

TEST(PaperProtocol, RepetitionsUseOtherForces) {
  ProtocolOptions options = small();
  options.seeds = 2;
  const auto result = runPaperProtocol(paperDesign(), {"table1"}, options);
  const ProtocolRow& row = result->curves[0].rows[0];
  ASSERT_EQ(row.errors.size(), 2U);
  EXPECT_NE(row.errors[0].eq13_percent, row.errors[1].eq13_percent);
}

TEST(PaperProtocol, StopsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  EXPECT_FALSE(runPaperProtocol(paperDesign(), {"table1"}, small(), {}, source.get_token()));
}

TEST(ReportPage, EscapesWordsAndEmbedsPictures) {
  ReportPage page("a < b & c");
  page.paragraph("1 < 2");
  const std::filesystem::path png = std::filesystem::temp_directory_path() / "palp-report-page-test.png";
  std::ofstream(png, std::ios::binary) << "Man"; // base64: TWFu (RFC 4648)
  page.picture(png, "caption");
  std::ofstream(png, std::ios::binary) << "M"; // base64: TQ==
  page.picture(png, "caption");
  std::filesystem::remove(png);
  const std::string html = page.html();
  EXPECT_NE(html.find("<title>a &lt; b &amp; c</title>"), std::string::npos);
  EXPECT_NE(html.find("1 &lt; 2"), std::string::npos);
  EXPECT_NE(html.find("base64,TWFu\""), std::string::npos);
  EXPECT_NE(html.find("base64,TQ==\""), std::string::npos);
  EXPECT_THROW(page.picture("no-such-picture.png", ""), Error);
}
