#pragma once

#include "model/RowColumnResistance.h"
#include "solver/assembly/SurfaceTraction.h"
#include "solver/batch/ElementwiseTangent.h"
#include "solver/batch/FactorPath.h"
#include "solver/batch/LaneMixing.h"

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <stop_token>

namespace palp {

/// A force on the nodes that share a traction.
struct LaneForce {
  const TractionShares* shares;
  Eigen::Vector3d force_N;
};

/// A force on one node of the mesh.
struct NodeForce {
  int node = 0;
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
};

/// Up to 32 loads, one a lane, iterated together by modified Newton with the tangent at rest:
///
///   r = f_ext - f_int(u, x), condensed;   K0 du = r;   dx = -Kxx^-1 r_x - W du;   u += du, x += dx,
///
/// where x are the elements' own unknowns and W eliminates them (ElementKernels.h). The 32 lanes are four blocks of 8:
/// the elements' kernels take one block at a time, the substitutions all 32, and the factor is read once for all of
/// them:
///
///   lane          0 .. 7    8 .. 15   16 .. 23  24 .. 31
///   block         0         1         2         3           a block begins and ends for itself
///   u, r          [3 nodes][32 lanes]                       for the substitutions
///   x, local      [elements][4 blocks][unknowns][8 lanes]   for the elements, in the order of ElementwiseTangent
///
/// Lanes do not mix: what comes out of one depends on its own load alone, to the last byte.
class LoadBatch {
public:
  static constexpr int blocks = batchLanes / lanes;

  /// What the changes of an iteration are measured on beside the upper electrodes: all that the readings follow.
  struct Watched {
    bool lower = false;       ///< the lower electrodes, relative to the upper ones
    double pressures_MPa = 0; ///< at the upper electrodes, relative to what they are and to this; 0: not
    bool block = false;       ///< all nodes
  };

  LoadBatch(const ElementwiseTangent& model, const PointProbe& upper, const PointProbe& lower)
      : LoadBatch(model, upper, lower, Watched()) {}
  LoadBatch(const ElementwiseTangent& model, const PointProbe& upper, const PointProbe& lower, Watched watched);

  /// A block's lanes at rest, without loads. `inSingle`: the elements' residuals are found in single precision, which
  /// leaves an error of a few times 1e-7 of the answer.
  void reset(int block, bool inSingle = false);
  void addForce(int lane, const LaneForce& force) { forces_[lane].push_back(force); }
  /// A lane whose forces answer to the motion, at rest: its steps are mixed (LaneMixing.h). It begins for itself, in a
  /// block of such lanes; the first of them begins in a block that was reset or has retired.
  void mix(int lane, bool inSingle = false);
  /// Such a lane goes on from where it is to another load. `straight`: which is as much further again in the same
  /// direction, so that it starts as far from here as here is from where the load before began.
  void goOn(int lane, bool straight);
  /// The load of such a lane goes on in another one, of whose own nothing more will be asked.
  void move(int from, int to);
  /// Its forces answer in another way from now on: its steps so far do not foretell the next.
  void turn(int lane) { mixing_->restart(lane); }
  /// Forces that answer to the motion, on nodes; in place of those given before.
  void setNodeForces(int lane, std::vector<NodeForce> forces) { nodeForces_[lane] = std::move(forces); }
  /// Adds polynomials' values to the displacements [3 nodes][terms] and the elements' unknowns
  /// [elements][unknowns][terms] of a block of 8 lanes; monomials [terms][8].
  void addPolynomials(int block, const std::vector<double>& displacements, const std::vector<double>& unknowns,
                      int terms, const double* monomials);

  /// One iteration of the lanes that are active. `change` becomes the largest relative change of what is watched;
  /// negative where elements turned inside out or the numbers are not finite any more.
  /// Stopped on its way, it leaves the lanes unusable.
  void iterate(const std::array<bool, batchLanes>& active, std::array<double, batchLanes>& change,
               const std::stop_token& stop);
  /// The same for loads that answer to the motion. `answer` is given each active lane and the motion [3 x nodes] of
  /// these nodes to which the iteration would lead under the present forces, and gives the forces to go on with (false:
  /// there are none, and the lane's change becomes negative). It is asked between the two ways of the substitution;
  /// `path` is of the nodes' rows, and what is substituted along it comes on top.
  using Answer = std::function<bool(int lane, const Eigen::Matrix3Xd& motion_mm)>;
  void iterate(const std::array<bool, batchLanes>& active, std::array<double, batchLanes>& change,
               std::span<const int> nodes, const FactorPath& path, const Answer& answer, const std::stop_token& stop);

