#include "app/gui/views/HeatmapSpecs.h"

namespace palp {

HeatmapSpec resistanceHeatmap(const Touch& touch, const Eigen::MatrixXd& resistances_ohm, ResistanceKind kind) {
  const Eigen::MatrixXd rest = rowColumnResistances(touch.design(), ElectrodeDisplacements::atRest(touch.design()));
  HeatmapSpec spec;
  ColorMap map = ColorMap::Diverging;
  std::string quantity;
  std::string unit = "ohm";
  switch (kind) {
  case ResistanceKind::Resistance:
    spec.title = "Row-column resistance";
    spec.values = resistances_ohm;
    map = ColorMap::Viridis;
    quantity = "R";
    break;
  case ResistanceKind::Change:
    spec.title = "Change of resistance under the load";
    spec.values = resistances_ohm - rest;
    quantity = "dR";
    break;
  case ResistanceKind::RelativeChange:
    spec.title = "Relative change of resistance under the load";
    spec.values = 100 * (resistances_ohm - rest).cwiseQuotient(rest);
    quantity = "dR/R";
    unit = "%";
    break;
  }
  spec.colors = fittingScale(map, {spec.values.data(), spec.values.data() + spec.values.size()}, quantity, unit);
  return spec;
}

} // namespace palp
