#include "app/cli/MeshCostLine.h"

#include "solver/MeshCost.h"

#include <iostream>

namespace palp {

void printMeshCost(const SensorDesign& design, const MeshOptions& options, Session& session, const std::string& which) {
  std::string words = costInWords(meshCost(design, options));
  if (words.empty()) return;
  words = which + words;
  std::cerr << "palp: " << words << std::endl; // before the work, also into a file
  session.warnings.push_back(std::move(words));
}

} // namespace palp
