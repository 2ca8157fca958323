#pragma once

#include "app/scenes/ColorScale.h"

#include <vtkContextItem.h>

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace palp {

/// A word at a place of the 3-D view, always in front.
struct PlacedText {
  Eigen::Vector3d place_mm = Eigen::Vector3d::Zero();
  std::string text;
  Color color{};
};

/// Text and legend over a 3-D view, in pixels of the view.
class Overlay : public vtkContextItem {
public:
  static Overlay* New();
  vtkTypeMacro(Overlay, vtkContextItem)

      bool Paint(vtkContext2D* painter) override;

  std::vector<PlacedText> words;
  std::vector<std::string> lines;   ///< from the top left; the first is bold
  std::optional<ColorScale> legend; ///< at the right edge
  bool triad = false;               ///< the directions x, y, z at the lower left
  Theme theme = Theme::Light;
  double scale = 1; ///< of all sizes; 1 on a plain screen

private:
  /// A word on its ground: left side and middle height in the view [px].
  struct WordBox {
    const PlacedText* word;
    double x, y, width;
  };
  /// None over a shorter one.
  std::vector<WordBox> wordBoxes(vtkContext2D& painter);
  /// Breaks lines that are longer than the view, or would go into the legend.
  void breakLines(vtkContext2D& painter);
  [[nodiscard]] double lineRoom_px(vtkContext2D& painter);
  [[nodiscard]] double legendBar_px();
  /// Keeps long words off the lines at the top left and the legend.
  void keepClear(vtkContext2D& painter, WordBox& box);
  /// The lines at the top left end here [px from the lower left].
  [[nodiscard]] double linesEnd();
  void paintWords(vtkContext2D& painter);
  /// Of words that begin at x and have their middle at y.
  void paintGround(vtkContext2D& painter, double x, double y, double width) const;
  void paintTriad(vtkContext2D& painter);

  std::vector<std::string> broken_; ///< `lines`, none longer than the view
  double widest_ = 0;               ///< of them [px]
};

/// A place of the view: lower left corner and size [px].
struct LegendPlace {
  double x = 0;
  double y = 0;
  double width = 18;
  double height = 200;
};

/// Sizes of a legend at scale 1 [px].
constexpr double kLegendBar_px = 16;
constexpr double kLegendTick_px = 5;
constexpr double kLegendTitle_px = 18; ///< of its middle above the bar

/// Where a bar of this height has its numbers.
std::vector<double> legendTicks(const ColorScale& colors, double height_px, double scale);

/// Paints the bar, its numbers to the right and quantity [unit] above, right-aligned with `right_px`.
void paintLegend(vtkContext2D& painter, const ColorScale& colors, const LegendPlace& place, Theme theme, double scale,
                 double right_px);

/// Pixels that a legend of this scale needs to the right of the bar's left side.
double legendWidth_px(vtkContext2D& painter, const ColorScale& colors, Theme theme, double scale);

/// What a view leaves free at its right side for this legend [px]: its width with its margin and a gap, at least
/// `kLegendRoom_px` at scale 1, in steps, so that other digits move nothing.
double legendRoom_px(const ColorScale& colors, double scale);
constexpr double kLegendRoom_px = 95;

} // namespace palp
