#pragma once

#include "model/RowColumnResistance.h"
#include "solver/assembly/SurfaceTraction.h"
#include "solver/batch/AndersonBatch.h"
#include "solver/batch/ElementwiseTangent.h"
#include "solver/batch/FactorPath.h"

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <stop_token>

namespace palp {

/// A force distributed over the nodes of a traction.
struct TractionForce {
  const TractionShares* shares;
  Eigen::Vector3d force_N;
};

/// A force on one node of the mesh.
struct NodeForce {
  int node = 0;
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
};

/// Up to 32 loads, one per column, iterated together by modified Newton with the tangent at rest:
///
///   r = f_ext - f_int(u, x), condensed;   K0 du = r;   dx = -Kxx^-1 r_x - W du;   u += du, x += dx,
///
/// where x are the elements' internal unknowns and W eliminates them (ElementKernels.h). Why: the factor, the largest
/// array, is read once per iteration for all loads, and the kernels use full SIMD registers. The 32 columns are four
/// blocks of 8 SIMD lanes: the elements' kernels take one block at a time, the substitutions all 32:
///
///   column        0 .. 7    8 .. 15   16 .. 23  24 .. 31
///   block         0         1         2         3           blocks start and finish independently
///   u, r          [3 nodes][32 columns]                     for the substitutions
///   x, local      [elements][4 blocks][unknowns][8 lanes]   for the elements, in the order of ElementwiseTangent
///
/// Columns are independent: the result of one depends on its own load alone, to the last byte.
///
/// States of a block, and the calls between them:
///   empty -- reset --> at rest -- addForce, addPolynomials --> ready -- iterate ... --> stale -- updateInternal -->
///   current
/// After `iterate` the displacements are current, but the internal unknowns are stale until the next iteration or
/// updateInternal; `finish` drops that update where nobody reads them. A column with contact forces starts with `mix`
/// instead of `reset`, and starts its next load increment with continueWith.
/// Where to read more: resources/docs/numerics/many-loads.md.
class LoadBatch {
public:
  static constexpr int blocks = batchColumns / lanes;

  /// Quantities that the change of an iteration is measured on, in addition to the upper electrodes: those that the
  /// readings depend on.
  struct Watched {
    bool lower = false;       ///< the lower electrodes, relative to the upper ones
    double pressures_MPa = 0; ///< at the upper electrodes, relative to their size and to this; 0: not measured
    bool block = false;       ///< all nodes
  };

  LoadBatch(const ElementwiseTangent& model, const PointProbe& upper, const PointProbe& lower)
      : LoadBatch(model, upper, lower, Watched()) {}
  LoadBatch(const ElementwiseTangent& model, const PointProbe& upper, const PointProbe& lower, Watched watched);

  /// Sets a block's columns to rest, without loads. `inSingle`: the elements' residuals are computed in single
  /// precision, with a relative error of a few times 1e-7 in the answer.
  void reset(int block, bool inSingle = false);
  void addForce(int column, const TractionForce& force) { forces_[column].push_back(force); }
  /// Starts a load whose contact forces depend on the displacement, at rest; its iteration uses Anderson mixing
  /// (AndersonBatch.h). Such columns start independently in a block of their own, which was reset or finished.
  void mix(int column, bool inSingle = false);
  /// Continues such a column from its current state with the next load increment. `extrapolate`: the increment equals
  /// the previous one, so the state is moved by the previous increment's displacement once more.
  void continueWith(int column, bool extrapolate);
  /// Moves the load of such a column to another column, whose load is discarded.
  void move(int from, int to);
  /// Discards the column's mixing history, because the contact mode changed.
  void resetHistory(int column) { mixing_->restart(column); }
  /// Sets the contact forces on nodes, in place of the previous ones.
  void setNodeForces(int column, std::vector<NodeForce> forces) { nodeForces_[column] = std::move(forces); }
  /// Adds polynomials' values to the displacements [3 nodes][terms] and the elements' unknowns
  /// [elements][unknowns][terms] of a block; monomials [terms][8].
  void addPolynomials(int block, const std::vector<double>& displacements, const std::vector<double>& unknowns,
                      int terms, const double* monomials);

  /// Does one iteration of the active columns. `change` becomes the largest relative change of the watched quantities,
  /// or negative where elements turned inside out or values are not finite. If cancelled, the columns are unusable.
  void iterate(const std::array<bool, batchColumns>& active, std::array<double, batchColumns>& change,
               const std::stop_token& stop);
  /// The same with contact. `answer` is called between forward and backward sweep for each active column with the
  /// predicted motion [3 x nodes] of `nodes` under the present forces; it sets the column's node forces, or returns
  /// false if there is no contact equilibrium (the column's change becomes negative). `path` is the part of the factor
  /// that the nodes' rows depend on; the change of the forces is substituted along it and added.
  using Answer = std::function<bool(int column, const Eigen::Matrix3Xd& motion_mm)>;
  void iterate(const std::array<bool, batchColumns>& active, std::array<double, batchColumns>& change,
               std::span<const int> nodes, const FactorPath& path, const Answer& answer, const std::stop_token& stop);

