#include "solver/contact/ContactDeck.h"

#include "model/base/NumberText.h"
#include "solver/contact/ContactEstimate.h"
#include "solver/contact/ContactPoints.h"
#include "solver/contact/IndenterSurface.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <vector>

namespace palp {

std::string deckNumber(double value) {
  return withDigits(value, 13);
}

namespace {

// Of the contact's pressure per overlap [MPa/mm] and of the friction's per slip, in shear moduli over the height: the
// overlap is about a thousandth of a touch's depth.
constexpr double pressureStiffness = 5000;
constexpr double stickStiffness = 500;
constexpr double layerShare = 0.2; // thickness of an indenter's wedges, in heights of the block
constexpr double indenterModulus_MPa = 1000;

std::string named(const char* what, std::size_t indenter) {
  return what + std::to_string(indenter + 1);
}

/// Which of an element's faces, counted from 1 as CalculiX does, each top face is.
struct ElementFace {
  int element = 0, face = 0;
};
std::vector<ElementFace> elementsOfTopFaces(const Mesh& mesh) {
  static constexpr std::array<std::array<int, 3>, 4> ofTet{{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
  static constexpr std::array<std::array<int, 4>, 6> ofHex{
      {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}}};
  std::map<std::vector<int>, int> wanted; // by its corners
  const bool tets = mesh.shape == ElementShape::Tetrahedron10;
  for (Eigen::Index f = 0; f < mesh.topFaces.cols(); ++f) {
    std::vector<int> corners(mesh.topFaces.col(f).data(), mesh.topFaces.col(f).data() + (tets ? 3 : 4));
    std::sort(corners.begin(), corners.end());
    wanted[corners] = static_cast<int>(f);
  }
  std::vector<ElementFace> found(static_cast<std::size_t>(mesh.topFaces.cols()));
  const auto look = [&](int e, int face, const auto& local) {
    std::vector<int> corners;
    for (const int n : local) corners.push_back(mesh.elements(n, e));
    std::sort(corners.begin(), corners.end());
    if (const auto at = wanted.find(corners); at != wanted.end())
      found[static_cast<std::size_t>(at->second)] = {e + 1, face + 1};
  };
  for (int e = 0; e < mesh.elementCount(); ++e)
    if (tets)
      for (std::size_t k = 0; k < ofTet.size(); ++k) look(e, static_cast<int>(k), ofTet[k]);
    else
      for (std::size_t k = 0; k < ofHex.size(); ++k) look(e, static_cast<int>(k), ofHex[k]);
  return found;
}

/// The indenter nearest to the middle of each top face.
std::vector<std::size_t> nearestIndenters(const Mesh& mesh, const std::vector<Indenter>& indenters) {
  std::vector<std::size_t> nearest;
  for (Eigen::Index f = 0; f < mesh.topFaces.cols(); ++f) {
    const Eigen::Vector3d middle = (mesh.nodes_mm.col(mesh.topFaces(0, f)) + mesh.nodes_mm.col(mesh.topFaces(1, f)) +
                                    mesh.nodes_mm.col(mesh.topFaces(2, f))) /
                                   3;
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < indenters.size(); ++k) {
      const double gap = distance(indenters[k], middle - tipAtRest_mm(indenters[k], mesh)).gap_mm;
      if (gap < least) {
        least = gap;
        best = k;
      }
    }
    nearest.push_back(best);
  }
  return nearest;
}

/// Nodes, wedges and master surface of an indenter; counts go on from those given.
void writeIndenter(std::size_t k, const IndenterSurface& surface, const Eigen::Vector3d& tip_mm, double layer_mm,
                   int& nodes, int& elements, std::string& deck) {
  const int first = nodes + 1, points = static_cast<int>(surface.points_mm.cols());
  deck += "*NODE, NSET=" + named("INDENTER", k) + "\n";
  for (const double up : {0., layer_mm})
    for (int p = 0; p < points; ++p) {
      const Eigen::Vector3d at = tip_mm + surface.points_mm.col(p) + up * Eigen::Vector3d::UnitZ();
      deck += std::to_string(++nodes) + ", " + deckNumber(at.x()) + ", " + deckNumber(at.y()) + ", " +
              deckNumber(at.z()) + "\n";
    }
  deck += "*NODE, NSET=" + named("REFERENCE", k) + "\n" + std::to_string(++nodes) + ", " + deckNumber(tip_mm.x()) +
          ", " + deckNumber(tip_mm.y()) + ", " + deckNumber(tip_mm.z() + layer_mm) + "\n";
  const int firstElement = elements + 1;
  deck += "*ELEMENT, TYPE=C3D6, ELSET=" + named("INDENTER", k) + "\n";
  for (const auto& triangle : surface.triangles) {
    deck += std::to_string(++elements);
    for (const int up : {0, points})
      for (const int p : triangle) deck += ", " + std::to_string(first + up + p);
    deck += "\n";
  }
  deck += "*SURFACE, NAME=" + named("MASTER", k) + ", TYPE=ELEMENT\n";
  for (int e = firstElement; e <= elements; ++e) deck += std::to_string(e) + ", S1\n";
  for (int n = first; n < nodes; ++n)
    for (int d = 1; d <= 3; ++d)
      deck += "*EQUATION\n2\n" + std::to_string(n) + ", " + std::to_string(d) + ", 1., " + std::to_string(nodes) +
              ", " + std::to_string(d) + ", -1.\n";
  deck += "*SOLID SECTION, ELSET=" + named("INDENTER", k) + ", MATERIAL=INDENTER\n";
}

void writePair(std::size_t k, const Indenter& indenter, double modulusOverHeight, std::string& deck) {
  const std::string contact = named("CONTACT", k);
  deck += "*SURFACE INTERACTION, NAME=" + contact + "\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n" +
          deckNumber(pressureStiffness * modulusOverHeight) + "\n";
  if (indenter.friction > 0)
    deck +=
        "*FRICTION\n" + deckNumber(indenter.friction) + ", " + deckNumber(stickStiffness * modulusOverHeight) + "\n";
  deck += "*CONTACT PAIR, INTERACTION=" + contact + ", TYPE=SURFACE TO SURFACE\n" + named("SLAVE", k) + ", " +
          named("MASTER", k) + "\n";
}

/// "REFERENCE1, 3, 3, -0.2".
std::string prescribed(std::size_t k, int direction, double value_mm) {
  const std::string d = std::to_string(direction);
  return named("REFERENCE", k) + ", " + d + ", " + d + ", " + deckNumber(value_mm) + "\n";
}

std::string pushed(std::size_t k, int direction, double force_N) {
  return named("REFERENCE", k) + ", " + std::to_string(direction) + ", " + deckNumber(force_N) + "\n";
}

/// What holds the indenters: all of them, or where a force is given only those directions that nothing else holds.
std::string holds(const std::vector<Indenter>& indenters, const SensorDesign& design, bool byForces, bool aside) {
  std::string lines;
  for (std::size_t k = 0; k < indenters.size(); ++k) {
    const Indenter& indenter = indenters[k];
    const Motion* motion = indenter.motion();
    const bool held = motion || indenter.friction == 0 || !byForces;
    const Eigen::Vector2d shift_mm = motion && aside ? motion->shift_mm : Eigen::Vector2d(0, 0);
    if (held)
      for (const int d : {1, 2}) lines += prescribed(k, d, shift_mm(d - 1));
    if (motion)
      lines += prescribed(k, 3, -motion->depth_mm);
    else if (!byForces)
      lines += prescribed(k, 3, -contactEstimate(indenter, design).depth_mm);
  }
  return lines;
}

std::string forces(const std::vector<Indenter>& indenters, bool aside) {
  std::string lines;
  for (std::size_t k = 0; k < indenters.size(); ++k)
    if (const Press* press = indenters[k].press()) {
      if (aside)
        for (const int d : {1, 2}) lines += pushed(k, d, press->force_N(d - 1));
      else
        lines += pushed(k, 3, press->force_N.z());
    }
  return lines;
}

std::string stepOf(const char* increments, const std::string& conditions, const std::string& output) {
  return std::string("*STEP, NLGEOM, INC=1000\n*STATIC\n") + increments + "\n" + conditions + output + "*END STEP\n";
}

} // namespace

ContactDeck contactDeck(const SensorDesign& design, const Mesh& mesh, const LoadCase& load, const std::string& clamps,
                        const std::string& loads, const std::string& output) {
  const std::vector<Indenter>& indenters = load.indenters;
  const double height_mm = design.block_mm.z(), modulusOverHeight = design.material.shearModulus_MPa() / height_mm;
  ContactDeck deck;
  int nodes = mesh.nodeCount(), elements = mesh.elementCount();
  deck.model = "*MATERIAL, NAME=INDENTER\n*ELASTIC\n" + deckNumber(indenterModulus_MPa) + ", 0.3\n";
  const std::vector<ElementFace> faces = elementsOfTopFaces(mesh);
  const std::vector<std::size_t> nearest = nearestIndenters(mesh, indenters);
  for (std::size_t k = 0; k < indenters.size(); ++k) {
    writeIndenter(k, indenterSurface(indenters[k], design), tipAtRest_mm(indenters[k], mesh), layerShare * height_mm,
                  nodes, elements, deck.model);
    deck.model += "*SURFACE, NAME=" + named("SLAVE", k) + ", TYPE=ELEMENT\n";
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (nearest[f] == k)
        deck.model += std::to_string(faces[f].element) + ", S" + std::to_string(faces[f].face) + "\n";
    writePair(k, indenters[k], modulusOverHeight, deck.model);
  }
  const auto any = [&](auto is) { return std::any_of(indenters.begin(), indenters.end(), is); };
  const bool pressed = any([](const Indenter& i) { return i.press() != nullptr; });
  const bool aside = any([](const Indenter& i) {
    return i.press() ? !i.press()->force_N.head<2>().isZero(0) : !i.motion()->shift_mm.isZero(0);
  });
  const std::string nodal = loads.empty() ? "" : "*CLOAD\n" + loads;
  deck.steps = stepOf("0.2, 1.", "*BOUNDARY\n" + holds(indenters, design, false, false) + nodal, output);
  if (pressed) {
    deck.model += "*AMPLITUDE, NAME=AT_ONCE\n0., 1., 1., 1.\n";
    deck.steps += stepOf("1., 1.",
                         "*BOUNDARY, OP=NEW\n" + clamps + holds(indenters, design, true, false) +
                             "*CLOAD, AMPLITUDE=AT_ONCE\n" + forces(indenters, false),
                         output);
  }
  if (aside) {
    const std::string sideways = forces(indenters, true);
    deck.steps += stepOf("0.2, 1.",
                         "*BOUNDARY, OP=NEW\n" + clamps + holds(indenters, design, true, true) +
                             (sideways.empty() ? "" : "*CLOAD\n" + sideways),
                         output);
  }
  return deck;
}

} // namespace palp
