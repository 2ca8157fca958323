#pragma once

// For sources of commands only: keeps nlohmann-json out of other headers.

#include "model/LoadCase.h"
#include "model/RowColumnResistance.h"
#include "model/SensorDesign.h"
#include "model/Solution.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace palp {

// Parts of the result of `palp solve`.

nlohmann::ordered_json newtonJson(const std::vector<NewtonStep>& steps);
/// [row][electrode][3].
nlohmann::ordered_json displacementsJson(const SensorDesign& design, const ElectrodeDisplacements& displacements);
nlohmann::ordered_json matrixJson(const Eigen::MatrixXd& matrix);
nlohmann::ordered_json indentersJson(const LoadCase& load, const std::vector<IndenterState>& states);
/// Force, displacement and contact of an indenter: a line for a terminal.
void printIndenter(const Indenter& indenter, const IndenterState& state);

} // namespace palp
