#pragma once

#include "model/ResistanceLaw.h"

#include <Eigen/Core>

namespace palp {

/// Which electrodes each wire joins, in the order of a design: the row-wires' electrodes wire by wire, then those of
/// the column-wires. Wires are counted in the same order.
struct WireCounts {
  int rowWires = 0;
  int electrodesPerRowWire = 0;
  int columnWires = 0;
  int electrodesPerColumnWire = 0;

  [[nodiscard]] int wires() const { return rowWires + columnWires; }
  [[nodiscard]] int electrodes() const {
    return rowWires * electrodesPerRowWire + columnWires * electrodesPerColumnWire;
  }
  /// Adds up the rows of a matrix that has one for each electrode: B' x, wires x columns.
  [[nodiscard]] Eigen::MatrixXd sumsByWire(const Eigen::Ref<const Eigen::MatrixXd>& electrodes) const;
  /// What each electrode has of its wire: B x.
  [[nodiscard]] Eigen::VectorXd atElectrodes(const Eigen::Ref<const Eigen::VectorXd>& wires) const;
};

/// The block as its wires see it. With V = P I + const, sum I = 0 between the electrodes and one potential v for all of
/// a wire (V = B v):
///   Q = M B,  M = P^-1 - P^-1 1 1' P^-1 / (1' P^-1 1),   Y = B' Q,   with a resistance r in each wire (1 + Y r)^-1 Y.
class TerminalNetwork {
public:
  /// `potentials_ohm`: P, symmetric, positive definite but for a constant. Throws DesignError where it is not.
  TerminalNetwork(const Eigen::Ref<const Eigen::MatrixXd>& potentials_ohm, const WireCounts& counts, double wire_ohm);

  [[nodiscard]] const WireCounts& counts() const { return counts_; }
  /// Q [1/ohm], electrodes x wires: the electrodes' currents at 1 V on one wire, the wires themselves without
  /// resistance.
  [[nodiscard]] const Eigen::MatrixXd& currents() const { return currents_; }
  /// Y [1/ohm], wires x wires, symmetric with rows that sum to 0: currents into the wires at their potentials.
  [[nodiscard]] const Eigen::MatrixXd& conductances() const { return conductances_; }
  /// W = (1 + r Y)^-1, wires x wires, of the wires in the block alone: the share of terminal potentials that remains
  /// there.
  [[nodiscard]] const Eigen::MatrixXd& inBlock() const { return inBlock_; }
  /// dY [1/ohm] = - W Q' dP Q W, from Q' dP Q (wires x wires).
  [[nodiscard]] Eigen::MatrixXd change(const Eigen::Ref<const Eigen::MatrixXd>& currentsTimesChange) const;

private:
  WireCounts counts_;
  Eigen::MatrixXd currents_, conductances_, inBlock_;
};

/// What a read-out makes of a network: the resistances, and how they follow the network.
class NetworkReading {
public:
  NetworkReading(const TerminalNetwork& network, Readout readout);

  /// Row-wires x column-wires [ohm].
  [[nodiscard]] const Eigen::MatrixXd& resistances_ohm() const { return resistances_ohm_; }
  /// The terminals' potentials while this resistance is read, in some unit and from some zero.
  [[nodiscard]] Eigen::VectorXd potentials(int rowWire, int columnWire) const {
    return drive_.col(rowWire + rows_ * columnWire);
  }
  /// d ln R, row-wires x column-wires, for a small change of the conductances Y (symmetric): d ln R = - s a' dY b, with
  /// b the wires' potentials while R is read, a those that the theorem of adjoint networks belongs to and s a number
  /// (L. O. Chua, P.-M. Lin, Computer-Aided Analysis of Electronic Circuits, 1975, chapter 15).
  [[nodiscard]] Eigen::MatrixXd logChange(const Eigen::Ref<const Eigen::MatrixXd>& conductanceChange) const;

  /// Potentials of the wires' ends while each cell is read, wires x readings (reading row + rows * column), between the
  /// two wires not 1 V for every read-out.
  [[nodiscard]] const Eigen::MatrixXd& drive() const { return drive_; }

private:
  void readFloating(const Eigen::MatrixXd& y);
  void readVirtualGround(const Eigen::MatrixXd& y);
  void readRowsGrounded(const Eigen::MatrixXd& y);
  void readOthersAtHalf(const Eigen::MatrixXd& y);
  void setPotentials(Eigen::Index cell, const Eigen::VectorXd& adjoint, const Eigen::VectorXd& drive);

  Eigen::Index rows_, columns_;
  Eigen::MatrixXd resistances_ohm_;
  Eigen::MatrixXd adjoint_, drive_; ///< wires x readings, scaled; reading row + rows * column
};

} // namespace palp
