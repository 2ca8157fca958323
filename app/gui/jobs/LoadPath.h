#pragma once

#include "app/study/touch/Touch.h"

#include <QString>

#include <stop_token>
#include <vector>

namespace palp {

/// What is drawn of one state on the way from rest to the full load.
struct LoadPathState {
  double fraction = 0;
  NodalFields fields;
  ElectrodeDisplacements electrodes;
  std::vector<IndenterState> indenters; ///< of the load's indenters
};

/// The equilibria that were computed on the way, rest first; fewer where it was stopped.
std::vector<LoadPathState> loadPathStates(const Touch& touch, const std::stop_token& stop);

/// "40 % of the load"; above 1 "step 2 of the path, 40 %".
QString loadPlaceWords(double fraction);

/// The state at a load fraction, linear between the equilibria; the ends where it lies outside of them.
LoadPathState stateAt(const std::vector<LoadPathState>& path, double fraction);

} // namespace palp