  /// Displacements and pressures at the electrodes, for each column of a block.
  [[nodiscard]] std::vector<ElectrodeDisplacements> electrodes(int block) const;
  [[nodiscard]] Eigen::Matrix3Xd displacementsOf(int column) const; ///< 3 x nodes
  [[nodiscard]] Eigen::Matrix3Xd displacementsOf(int column, std::span<const int> nodes) const;
  [[nodiscard]] Eigen::MatrixXd unknownsOf(int column) const;          ///< unknowns x elements; after updateInternal
  [[nodiscard]] const LaneVector& displacements() const { return u_; } ///< [3 nodes][32]
  /// Updates the internal unknowns of a block after its last iteration. This is lazy: the next iteration does it for
  /// most elements at no cost, and after the last one they often have no reader.
  void updateInternal(int block);
  /// Ends a block: it is not read before the next reset or mix.
  void finish(int block) { stale_[block] = false; }
  /// Internal unknown k of an element; after updateInternal.
  [[nodiscard]] double unknown(int element, int k, int column) const {
    return x_[unknownIndex(model_.placeOf(element), k, column)];
  }

private:
  void evaluateResiduals(const std::array<bool, blocks>& live, const std::stop_token& stop);
  void scaleResiduals(const std::array<bool, batchColumns>& active);
  enum class Direction { Forward, Backward };
  void substitute(Direction direction, FactorPath::Range supernodes, const std::stop_token& stop);
  void substituteAlong(const FactorPath& path, const std::array<bool, batchColumns>& active, std::span<const int> nodes,
                       const Answer& answer, const std::stop_token& stop);
  void answerMotion(const std::array<bool, batchColumns>& active, std::span<const int> nodes, const Answer& answer,
                    std::array<std::vector<NodeForce>, batchColumns>& added);
  void addToRight(int column, const std::vector<NodeForce>& forces);
  [[nodiscard]] bool isAtRest(int block) const;
  void zeroAtRest(int block, double* values, int count) const;
  void beginLoads();
  void beginLoads(int place, int block);
  void moveAlongDirections();
  void updateUnknowns(int place, int block);
  /// Values of a watched quantity and the quantity that its changes are relative to.
  struct WatchedValues {
    LaneVector values;
    std::size_t relativeTo = 0; ///< which of them
    double floor = 0;
  };
  [[nodiscard]] std::vector<WatchedValues> watchedNow() const;
  [[nodiscard]] LaneVector displacementsAt(const PointProbe& probe) const; ///< [3 points][32]
  [[nodiscard]] LaneVector pressuresAt(const PointProbe& probe) const;     ///< [points][32], compression positive
  [[nodiscard]] std::size_t unknownIndex(int place, int k, int column) const {
    return laneIndex(std::size_t(place) * batchColumns + column, model_.mesh().unknowns(), k);
  }
  /// Start of the internal unknowns of the element at a place in x_ and local_, for the columns of a block.
  [[nodiscard]] std::size_t ownStart(int place, int block) const {
    return (std::size_t(place) * blocks + block) * model_.mesh().unknowns() * lanes;
  }

  const ElementwiseTangent& model_;
  const PointProbe &upper_, &lower_;
  Watched watched_;
  std::array<std::vector<TractionForce>, batchColumns> forces_;
  std::array<std::vector<NodeForce>, batchColumns> nodeForces_;
  LaneVector u_, r_;                      ///< [3 nodes][32]
  LaneVector x_, local_;                  ///< [elements][blocks][unknowns][8]
  std::unique_ptr<AndersonBatch> mixing_; ///< of the columns started with `mix`
  FloatLanes uBefore_, xBefore_;          ///< state of such columns at the start of the present increment; as u_ and x_
  std::array<InitialGuess, blocks> guesses_{}; ///< of the next iteration
  std::array<bool, blocks> begins_{};          ///< whether a column of the block starts an increment
  FloatLanes solution_;      ///< [rows of the factor + 1][32]; directions over scale_ after the substitutions
  FloatLanes saved_;         ///< the solution's rows along a path, meanwhile
  std::vector<char> probed_; ///< by place: elements that contain an electrode, whose unknowns are always current
  std::array<bool, batchColumns> atRest_{};
  std::array<bool, blocks> stale_{}, inSingle_{};
  std::array<double, batchColumns> scale_{};
  std::array<double, batchColumns> smallestJ_{};
};

} // namespace palp
