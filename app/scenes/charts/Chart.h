#pragma once

#include "app/scenes/Palette.h"
#include "app/scenes/Picture.h"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

class vtkChartXY;

namespace palp {

/// One curve or cloud of a chart; pairs that are not numbers, or not above 0 on a logarithmic axis, are left out.
struct ChartSeries {
  enum class Style { Line, Points, LineAndPoints };

  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  Style style = Style::Line;
  bool dashed = false;                 ///< its points are diamonds
  int color = -1;                      ///< place in the palette's series colours; -1: the series' own place
  bool level = false;                  ///< one y that no x belongs to, drawn from x to x
  std::optional<std::string> legend{}; ///< its words in the legend; none: the name, empty: it is not in it

  [[nodiscard]] const std::string& legendWords() const { return legend ? *legend : name; }
  bool operator==(const ChartSeries&) const = default;
};

/// A chart of y against x; labels carry their unit.
struct ChartSpec {
  std::string title;
  std::string xLabel;
  std::string yLabel;
  bool logX = false;
  bool logY = false;
  std::vector<ChartSeries> series;
  std::string topLabel{};                                 ///< a second x axis along the top
  std::vector<std::pair<double, std::string>> topTicks{}; ///< its marks: x and text; empty: none
  std::optional<std::array<double, 2>> xRange;            ///< else: all the points and a little more
  std::optional<std::array<double, 2>> yRange;

  bool operator==(const ChartSpec&) const = default;
};

/// Fills the chart, with the theme's colours; text grows with `scale` (1 on a plain screen). For a view that stays, of
/// the given size: the legend is put where it covers nothing, or gets room of its own.
void fillChart(vtkChartXY& chart, const ChartSpec& spec, Theme theme = Theme::Light, double scale = 1,
               const std::array<double, 2>& size_px = {900, 560});

/// The chart as a picture.
Picture drawChart(const ChartSpec& spec, int width = 900, int height = 560, Theme theme = Theme::Light);

} // namespace palp
