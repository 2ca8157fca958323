#pragma once

#include "app/gui/project/LiveSettings.h"
#include "app/gui/project/ViewSettings.h"
#include "app/study/decoding/TrainOptions.h"
#include "model/LoadCase.h"
#include "model/SensorDesign.h"
#include "solver/SensorMesh.h"

#include <cstdint>
#include <string>

namespace palp {

/// Which samples the Network scene makes.
struct SampleSettings {
  int perArea = 100;
  std::uint64_t seed = 1;

  bool operator==(const SampleSettings&) const = default;
};

/// How the Network scene trains and sweeps.
struct NetworkSettings {
  InputKind input = InputKind::Displacement;
  DecoderMode mode = DecoderMode::Default;
  DecoderKind decoder = DecoderKind::Rbf;
  std::string rows = "4";
  bool automaticSpread = false;
  double spread = 1;
  int centers = 0; ///< 0: as the mode says
  double noise = 0;
  double sweepFrom = 0.3;
  double sweepTo = 10;
  int sweepCount = 9;

  bool operator==(const NetworkSettings&) const = default;
  [[nodiscard]] TrainOptions trainOptions() const;
};

/// Everything that a user sets and a project file keeps.
struct Project {
  SensorDesign design = paperDesign();
  LoadCase load;
  MeshOptions mesh;
  SampleSettings samples;
  NetworkSettings network;
  ViewSettings view;
  LiveSettings live;

  bool operator==(const Project&) const = default;
};

/// The paper's design under one example load.
Project exampleProject();

} // namespace palp
