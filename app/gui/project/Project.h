#pragma once

#include "app/gui/project/DesignStudies.h"
#include "app/gui/project/IndenterPath.h"
#include "app/gui/project/LiveSettings.h"
#include "app/gui/project/SampleSettings.h"
#include "app/gui/project/ViewSettings.h"
#include "app/study/decoding/TrainOptions.h"
#include "model/LoadCase.h"
#include "model/SensorDesign.h"
#include "solver/SensorMesh.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace palp {

/// How the Network scene trains and sweeps: the options of training, and what the scene has besides. The spread of the
/// training is unused: the field keeps its number while the spread is automatic.
struct NetworkSettings : TrainOptions {
  bool automaticSpread = false;
  double chosenSpread = 1;
  double testNoise = 0; ///< relative, of the test samples
  double sweepFrom = 0.3;
  double sweepTo = 10;
  int sweepCount = 9;

  bool operator==(const NetworkSettings&) const = default;
  [[nodiscard]] TrainOptions trainOptions() const;
  /// One of the options below "More options" is set.
  [[nodiscard]] bool trainOptionsSet() const;

private:
  using TrainOptions::spread; // chosenSpread takes its place
};

/// Everything that a user sets and a project file keeps.
struct Project {
  SensorDesign design = paperDesign();
  LoadCase load;
  std::optional<IndenterPath> path; ///< of an indenter of the load, after it
  MeshOptions mesh;
  SampleSettings samples;
  NetworkSettings network;
  ViewSettings view;
  LiveSettings live;
  std::vector<LiveSettings> moreBoards; ///< in addition to that of `live`

  static constexpr std::size_t kMostBoards = 4;

  /// Boards of the Live scene count from 0.
  [[nodiscard]] LiveSettings& board(std::size_t k) { return k == 0 ? live : moreBoards.at(k - 1); }
  [[nodiscard]] const LiveSettings& board(std::size_t k) const { return k == 0 ? live : moreBoards.at(k - 1); }
  [[nodiscard]] std::size_t boards() const { return 1 + moreBoards.size(); }
  std::optional<SensorDesign> kept; ///< to compare the design with
  DesignStudies studies;

  bool operator==(const Project&) const = default;
};

/// Sets the design and removes the loads that cannot act on it.
void setDesign(Project& project, const SensorDesign& design);

/// The paper's design under one example load.
Project exampleProject();

} // namespace palp
