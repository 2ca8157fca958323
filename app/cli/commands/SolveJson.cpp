#include "app/cli/commands/SolveJson.h"

#include "model/base/NumberText.h"

#include <cstdio>

namespace palp {

namespace {

using Json = nlohmann::ordered_json;

Json vectorJson(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

} // namespace

Json newtonJson(const std::vector<NewtonStep>& steps) {
  Json json = Json::array();
  for (const NewtonStep& step : steps)
    json.push_back({{"load_fraction", step.loadFraction},
                    {"iteration", step.iteration},
                    {"relative_residual", step.relativeResidual}});
  return json;
}

Json displacementsJson(const SensorDesign& design, const ElectrodeDisplacements& displacements) {
  Json rows = Json::array();
  for (int r = 0; r < design.rowWires(); ++r) {
    Json row = Json::array();
    for (int e = 0; e < design.electrodesPerRowWire(); ++e) {
      const Eigen::Vector3d u = displacements.upper_mm.col(r * design.electrodesPerRowWire() + e);
      row.push_back({u.x(), u.y(), u.z()});
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

Json matrixJson(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    Json row = Json::array();
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) row.push_back(matrix(r, c));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json indentersJson(const LoadCase& load, const std::vector<IndenterState>& states) {
  Json json = Json::array();
  for (std::size_t k = 0; k < states.size(); ++k)
    json.push_back({{"shape", shapeName(load.indenters[k].shape)},
                    {"force_N", vectorJson(states[k].force_N)},
                    {"translation_mm", vectorJson(states[k].translation_mm)},
                    {"contact_area_mm2", states[k].contactArea_mm2},
                    {"contact_radius_mm", states[k].contactRadius_mm},
                    {"centre_pressure_MPa", states[k].centrePressure_MPa},
                    {"slip_share", states[k].slipShare}});
  return json;
}

void printIndenter(const Indenter& indenter, const IndenterState& state) {
  const auto withoutRounding = [](const Eigen::Vector3d& v) -> Eigen::Vector3d { // 1e-17 N is rounding
    return (v.array().abs() > 1e-12 * v.norm()).select(v, Eigen::Vector3d::Zero());
  };
  const Eigen::Vector3d f = withoutRounding(state.force_N), d = withoutRounding(state.translation_mm);
  const auto inWords = [](const auto& v) {
    return "(" + withDigits(v.x(), 6) + ", " + withDigits(v.y(), 6) + ", " + withDigits(v.z(), 6) + ")";
  };
  const std::string words = shapeName(indenter.shape) + ": force " + inWords(f) + " N, moved " + inWords(d) +
                            " mm; contact " + withDigits(state.contactArea_mm2, 4) + " mm2, radius " +
                            withDigits(state.contactRadius_mm, 4) + " mm, pressure at its centre " +
                            withDigits(state.centrePressure_MPa, 4) + " MPa, slides on " +
                            withDecimals(100 * state.slipShare, 0) + " %\n";
  std::fputs(words.c_str(), stdout);
}

} // namespace palp
