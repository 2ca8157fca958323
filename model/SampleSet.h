#pragma once

#include "model/ResistanceLaw.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace palp {

/// How a set of samples was made; written as comment lines of its file.
struct SampleOrigin {
  std::string designFingerprint;
  std::uint64_t seed = 0;
  std::string areas = "each"; ///< each, together, touches, or the number of one area
  int perArea = 0;            ///< samples on each area (`together` and `touches`: in total)
  std::string mesh;           ///< as text: element, size, elements, nodes
  double solverTolerance = 0; ///< relative, against full Newton
  bool surrogate = false;
  double surrogateError = 0;   ///< relative error against full solves; 0 for full solves
  std::size_t firstSample = 0; ///< index of the first sample within the complete request; above 0 only in shards
  std::optional<Readout> readout = {}; ///< circuit that reads the resistances; none: Eq. (1), which has no circuit
  std::string touches{};               ///< distribution of the indenters, as text; empty where areas are loaded
  bool ofSignals = false; ///< readings other than resistances: of any sign, with differences from rest, not ratios
  std::string madeBy{}; ///< program and instruction set, which decide the last digits; several by "; ". Empty: unknown

  /// Whether another rig measured the samples: `mesh` is kImportedFrom and the name of the table, and the fingerprint
  /// may be that of an import map instead of a design.
  [[nodiscard]] bool imported() const;
};

inline constexpr const char* kImportedFrom = "measured, from ";

/// Rows of SampleSet::touches; SampleSet::secondTouch has the same rows, and three more for the force.
enum TouchRow { kTouchShape, kTouchSize_mm, kTouchFriction, kTouchX_mm, kTouchY_mm, kTouchRows };
inline constexpr int kSecondTouchRows = kTouchRows + 3;

/// Labelled samples; one column per sample. Unknown quantities have no rows, such as the displacements of a real
/// board, or the times of computed samples.
struct SampleSet {
  SampleOrigin origin;
  int rowWires = 0;
  int electrodesPerRowWire = 0;
  int columnWires = 0;
  int areaCount = 0;
  Eigen::VectorXi area;      ///< loaded area of each sample, or the area under the touch; -1 if all are loaded together
  Eigen::MatrixXd times_s;   ///< 1 x samples if another rig measured them, on the clock of that rig
  Eigen::MatrixXd runs;      ///< 1 x samples if they belong to several runs: number of the run, from 0
  Eigen::MatrixXd touches;   ///< kTouchRows x samples if indenters press, by TouchRow; else no rows
  Eigen::MatrixXd places_mm; ///< 2 x samples if another rig measured them: x, y of the touch from the block's corner
  Eigen::MatrixXd forces_N;  ///< 3 x samples; `together`: (3 areas) x samples
  Eigen::MatrixXd
      secondTouch; ///< kSecondTouchRows x samples if two touches press together: the second touch and its force
  Eigen::MatrixXd displacements_mm; ///< (3 electrodes row-wires) x samples; row 3 (r E + e) + d
  Eigen::MatrixXd resistances_ohm;  ///< (row-wires column-wires) x samples; row r C + c. With origin.ofSignals: signals

  [[nodiscard]] Eigen::Index size() const { return forces_N.cols(); }
  [[nodiscard]] bool hasTouches() const { return touches.rows() > 0; }
  [[nodiscard]] bool hasPlaces() const { return hasTouches() || places_mm.rows() > 0; }
  /// Returns x, y of each touch [mm], randomly drawn or measured: 2 x samples; requires hasPlaces().
  [[nodiscard]] Eigen::Matrix2Xd touchedPlaces_mm() const;
  [[nodiscard]] bool together() const { return forces_N.rows() != 3 || (size() > 0 && area(0) < 0); }
};

/// The matrices of a set with a column per sample, in the order of the columns of its file.
inline constexpr std::array kSampleParts{
    &SampleSet::times_s,  &SampleSet::runs,        &SampleSet::touches,          &SampleSet::places_mm,
    &SampleSet::forces_N, &SampleSet::secondTouch, &SampleSet::displacements_mm, &SampleSet::resistances_ohm};

/// Returns why two sets cannot share one file (different design, seed, mesh or kind); empty if they can. The first
/// sample of a shard does not count as a difference.
std::string difference(const SampleOrigin& a, const SampleOrigin& b);

/// Returns SampleOrigin::madeBy for two sets that are joined: each entry of both lists once.
std::string joinedMakers(const std::string& a, const std::string& b);

/// Returns the chosen samples only, in the given order.
SampleSet samplesAt(const SampleSet& set, const std::vector<Eigen::Index>& chosen);

/// Returns the samples on one area only.
SampleSet areaPart(const SampleSet& set, int area);

/// Appends the samples of `block`, which may be `set` itself, to `set`; an empty `set` becomes the block.
void append(SampleSet& set, const SampleSet& block);

} // namespace palp
