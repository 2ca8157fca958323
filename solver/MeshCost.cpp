#include "solver/MeshCost.h"

#include "model/base/Text.h"
#include "solver/mesh/GradedTets.h"

#include <cmath>

namespace palp {

namespace {

/// The default mesh of the paper's block, measured (resources/docs/numerics/factorisation.md): unknowns, memory of a
/// solve, and seconds.
constexpr double kUnknowns = 41070, kMemory_MB = 300, kSeconds = 1.2;
/// How they grow with the unknowns: between flat blocks and cubes.
constexpr double kMemoryGrowth = 1.15, kTimeGrowth = 1.5;
constexpr double kUnknownsATet = 4.2, kUnknownsAHex = 3.3;
constexpr double kLong_s = 20, kLarge_MB = 2000;

/// In two digits.
std::string roughly(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return text(std::round(value / unit) * unit);
}

} // namespace

MeshCost meshCost(const SensorDesign& design, const MeshOptions& options) {
  requireMeshable(design, options);
  MeshCost cost;
  double unknowns = kUnknownsAHex;
  if (options.mapped) {
    cost.elements = double((*options.mapped)[0]) * (*options.mapped)[1] * (*options.mapped)[2];
  } else {
    cost.elements = gradedElements(design, options);
    unknowns = kUnknownsATet;
  }
  const double growth = unknowns * cost.elements / kUnknowns;
  cost.memory_MB = kMemory_MB * std::pow(growth, kMemoryGrowth);
  cost.seconds = kSeconds * std::pow(growth, kTimeGrowth);
  return cost;
}

std::string costInWords(const MeshCost& cost) {
  if (cost.seconds <= kLong_s && cost.memory_MB <= kLarge_MB) return {};
  const std::string time = cost.seconds < 100 ? roughly(cost.seconds) + " s" : roughly(cost.seconds / 60) + " min";
  return "the mesh has about " + text(std::round(cost.elements / 1000)) + ",000 elements: a load takes about " + time +
         " and " + roughly(cost.memory_MB / 1000) + " GB of memory; a larger mesh size takes less";
}

} // namespace palp
