#include "app/scenes/charts/ChartSvg.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

std::size_t countOf(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(ChartSvg, HoldsLinesAndLettersAndNoPixels) {
  ChartSpec spec;
  spec.title = "Error against spread";
  spec.xLabel = "spread";
  spec.yLabel = "error [%]";
  spec.series = {{.name = "rbf", .x = {1, 2, 3}, .y = {1, 4, 9}, .style = ChartSeries::Style::LineAndPoints}};
  const std::string svg = chartSvg(spec, 600, 400);
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_NE(svg.find("width=\"600"), std::string::npos) << svg.substr(0, 400);
  EXPECT_EQ(svg.find("<image"), std::string::npos);
  EXPECT_GT(countOf(svg, "<path") + countOf(svg, "<poly") + countOf(svg, "<line"), 10U);
  EXPECT_EQ(svg, chartSvg(spec, 600, 400)) << "the same chart, the same bytes";
  spec.series.push_back({.name = "linear", .x = {1, 2, 3}, .y = {2, 2, 2}});
  EXPECT_GT(chartSvg(spec, 600, 400).size(), svg.size()) << "another curve is more to draw";
}

} // namespace
} // namespace palp
