#include "app/gui/views/StripChart.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace palp;

namespace {

constexpr int kFrames = 2000;

/// A curve that jumps by `swing` to both sides at every reading; the plot goes from -1 to 1.
StripSpec jumping(double swing) {
  StripSpec spec;
  spec.yRange = {-1, 1};
  spec.end_s = 10;
  StripSeries series;
  for (int k = 0; k < kFrames; ++k) {
    series.t_s.push_back(10.0 * k / kFrames);
    series.y.push_back(k % 2 == 0 ? swing : -swing);
  }
  spec.series.push_back(series);
  return spec;
}

QImage pictureOf(const StripSpec& spec) {
  StripChart chart;
  chart.resize(900, 300);
  chart.setChart(spec);
  return chart.grab().toImage();
}

} // namespace

// As one stroked polyline each of these took Qt's painter minutes, and the window stood still.
TEST(StripChart, PaintsAWildSignalWhereverItGoes) {
  const QImage inside = pictureOf(jumping(0.9));
  EXPECT_NE(inside, pictureOf(jumping(0))); // the curve is seen
  const QImage full = pictureOf(jumping(50));
  for (const double swing : {1e4, 1e9, 1e300, 1.7e308}) EXPECT_EQ(pictureOf(jumping(swing)), full) << swing;
}

TEST(StripChart, AValueThatIsNoNumberBreaksTheCurve) {
  StripSpec spec;
  spec.yRange = {-1, 1};
  spec.end_s = 10;
  spec.series.push_back({"a", 0, {1, 4, 6, 9}, {0.5, 0.5, 0.5, 0.5}});
  const QImage whole = pictureOf(spec);
  spec.series[0].y[2] = std::nan("");
  const QImage broken = pictureOf(spec);
  spec.series[0].t_s = {1, 4};
  spec.series[0].y = {0.5, 0.5};
  EXPECT_NE(broken, whole);
  EXPECT_EQ(broken, pictureOf(spec)); // what is left of the break; the last reading alone is no line
}

TEST(StripChart, TheWordsOfAMarkEndWhereTheNextOneBegins) {
  StripSpec spec = jumping(0);
  spec.marks = {{3, "a long alarm that says what it is about"}};
  const auto inkRightOf = [&](double t_s) { // of the words' line
    StripChart chart;
    chart.resize(900, 300);
    chart.setChart(spec);
    const QImage with = chart.grab().toImage();
    spec.marks[0].second = "";
    chart.setChart(spec);
    const QImage without = chart.grab().toImage();
    spec.marks[0].second = "a long alarm that says what it is about";
    int changed = 0;
    for (int x = static_cast<int>(900 * t_s / 10); x < 900; ++x)
      for (int y = 0; y < 300; ++y) changed += with.pixel(x, y) != without.pixel(x, y);
    return changed;
  };
  EXPECT_GT(inkRightOf(4.5), 0) << "alone they have room";
  spec.marks.emplace_back(4, "b");
  EXPECT_EQ(inkRightOf(4.5), 0) << "over the next one's";
}
