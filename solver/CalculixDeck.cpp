#include "solver/CalculixDeck.h"

#include "model/DesignError.h"
#include "model/base/Cancelled.h"
#include "solver/assembly/Discretisation.h"
#include "solver/assembly/SurfaceTraction.h"
#include "solver/contact/ContactDeck.h"

namespace palp {

namespace {

/// A keyword's data lines hold at most 16 entries; all of ours but C3D10's 11 hold fewer.
void writeElements(const Mesh& mesh, const std::stop_token& stop, std::string& deck) {
  deck += std::string("*ELEMENT, TYPE=") + (mesh.shape == ElementShape::Tetrahedron10 ? "C3D10" : "C3D8") +
          ", ELSET=BLOCK\n";
  for (int e = 0; e < mesh.elementCount(); ++e) {
    throwIfStopped(stop);
    deck += std::to_string(e + 1);
    for (Eigen::Index n = 0; n < mesh.elements.rows(); ++n) deck += ", " + std::to_string(mesh.elements(n, e) + 1);
    deck += "\n";
  }
}

void writeNodeSet(const std::string& name, const std::vector<int>& nodes, std::string& deck) {
  deck += "*NSET, NSET=" + name + "\n";
  for (int n : nodes) deck += std::to_string(n + 1) + ",\n";
}

} // namespace

std::string calculixDeck(const SensorDesign& design, const Mesh& mesh, const LoadCase& load,
                         const std::stop_token& stop) {
  const Material& m = design.material;
  if (m.compressibility_per_MPa() <= 0)
    throw DesignError("material.poisson_ratio 0.5: a displacement element's deck needs a value below 0.5");
  const Eigen::VectorXd forces = nodalForces(mesh, design, load);
  std::string deck = "*HEADING\nBlock of a tactile sensor [mm, N, MPa]\n*NODE, NSET=ALL\n";
  for (int n = 0; n < mesh.nodeCount(); ++n) {
    throwIfStopped(stop);
    deck += std::to_string(n + 1) + ", " + deckNumber(mesh.nodes_mm(0, n)) + ", " + deckNumber(mesh.nodes_mm(1, n)) +
            ", " + deckNumber(mesh.nodes_mm(2, n)) + "\n";
  }
  writeElements(mesh, stop, deck);
  const FixedComponents fixed = clampedBottom(mesh);
  std::vector<int> bottom;
  for (int n = 0; n < mesh.nodeCount(); ++n)
    if (fixed[3 * static_cast<std::size_t>(n)]) bottom.push_back(n);
  writeNodeSet("BOTTOM", bottom, deck);
  if (!mesh.upperElectrodeNodes.empty()) writeNodeSet("UPPER_ELECTRODES", mesh.upperElectrodeNodes, deck);
  // d = 2 / kappa: W = ... + (1/d) (J - 1)^2.
  deck += "*MATERIAL, NAME=RUBBER\n*HYPERELASTIC, MOONEY-RIVLIN\n" + deckNumber(m.c10_MPa) + ", " +
          deckNumber(m.c01_MPa) + ", " + deckNumber(2 * m.compressibility_per_MPa()) + "\n*DENSITY\n" +
          deckNumber(m.density_t_per_mm3) + "\n*SOLID SECTION, ELSET=BLOCK, MATERIAL=RUBBER\n";
  const std::string clamps = "BOTTOM, 1, 3\n";
  std::string loads;
  for (int n = 0; n < mesh.nodeCount(); ++n)
    for (int d = 0; d < 3; ++d)
      if (const double f = forces(3 * n + d); f != 0)
        loads += std::to_string(n + 1) + ", " + std::to_string(d + 1) + ", " + deckNumber(f) + "\n";
  const std::string set = mesh.upperElectrodeNodes.empty() ? "ALL" : "UPPER_ELECTRODES";
  const std::string output = "*NODE FILE\nU\n*EL FILE\nS\n*NODE PRINT, NSET=" + set + "\nU\n";
  if (load.indenters.empty())
    return deck + "*BOUNDARY\n" + clamps + "*STEP, NLGEOM, INC=1000\n*STATIC\n1., 1.\n*CLOAD\n" + loads + output +
           "*END STEP\n";
  // The clamped face carries what the indenters press with.
  const ContactDeck contact =
      contactDeck(design, mesh, load, clamps, loads, output + "*NODE PRINT, NSET=BOTTOM, TOTALS=ONLY\nRF\n");
  return deck + contact.model + "*BOUNDARY\n" + clamps + contact.steps;
}

} // namespace palp
