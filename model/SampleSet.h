#pragma once

#include "model/ResistanceLaw.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace palp {

/// How a set of samples was made; written as comment lines of its file.
struct SampleOrigin {
  std::string designFingerprint;
  std::uint64_t seed = 0;
  std::string areas = "each"; ///< each, together, touches, or the number of one area
  int perArea = 0;            ///< samples on each area (`together` and `touches`: in total)
  std::string mesh;           ///< in words: element, size, elements, nodes
  double solverTolerance = 0; ///< relative, against full Newton
  bool surrogate = false;
  double surrogateError = 0;           ///< relative error against full solves; 0 for full solves
  std::size_t firstSample = 0;         ///< index of the first sample within the whole request; above 0 only in shards
  std::optional<Readout> readout = {}; ///< that the resistances are of; none: by Eq. (1), where wires do not meet
  std::string touches{};               ///< what indenters were drawn from, in words; empty where areas are loaded
};

/// Rows of SampleSet::touches.
enum TouchRow { kTouchShape, kTouchSize_mm, kTouchFriction, kTouchX_mm, kTouchY_mm, kTouchRows };

/// Labelled samples; one column per sample. Displacements or resistances have no rows if they are not known (frames of
/// a real board).
struct SampleSet {
  SampleOrigin origin;
  int rowWires = 0;
  int electrodesPerRowWire = 0;
  int columnWires = 0;
  int areaCount = 0;
  Eigen::VectorXi area;     ///< loaded area of each sample, or that under the touch; -1 if all are loaded together
  Eigen::MatrixXd touches;  ///< kTouchRows x samples where indenters press, by TouchRow; else no rows
  Eigen::MatrixXd forces_N; ///< 3 x samples; `together`: (3 areas) x samples
  Eigen::MatrixXd displacements_mm; ///< (3 electrodes row-wires) x samples; row 3 (r E + e) + d
  Eigen::MatrixXd resistances_ohm;  ///< (row-wires column-wires) x samples; row r C + c

  [[nodiscard]] Eigen::Index size() const { return forces_N.cols(); }
  [[nodiscard]] bool hasTouches() const { return touches.rows() > 0; }
  [[nodiscard]] bool together() const { return forces_N.rows() != 3 || (size() > 0 && area(0) < 0); }
};

/// Why two sets cannot share one file (different design, seed, mesh or kind); empty if they can. The first sample of a
/// shard does not count as a difference.
std::string difference(const SampleOrigin& a, const SampleOrigin& b);

/// Only the samples on one area.
SampleSet areaPart(const SampleSet& set, int area);

/// Appends the samples of `block` to `set`; an empty `set` becomes the block.
void append(SampleSet& set, const SampleSet& block);

} // namespace palp
