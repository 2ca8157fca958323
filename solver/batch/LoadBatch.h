#pragma once

#include "model/RowColumnResistance.h"
#include "solver/assembly/SurfaceTraction.h"
#include "solver/batch/ElementwiseTangent.h"

#include <array>
#include <stop_token>

namespace palp {

/// A force on the nodes that share a traction.
struct LaneForce {
  const TractionShares* shares;
  Eigen::Vector3d force_N;
};

/// Up to 32 loads, one a lane, iterated together by modified Newton with the tangent at rest. Lanes do not mix: what
/// comes out of one depends on its own load alone, to the last byte.
class LoadBatch {
public:
  static constexpr int blocks = batchLanes / lanes;

  LoadBatch(const ElementwiseTangent& model, const PointProbe& upper);

  /// All lanes at rest, without loads.
  void reset();
  void addForce(int lane, const LaneForce& force) { forces_[lane].push_back(force); }
  /// Adds polynomials' values to the displacements [3 nodes][terms] and the elements' unknowns
  /// [elements][unknowns][terms] of a block of 8 lanes; monomials [terms][8].
  void addPolynomials(int block, const std::vector<double>& displacements, const std::vector<double>& unknowns,
                      int terms, const double* monomials);

  /// One iteration of the lanes that are active. `change` becomes the relative change of the upper electrodes'
  /// displacements; negative where elements turned inside out or the lane is beyond hope.
  /// Stopped on its way, it leaves the lanes unusable.
  void iterate(const std::array<bool, batchLanes>& active, std::array<double, batchLanes>& change,
               const std::stop_token& stop);

  /// What the electrodes of all lanes feel.
  [[nodiscard]] std::vector<ElectrodeDisplacements> electrodes(const PointProbe& lower) const;
  /// The lane's state.
  [[nodiscard]] ElementState state(int lane) const;
  [[nodiscard]] const LaneVector& displacements() const { return u_; } ///< [3 nodes][32]
  [[nodiscard]] const LaneVector& unknowns() const { return x_; }      ///< [elements][blocks][unknowns][8]

private:
  void evaluateResiduals(const std::array<bool, blocks>& live, const std::stop_token& stop);
  void solveDirections(const std::array<bool, batchLanes>& active, const std::stop_token& stop);
  void update(const std::array<bool, blocks>& live, const std::stop_token& stop);
  [[nodiscard]] LaneVector displacementsAt(const PointProbe& probe) const; ///< [3 points][32]
  [[nodiscard]] LaneVector pressuresAt(const PointProbe& probe) const;     ///< [points][32], compression positive
  [[nodiscard]] double unknown(int element, int k, int lane) const {
    return x_[((std::size_t(element) * blocks + lane / lanes) * model_.mesh().unknowns() + k) * lanes + lane % lanes];
  }

  const ElementwiseTangent& model_;
  const PointProbe& upper_;
  std::array<std::vector<LaneForce>, batchLanes> forces_;
  LaneVector u_, r_;            ///< [3 nodes][32]
  LaneVector x_, local_;        ///< [elements][blocks][unknowns][8]
  std::vector<float> solution_; ///< [places][32]
  bool atRest_ = true;
  std::array<double, batchLanes> scale_{};
  std::array<double, batchLanes> smallestJ_{};
};

} // namespace palp