  /// What the electrodes of a block's lanes feel.
  [[nodiscard]] std::vector<ElectrodeDisplacements> electrodes(int block) const;
  [[nodiscard]] Eigen::Matrix3Xd displacementsOf(int lane) const; ///< 3 x nodes
  [[nodiscard]] Eigen::Matrix3Xd displacementsOf(int lane, std::span<const int> nodes) const;
  [[nodiscard]] Eigen::MatrixXd unknownsOf(int lane) const;            ///< of a block that has caught up, x elements
  [[nodiscard]] const LaneVector& displacements() const { return u_; } ///< [3 nodes][32]
  /// The elements' unknowns of a block follow its last iteration: most have no reader before the next, and none at all
  /// where that was the last.
  void catchUp(int block);
  /// Nothing more will be asked of a block before it is reset.
  void retire(int block) { behind_[block] = false; }
  /// The element's own unknown k; of a block that has caught up.
  [[nodiscard]] double unknown(int element, int k, int lane) const {
    return x_[unknownIndex(model_.placeOf(element), k, lane)];
  }

private:
  void evaluateResiduals(const std::array<bool, blocks>& live, const std::stop_token& stop);
  void scaleResiduals(const std::array<bool, batchLanes>& active);
  enum class Direction { Forward, Backward };
  void substitute(Direction direction, FactorPath::Range supernodes, const std::stop_token& stop);
  void substituteAlong(const FactorPath& path, const std::array<bool, batchLanes>& active, std::span<const int> nodes,
                       const Answer& answer, const std::stop_token& stop);
  void answerMotion(const std::array<bool, batchLanes>& active, std::span<const int> nodes, const Answer& answer,
                    std::array<std::vector<NodeForce>, batchLanes>& added);
  void addToRight(int lane, const std::vector<NodeForce>& forces);
  [[nodiscard]] bool isAtRest(int block) const;
  void keepRest(int block, double* values, int count) const;
  void startAnew();
  void startAnew(int place, int block);
  void moveAlongDirections();
  void updateUnknowns(int place, int block);
  /// The upper electrodes, and what else is watched, each with what its changes are relative to.
  struct WatchedValues {
    LaneVector values;
    std::size_t relativeTo = 0; ///< which of them
    double floor = 0;
  };
  [[nodiscard]] std::vector<WatchedValues> watchedNow() const;
  [[nodiscard]] LaneVector displacementsAt(const PointProbe& probe) const; ///< [3 points][32]
  [[nodiscard]] LaneVector pressuresAt(const PointProbe& probe) const;     ///< [points][32], compression positive
  [[nodiscard]] std::size_t unknownIndex(int place, int k, int lane) const {
    return laneIndex(std::size_t(place) * batchLanes + lane, model_.mesh().unknowns(), k);
  }
  /// Of the own unknowns of the element at a place in x_ and local_, for the lanes of a block.
  [[nodiscard]] std::size_t ownStart(int place, int block) const {
    return (std::size_t(place) * blocks + block) * model_.mesh().unknowns() * lanes;
  }

  const ElementwiseTangent& model_;
  const PointProbe &upper_, &lower_;
  Watched watched_;
  std::array<std::vector<LaneForce>, batchLanes> forces_;
  std::array<std::vector<NodeForce>, batchLanes> nodeForces_;
  LaneVector u_, r_;                        ///< [3 nodes][32]
  LaneVector x_, local_;                    ///< [elements][blocks][unknowns][8]
  std::unique_ptr<LaneMixing> mixing_;      ///< of the lanes that ask for it
  FloatLanes uBefore_, xBefore_;            ///< of such lanes, where their load in work began; as u_ and x_
  std::array<LaneStarts, blocks> starts_{}; ///< of the next iteration
  std::array<bool, blocks> begins_{};       ///< one of its lanes does
  FloatLanes solution_;      ///< [rows of the factor + 1][32]; directions over scale_ after the substitutions
  FloatLanes held_;          ///< of the solution along a path, in between
  std::vector<char> probed_; ///< places of elements that an electrode looks at: their unknowns are always up to date
  std::array<bool, batchLanes> atRest_{};
  std::array<bool, blocks> behind_{}, inSingle_{};
  std::array<double, batchLanes> scale_{};
  std::array<double, batchLanes> smallestJ_{};
};

} // namespace palp
