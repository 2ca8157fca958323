#include "app/gui/jobs/LoadPath.h"

#include <algorithm>

namespace palp {

namespace {

template <class Values> Values between(const Values& a, const Values& b, double t) {
  return (1 - t) * a + t * b;
}

LoadPathState between(const LoadPathState& a, const LoadPathState& b, double fraction) {
  const double t = (fraction - a.fraction) / (b.fraction - a.fraction);
  LoadPathState state = b;
  state.fraction = fraction;
  NodalFields& fields = state.fields;
  fields.displacement_mm = between(a.fields.displacement_mm, b.fields.displacement_mm, t);
  fields.cauchy_MPa = between(a.fields.cauchy_MPa, b.fields.cauchy_MPa, t);
  fields.pressure_MPa = between(a.fields.pressure_MPa, b.fields.pressure_MPa, t);
  fields.vonMises_MPa = between(a.fields.vonMises_MPa, b.fields.vonMises_MPa, t);
  fields.volumeRatio = between(a.fields.volumeRatio, b.fields.volumeRatio, t);
  fields.principalStretches = between(a.fields.principalStretches, b.fields.principalStretches, t);
  ElectrodeDisplacements& electrodes = state.electrodes;
  electrodes.upper_mm = between(a.electrodes.upper_mm, b.electrodes.upper_mm, t);
  electrodes.lower_mm = between(a.electrodes.lower_mm, b.electrodes.lower_mm, t);
  electrodes.upperPressure_MPa = between(a.electrodes.upperPressure_MPa, b.electrodes.upperPressure_MPa, t);
  return state;
}

} // namespace

std::vector<LoadPathState> loadPathStates(const Touch& touch, const std::stop_token& stop) {
  std::vector<LoadPathState> path;
  for (const LoadIncrement& state : touch.solution()->increments) {
    if (stop.stop_requested()) break;
    path.push_back({state.loadFraction, touch.problem()->fields(state), touch.problem()->electrodes(state)});
  }
  return path;
}

LoadPathState stateAt(const std::vector<LoadPathState>& path, double fraction) {
  const auto after =
      std::find_if(path.begin(), path.end(), [&](const LoadPathState& s) { return s.fraction >= fraction; });
  if (after == path.end()) return path.back();
  if (after == path.begin() || after->fraction == fraction) return *after;
  return between(*std::prev(after), *after, fraction);
}

} // namespace palp
