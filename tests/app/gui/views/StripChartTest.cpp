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

TEST(StripChart, WhatIsDoubtedIsGreyOnAHatchedGround) {
  StripSpec spec;
  spec.yRange = {-1, 1};
  spec.end_s = 10;
  spec.series.push_back({"a", 0, {1, 4, 6, 9}, {0.5, 0.5, 0.5, 0.5}});
  const QImage trusted = pictureOf(spec);
  spec.doubts = {{4, 6, "another sensor"}};
  const QImage doubted = pictureOf(spec);
  EXPECT_NE(doubted, trusted);
  spec.series[0].y = {0.5, 0.5, -0.5, 0.5};
  EXPECT_NE(pictureOf(spec), doubted);
  StripChart chart;
  chart.resize(900, 300);
  chart.setChart(spec);
  EXPECT_TRUE(chart.asCsv().contains(",doubted\n")) << chart.asCsv().toStdString();
  EXPECT_EQ(chart.asCsv().count(",1\n"), 2) << chart.asCsv().toStdString();
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

/// Pixels that differ between x = `from` and x = `to`.
int changed(const QImage& a, const QImage& b, int from, int to) {
  int count = 0;
  for (int x = from; x < to; ++x)
    for (int y = 0; y < a.height(); ++y) count += a.pixel(x, y) != b.pixel(x, y);
  return count;
}

TEST(StripChart, MarksCloseToEachOtherHaveTheirWholeWords) {
  StripSpec spec = jumping(0);
  spec.marks = {{3, ""}, {4, "b"}};
  const QImage without = pictureOf(spec);
  spec.marks[0].second = "a long alarm that says what it is about";
  EXPECT_GT(changed(pictureOf(spec), without, 500, 600), 0) << "they end where the next mark begins";
  spec.marks[1].second = "";
  const QImage alone = pictureOf(spec);
  spec.marks[1].second = "b";
  EXPECT_GT(changed(pictureOf(spec), alone, 0, 900), 0) << "the second has words as well";
}

TEST(StripChart, AMarkThatIsNewHasItsWordsLeftOfTheEdge) {
  StripSpec spec = jumping(0);
  spec.marks = {{9.9, ""}};
  const QImage without = pictureOf(spec);
  spec.marks[0].second = "poke";
  EXPECT_GT(changed(pictureOf(spec), without, 600, 900), 0);
}

TEST(StripChart, ALegendThatIsTooWideHasSeveralLines) {
  StripSpec spec = jumping(0.5);
  spec.series.clear();
  for (int k = 0; k < 6; ++k) spec.series.push_back({QString("7, %1").arg(k), k, {1, 9}, {0.1 * k, 0.1 * k}});
  const auto narrow = [&] {
    StripChart chart;
    chart.resize(260, 200);
    chart.setChart(spec);
    return chart.grab().toImage();
  };
  const QImage first = narrow();
  spec.series[0].name = "7, 9";
  EXPECT_GT(changed(first, narrow(), 0, 260), 0) << "the first curve's name is seen";
}
