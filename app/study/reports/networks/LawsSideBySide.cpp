#include "app/study/reports/networks/LawsSideBySide.h"

#include "app/study/reports/ReportWriter.h"
#include "app/study/reports/networks/NoiseAxis.h"

namespace palp {

LawsSideBySide::LawsSideBySide(const SensorDesign& design, const FieldLaw& law, const AreaResponse& response,
                               int threads, StageLog& stages, const std::stop_token& stop)
    : row_(centreRowWire(design.rowWires())) {
  SensorDesign pairs = design;
  if (design.field()) pairs.resistance = PairsLaw{};
  readings_.push_back({"Eq. (1)", rowColumnResistances(pairs, ElectrodeDisplacements::atRest(pairs)),
                       logSensitivity(pairs, response),
                       [pairs, &response](int row, double noise) { return layoutBound(pairs, response, row, noise); }});
  field_ = stages.measure(
      "field", [&] { return std::make_shared<const FieldResponse>(design, law, response, threads, 1, stop); });
  for (const auto& [readout, name] : kReadouts.all())
    readings_.push_back(
        {name, field_->resistances_ohm(readout), field_->logSensitivity(readout),
         [field = field_, which = readout](int row, double noise) { return field->bound(which, row, noise); }});
}

ReportTable LawsSideBySide::signals() const {
  ReportTable table = ReportText("common").table("signals table");
  for (const LawReading& reading : readings_) {
    const auto& [factor, correlation] = comparedWith(readings_.front().slopes, reading.slopes);
    table.add({reading.name, reading.rest_ohm.mean(), reading.rest_ohm.maxCoeff() / reading.rest_ohm.minCoeff(), factor,
               correlation});
  }
  return table;
}

ReportTable LawsSideBySide::bounds(double noise, std::vector<std::pair<std::string, double>>* figures) const {
  ReportTable table = ReportText("common").table("laws table", {{"noise", noise}});
  for (const LawReading& reading : readings_)
    for (const int row : {row_, -1}) {
      const LayoutBound bound = reading.bound(row, noise);
      const std::string rows = rowsText(row);
      table.add({reading.name, rows, bound.withPrior(), bound.withoutPrior()});
      if (!figures) continue;
      const std::string law = &reading == &readings_.front() ? "pairs" : reading.name;
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        figures->emplace_back(law + "_rows_" + rows + "_" + kForceNames[static_cast<std::size_t>(axis)] +
                                  "_bound_with_prior_percent",
                              bound.withPrior()(axis));
    }
  return table;
}

} // namespace palp
