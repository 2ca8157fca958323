#include "app/gui/views/HeatmapSpecs.h"

#include <QObject>

namespace palp {

namespace {

ColorScale scaleOf(const Eigen::MatrixXd& values, ColorMap map, const std::string& quantity, const std::string& unit) {
  return fittingScale(map, {values.data(), values.data() + values.size()}, quantity, unit);
}

} // namespace

HeatmapSpec resistanceHeatmap(const SensorDesign& design, const ElectrodeDisplacements& electrodes,
                              ResistanceKind kind) {
  if (const auto resistances = resistancesOf(design, electrodes)) return resistanceHeatmap(*resistances, kind);
  HeatmapSpec none;
  none.title = whyNoResistances(design).toStdString();
  return none;
}

HeatmapSpec noResistancesYet(const QString& problem) {
  HeatmapSpec none;
  none.title = (problem.isEmpty() ? QObject::tr("Computing the conduction field...") : problem).toStdString();
  return none;
}

HeatmapSpec resistanceHeatmap(const TouchResistances& resistances, ResistanceKind kind) {
  const auto& [rest, now] = resistances;
  HeatmapSpec spec;
  ColorMap map = ColorMap::Diverging;
  std::string quantity;
  std::string unit = "ohm";
  switch (kind) {
  case ResistanceKind::Resistance:
    spec.title = "Row-column resistance under the load";
    spec.values = now;
    map = ColorMap::Viridis;
    quantity = "R";
    break;
  case ResistanceKind::Change:
    spec.title = "Change of resistance under the load";
    spec.values = now - rest;
    quantity = "dR";
    break;
  case ResistanceKind::RelativeChange:
  case ResistanceKind::LessReference:
    spec.title = "Relative change of resistance under the load";
    spec.values = 100 * (now - rest).cwiseQuotient(rest);
    quantity = "dR/R";
    unit = "%";
    break;
  }
  spec.colors = scaleOf(spec.values, map, quantity, unit);
  return spec;
}

HeatmapSpec heatmapLess(const Eigen::MatrixXd& difference_percent, const std::string& whose) {
  HeatmapSpec spec;
  spec.title = "dR/R minus " + whose + ", same load";
  spec.values = difference_percent;
  spec.colors = scaleOf(spec.values, ColorMap::Diverging, "difference", "%");
  return spec;
}

} // namespace palp
