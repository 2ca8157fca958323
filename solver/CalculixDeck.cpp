#include "solver/CalculixDeck.h"

#include "model/Error.h"
#include "model/Text.h"
#include "solver/SurfaceTraction.h"

namespace palp {

namespace {

constexpr int kNumbersALine = 16; // what both programs read on one line

/// Numbers between commas, broken into lines.
std::string wrapped(const std::vector<int>& numbers) {
  std::string lines;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const bool last = i + 1 == numbers.size();
    lines += std::to_string(numbers[i]);
    lines += last || (i + 1) % kNumbersALine == 0 ? "\n" : ", ";
  }
  return lines;
}

std::string nodeBlock(const Mesh& mesh) {
  std::string block = "*NODE, NSET=ALL\n";
  for (Eigen::Index n = 0; n < mesh.nodes_mm.cols(); ++n)
    block += std::to_string(n + 1) + ", " + text(mesh.nodes_mm(0, n)) + ", " + text(mesh.nodes_mm(1, n)) + ", " +
             text(mesh.nodes_mm(2, n)) + "\n";
  return block;
}

/// Both shapes have their nodes in the order of those programs.
std::string elementBlock(const Mesh& mesh) {
  const bool tetrahedra = mesh.shape == ElementShape::Tetrahedron10;
  std::string block = std::string("*ELEMENT, TYPE=") + (tetrahedra ? "C3D10" : "C3D8") + ", ELSET=BLOCK\n";
  for (Eigen::Index e = 0; e < mesh.elements.cols(); ++e) {
    std::vector<int> numbers{static_cast<int>(e) + 1};
    for (Eigen::Index i = 0; i < mesh.elements.rows(); ++i) numbers.push_back(mesh.elements(i, e) + 1);
    block += wrapped(numbers);
  }
  return block;
}

/// D1 = 2 / kappa; the energy is W = c10 (I1bar - 3) + c01 (I2bar - 3) + (J - 1)^2 / D1.
std::string materialBlock(const Material& material) {
  return "*MATERIAL, NAME=RUBBER\n*HYPERELASTIC, MOONEY-RIVLIN\n" + text(material.c10_MPa) + ", " +
         text(material.c01_MPa) + ", " + text(2 * material.compressibility_per_MPa()) + "\n*DENSITY\n" +
         text(material.density_t_per_mm3) + "\n*SOLID SECTION, ELSET=BLOCK, MATERIAL=RUBBER\n";
}

std::string boundaryBlock(const Mesh& mesh) {
  std::vector<int> fixed;
  for (Eigen::Index n = 0; n < mesh.nodes_mm.cols(); ++n)
    if (mesh.nodes_mm(2, n) <= 0) fixed.push_back(static_cast<int>(n) + 1);
  return "*NSET, NSET=BOTTOM\n" + wrapped(fixed) + "*BOUNDARY\nBOTTOM, 1, 3\n";
}

std::string loadBlock(const Mesh& mesh, const SensorDesign& design, const LoadCase& load) {
  const Eigen::VectorXd forces = nodalForces(mesh, design, load);
  std::string block = "*CLOAD\n";
  for (Eigen::Index i = 0; i < forces.size(); ++i)
    if (forces(i) != 0)
      block += std::to_string(i / 3 + 1) + ", " + std::to_string(i % 3 + 1) + ", " + text(forces(i)) + "\n";
  return block;
}

} // namespace

std::string calculixDeck(const SensorDesign& design, const Mesh& mesh, const LoadCase& load) {
  if (!(design.material.poissonRatio < 0.5))
    throw DesignError("material.poisson_ratio: 0.5 cannot be written to a deck (D1 would be 0); allowed is below 0.5");
  std::string deck = "*HEADING\nPalp: tactile sensor block, mm N MPa\n" + nodeBlock(mesh) + elementBlock(mesh);
  if (!mesh.upperElectrodeNodes.empty()) {
    std::vector<int> electrodes;
    for (const int node : mesh.upperElectrodeNodes) electrodes.push_back(node + 1);
    deck += "*NSET, NSET=UPPER\n" + wrapped(electrodes);
  }
  deck += materialBlock(design.material) + boundaryBlock(mesh) + "*STEP, NLGEOM, INC=100\n*STATIC\n1., 1.\n" +
          loadBlock(mesh, design, load);
  if (!mesh.upperElectrodeNodes.empty()) deck += "*NODE PRINT, NSET=UPPER\nU\n";
  return deck + "*NODE FILE\nU\n*EL FILE\nS\n*END STEP\n";
}

} // namespace palp
