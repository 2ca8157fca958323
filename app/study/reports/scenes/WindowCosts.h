#pragma once

#include "app/study/reports/Report.h"

#include <array>
#include <string>
#include <vector>

namespace palp {

/// The stages of the chain that are counted, in their order.
inline constexpr std::array<const char*, 3> kChainStages{"mesh", "factorise", "solve"};

/// One step of a user in a scene of the window, and what it cost.
struct WindowStep {
  std::string scene, event;
  std::array<int, kChainStages.size()> runs{};
  int pictures = 0;       ///< drawn in the scene that is seen
  int hiddenPictures = 0; ///< drawn or painted in those that are not
  double seconds = 0;     ///< until the last picture
  double cpu_s = 0;
  double held_MB = 0;                            ///< after the step
  double peak_MB = 0;                            ///< during it
  bool showsMesh = false, showsSolution = false; ///< what the scene that is seen needs
  bool complete = true;

  /// What should not have been: work that is not shown, or is done a second time. Empty where all is well.
  [[nodiscard]] std::string fault() const;
};

/// palp-studio, without a display, through its scenes.
struct WindowCosts {
  std::vector<WindowStep> steps;
  std::array<int, 2> window_px{};
  std::string failed; ///< why there are no steps, or not all; empty where there are
};

/// Each scene alone, in a process of its own, and all in turn in another.
WindowCosts windowCosts(const ReportRequest& request, const ReportProgress& progress, const std::stop_token& stop);

} // namespace palp
