#pragma once

#include "app/scenes/Palette.h"
#include "model/SensorDesign.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkRenderer;

namespace palp {

/// A decoded force on its load area, or where on the top face it was decoded to act.
struct LiveArrow {
  int area = 0;
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector2d> place_mm{};
  Eigen::Vector2d deviation_mm = Eigen::Vector2d::Zero(); ///< of the place
  std::array<bool, 3> measured{true, true, true};         ///< the components that the network gives
  bool operator==(const LiveArrow&) const = default;
};

struct LiveSceneOptions {
  double mm_per_N = 2; ///< of the arrows, the same for all frames
  bool electrodes = true;
  Theme theme = Theme::Light;
  double scale = 1;     ///< of lines
  double textScale = 1; ///< of words
};

/// Along which the sensor is looked at, as long as nobody turns it.
inline const Eigen::Vector3d liveDirection{0.45, 1.0, -0.75};

/// The sensor at rest with the forces decoded just now. Nothing is meshed: the block is its box.
class LiveScene {
public:
  LiveScene();
  ~LiveScene();

  [[nodiscard]] vtkRenderer* renderer() const;
  /// The block, its wires and areas; the arrows stay.
  void showSensor(const SensorDesign& design, const LiveSceneOptions& options);
  /// Arrows to scale; `stale` draws them grey: the last known, while there are no forces. `lines` are shown at the top
  /// left, the first in bold. `truth_mm`: where a simulated indenter truly touches, as a cross in a circle.
  void showForces(const std::vector<LiveArrow>& arrows, bool stale, const std::vector<std::string>& lines,
                  const std::optional<Eigen::Vector2d>& truth_mm = {});
  /// Where a pixel of the view (from the lower left) meets the plane of the top face [mm]; nullopt outside it.
  [[nodiscard]] std::optional<Eigen::Vector2d> topPlace(double x_px, double y_px) const;
  void resetCamera(double aspect, const Eigen::Vector3d& direction = liveDirection);

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

} // namespace palp
