#include "app/scenes/charts/Heatmap.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

Heatmap changes() {
  Heatmap heatmap;
  heatmap.spec.title = "dR/R since the design at rest <now>";
  heatmap.spec.values = Eigen::MatrixXd::Random(10, 30);
  heatmap.spec.colors = {ColorMap::Diverging, -1, 1, "dR/R", "%"};
  return heatmap;
}

std::size_t rectangles(const std::string& svg) {
  std::size_t count = 0;
  for (std::size_t at = svg.find("<rect"); at != std::string::npos; at = svg.find("<rect", at + 1)) ++count;
  return count;
}

TEST(Heatmap, IsDrawnAsRectanglesAndLetters) {
  Heatmap heatmap = changes();
  const std::string svg = heatmap.svg(900, 400);
  EXPECT_EQ(svg.find("<image"), std::string::npos);
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_NE(svg.find(">dR/R since the design at rest &lt;now&gt;</text>"), std::string::npos);
  for (const char* words : {">row-wire<", ">column-wire<", ">dR/R [%]<", ">9<"})
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  EXPECT_GT(rectangles(svg), 300U) << "one a cell, and the legend";
  EXPECT_EQ(svg, heatmap.svg(900, 400)) << "the same values, the same bytes";
  EXPECT_FALSE(heatmap.cellAt(300, 200)) << "what is seen is as it was";
  heatmap.spec.selected = {2, 3};
  EXPECT_EQ(rectangles(heatmap.svg(900, 400)), rectangles(svg) + 4) << "its frame";
  heatmap.spec.values.resize(0, 0);
  EXPECT_EQ(rectangles(heatmap.svg(900, 400)), 1U) << "its ground alone";
}

TEST(Heatmap, ANarrowOneShowsItsTitleToTheEnd) {
  Heatmap heatmap = changes();
  heatmap.spec.title = "dR/R since the design at rest";
  const Picture narrow = heatmap.picture(300, 200);
  heatmap.spec.title.back() = 'x';
  EXPECT_NE(narrow.rgb, heatmap.picture(300, 200).rgb) << "its last letter is seen";
}

} // namespace
} // namespace palp
