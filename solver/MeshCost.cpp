#include "solver/MeshCost.h"

#include "model/base/NumberText.h"
#include "model/base/Text.h"
#include "solver/mesh/GradedTets.h"

#include <cmath>

namespace palp {

namespace {

/// Of one load on a mesh of tetrahedra of the paper's block, measured with 9,720 to 105,336 elements (1.2 to 79 s of
/// processor time, 234 to 3,170 MB; resources/docs/numerics/solver.md).
constexpr double kTets = 1e5, kSeconds = 72, kTimeGrowth = 1.8;
constexpr double kProgram_MB = 100, kMemory_MB = 3000, kMemoryGrowth = 1.27;
constexpr double kProcessors = 1.7; // that two cores are worth
constexpr double kUnknownsATet = 4.2, kUnknownsAHex = 3.3;
constexpr double kLong_s = 20, kLarge_MB = 2000;

/// In two digits.
std::string roughly(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return withDigits(std::round(value / unit) * unit, 6);
}

bool isLarge(const MeshCost& cost) {
  return cost.seconds > kLong_s || cost.memory_MB > kLarge_MB;
}

std::string thousands(const MeshCost& cost) {
  return text(std::round(cost.elements / 1000)) + ",000";
}

std::string timeOf(const MeshCost& cost) {
  return cost.seconds < 100 ? roughly(cost.seconds) + " s" : roughly(cost.seconds / 60) + " min";
}

std::string memoryOf(const MeshCost& cost) {
  return roughly(cost.memory_MB / 1000) + " GB";
}

} // namespace

MeshCost meshCost(const SensorDesign& design, const MeshOptions& options) {
  requireMeshable(design, options);
  MeshCost cost;
  double ofTets = 1;
  if (options.mapped) {
    cost.elements = double((*options.mapped)[0]) * (*options.mapped)[1] * (*options.mapped)[2];
    ofTets = kUnknownsAHex / kUnknownsATet;
  } else {
    cost.elements = gradedElements(design, options);
  }
  const double growth = ofTets * cost.elements / kTets;
  cost.memory_MB = kProgram_MB + kMemory_MB * std::pow(growth, kMemoryGrowth);
  cost.seconds = kSeconds / kProcessors * std::pow(growth, kTimeGrowth);
  return cost;
}

std::string costInWords(const MeshCost& cost) {
  if (!isLarge(cost)) return {};
  return "the mesh has about " + thousands(cost) + " elements: a load takes about " + timeOf(cost) + " and " +
         memoryOf(cost) + " of memory; a larger mesh size takes less";
}

std::string costInBrief(const MeshCost& cost) {
  if (!isLarge(cost)) return {};
  return ": " + thousands(cost) + " elements, about " + timeOf(cost) + " and " + memoryOf(cost);
}

} // namespace palp
