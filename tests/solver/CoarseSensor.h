#pragma once

#include "solver/HyperelasticProblem.h"
#include "solver/SensorMesh.h"

namespace palp {

inline LoadCase onArea(int area, double fx, double fy, double fz) {
  return {{{area, {fx, fy, fz}}}, {}};
}

/// A problem on a mesh coarse enough for a test.
inline HyperelasticProblem coarse(const SensorDesign& design = paperDesign(), double size_mm = 7) {
  return {design, sensorMesh(design, {.meshSize_mm = size_mm, .mapped = {}})};
}

inline const HyperelasticProblem& paperProblem() {
  static const HyperelasticProblem problem = coarse();
  return problem;
}

} // namespace palp
