#pragma once

#include "model/SensorDesign.h"

#include <random>

namespace palp {

/// A design of a few straight wires at random places, electrodes at least `apart` from each other and from the walls.
inline SensorDesign randomLayout(unsigned seed, double apart) {
  std::mt19937 engine(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  const auto places = [&](int count, double length) { // in equal shares, each anywhere within its own
    std::vector<double> all;
    const double share = (length - apart) / count;
    for (int i = 0; i < count; ++i) all.push_back(apart + i * share + uniform(0, share - apart));
    return all;
  };
  SensorDesign design;
  design.block_mm = {uniform(6, 12), uniform(6, 12), uniform(2, 4)};
  const auto wires = [&](double across, double along, double low, double high) {
    ElectrodeLayer layer;
    layer.wire_mm = places(static_cast<int>(engine() % 3) + 2, across);
    const int electrodes = static_cast<int>(engine() % 3) + 1;
    for (int wire = 0; wire < layer.wires(); ++wire) layer.along_mm.push_back(places(electrodes, along));
    layer.z_mm = {{uniform(low, high)}};
    return layer;
  };
  const double x = design.block_mm.x(), y = design.block_mm.y(), middle = design.block_mm.z() / 2;
  design.lower = wires(x, y, apart, middle - apart / 2);
  design.upper = wires(y, x, middle + apart / 2, 2 * middle - apart);
  design.lowerFollowsRubber = seed % 2 == 0;
  return design;
}

} // namespace palp
