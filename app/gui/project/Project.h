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

/// How the Network scene trains and sweeps.
struct NetworkSettings {
  InputKind input = InputKind::Displacement;
  DecoderMode mode = DecoderMode::Default;
  DecoderKind decoder = DecoderKind::Rbf;
  DecoderTarget target = DecoderTarget::Force; ///< the place as well: of touches alone
  std::string rows = "4";
  bool automaticSpread = false;
  double spread = 1;
  int centers = 0;                          ///< 0: as the mode says
  double noise = 0;                         ///< relative, that is trained with
  double testNoise = 0;                     ///< relative, that the test samples get
  std::optional<CenterChoice> centerChoice; ///< this and what follows: none where the mode decides
  bool allCenters = false;
  std::optional<LeastSquaresMethod> solver;
  std::optional<double> ridge;
  std::optional<Scaling> scaling;
  std::optional<Tail> tail;
  std::optional<SpreadConvention> convention;
  double forgetting = 1;
  std::uint64_t seed = 1; ///< of centres, noise and starts
  double sweepFrom = 0.3;
  double sweepTo = 10;
  int sweepCount = 9;

  bool operator==(const NetworkSettings&) const = default;
  [[nodiscard]] TrainOptions trainOptions() const;
  /// Something is set that otherwise follows from the mode.
  [[nodiscard]] bool trainOptionsSet() const;
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
  std::vector<LiveSettings> moreBoards; ///< beside that of `live`

  static constexpr std::size_t kMostBoards = 4;

  /// Boards of the Live scene count from 0.
  [[nodiscard]] LiveSettings& board(std::size_t k) { return k == 0 ? live : moreBoards.at(k - 1); }
  [[nodiscard]] const LiveSettings& board(std::size_t k) const { return k == 0 ? live : moreBoards.at(k - 1); }
  [[nodiscard]] std::size_t boards() const { return 1 + moreBoards.size(); }
  std::optional<SensorDesign> kept; ///< to compare the design with
  DesignStudies studies;

  bool operator==(const Project&) const = default;
};

/// The paper's design under one example load.
Project exampleProject();

} // namespace palp
