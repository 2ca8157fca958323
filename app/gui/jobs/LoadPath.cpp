#include "app/gui/jobs/LoadPath.h"

#include <QObject>

#include <algorithm>
#include <cmath>

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
  const Eigen::Matrix3Xd &from = a.fields.contactTraction_MPa, &to = b.fields.contactTraction_MPa;
  if (from.cols() == to.cols()) // at rest there is none
    fields.contactTraction_MPa = between(from, to, t);
  else
    fields.contactTraction_MPa *= t;
  for (std::size_t k = 0; k < state.indenters.size(); ++k) {
    const IndenterState rest, &before = k < a.indenters.size() ? a.indenters[k] : rest;
    IndenterState& now = state.indenters[k];
    now.force_N = between(before.force_N, b.indenters[k].force_N, t);
    now.translation_mm = between(before.translation_mm, b.indenters[k].translation_mm, t);
  }
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
    path.push_back(
        {state.loadFraction, touch.problem()->fields(state), touch.problem()->electrodes(state), state.indenters});
  }
  return path;
}

QString loadPlaceWords(double fraction) {
  if (!(fraction > 1)) return QObject::tr("%1 % of the load").arg(100 * fraction, 0, 'g', 3);
  const double step = std::ceil(fraction - 1e-9) - 1;
  return QObject::tr("step %1 of the path, %2 %").arg(step).arg(100 * (fraction - step), 0, 'g', 3);
}

LoadPathState stateAt(const std::vector<LoadPathState>& path, double fraction) {
  const auto after =
      std::find_if(path.begin(), path.end(), [&](const LoadPathState& s) { return s.fraction >= fraction; });
  if (after == path.end()) return path.back();
  if (after == path.begin() || after->fraction == fraction) return *after;
  return between(*std::prev(after), *after, fraction);
}

} // namespace palp
