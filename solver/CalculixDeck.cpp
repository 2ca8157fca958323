#include "solver/CalculixDeck.h"

#include "model/DesignError.h"
#include "model/base/Cancelled.h"
#include "model/base/GotExpected.h"
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

/// A law as CalculiX and Abaqus have it: its name on the keyword line, its constants, and how many powers of (J - 1)^2
/// its volumetric energy has.
struct DeckLaw {
  std::string name;
  std::vector<double> constants;
  int volumeTerms = 1;
};

DeckLaw deckLaw(const MooneyRivlin& law) {
  return {"MOONEY-RIVLIN", {law.c10_MPa, law.c01_MPa}};
}
DeckLaw deckLaw(const NeoHooke& law) {
  return {"NEO HOOKE", {law.c10_MPa}};
}
DeckLaw deckLaw(const Yeoh& law) {
  return {"YEOH", {law.c10_MPa, law.c20_MPa, law.c30_MPa}, 3};
}
DeckLaw deckLaw(const Gent& /*law*/) {
  throw DesignError("material.law: CalculiX and Abaqus do not have this law: " +
                    gotExpected(kRubberLaws.name(RubberLawKind::Gent), "mooney-rivlin, neo-hooke, yeoh or ogden"));
}
DeckLaw deckLaw(const Ogden& law) {
  const int terms = static_cast<int>(law.alpha.size());
  DeckLaw deck{"OGDEN, N=" + std::to_string(terms), {}, terms};
  for (std::size_t k = 0; k < law.alpha.size(); ++k) {
    deck.constants.push_back(law.mu_MPa[k]);
    deck.constants.push_back(law.alpha[k]);
  }
  return deck;
}

/// The keyword with its data lines of at most 8 numbers: the constants, then D = 2 / kappa of (1/D) (J - 1)^2, then a D
/// for each higher power that makes it vanish, as CalculiX replaces 0 by a value of its own.
std::string hyperelastic(const Material& material) {
  constexpr double vanishing = 1e9;
  DeckLaw law = std::visit([](const auto& of) { return deckLaw(of); }, material.law);
  law.constants.push_back(2 * material.compressibility_per_MPa());
  law.constants.insert(law.constants.end(), static_cast<std::size_t>(law.volumeTerms - 1), vanishing);
  std::string lines = "*HYPERELASTIC, " + law.name;
  for (std::size_t k = 0; k < law.constants.size(); ++k)
    lines += (k % 8 == 0 ? "\n" : ", ") + deckNumber(law.constants[k]);
  return lines;
}

} // namespace

std::string calculixDeck(const SensorDesign& design, const Mesh& mesh, const LoadCase& load,
                         const std::stop_token& stop) {
  const Material& m = design.material;
  if (m.compressibility_per_MPa() <= 0)
    throw DesignError("material.poisson_ratio 0.5: a displacement element's deck needs a value below 0.5");
  const std::string law = hyperelastic(m); // throws before the long work
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
  deck += "*MATERIAL, NAME=RUBBER\n" + law + "\n*DENSITY\n" + deckNumber(m.density_t_per_mm3) +
          "\n*SOLID SECTION, ELSET=BLOCK, MATERIAL=RUBBER\n";
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
