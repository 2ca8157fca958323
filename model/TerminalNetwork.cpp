#include "model/TerminalNetwork.h"

#include "model/DesignError.h"
#include "model/base/PositiveSolve.h"

#include <Eigen/Dense>

#include <cassert>
#include <vector>

namespace palp {

namespace {

/// B: electrodes x wires, 1 where the electrode belongs to the wire.
Eigen::MatrixXd incidence(const WireCounts& counts) {
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(counts.electrodes(), counts.wires());
  const int upper = counts.rowWires * counts.electrodesPerRowWire;
  for (int e = 0; e < counts.electrodes(); ++e)
    b(e, e < upper ? e / counts.electrodesPerRowWire : counts.rowWires + (e - upper) / counts.electrodesPerColumnWire) =
        1;
  return b;
}

constexpr const char* kIndefinite =
    "the resistances between the electrodes are not positive definite (some current would have no power above 0); "
    "expected electrodes far enough apart and from the faces for their radius, a pressure law that varies the "
    "conductivity less, or a finer mesh";

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& m) {
  return (m + m.transpose()) / 2;
}

/// Y^+: the inverse of Y + s 1 1', which differs from it by a constant that no current of zero sum sees.
Eigen::MatrixXd pseudoInverse(const Eigen::MatrixXd& y) {
  const double shift = y.trace() / static_cast<double>(y.rows() * y.rows());
  Eigen::MatrixXd shifted = y;
  shifted.array() += shift;
  return symmetric(solvePositive<DesignError>(shifted, Eigen::MatrixXd::Identity(y.rows(), y.cols()), kIndefinite));
}

/// Refuses P that is not positive definite over currents that sum to 0; over the others it is given but for a constant.
void requirePositive(const Eigen::Ref<const Eigen::MatrixXd>& p) {
  const Eigen::VectorXd mean = p.rowwise().mean();
  Eigen::MatrixXd centred = symmetric(p);
  centred.colwise() -= mean;
  centred.rowwise() -= mean.transpose();
  centred.array() += mean.mean();
  centred.array() += centred.trace() / static_cast<double>(p.rows() * p.rows());
  if (p.rows() > 1 && !positiveFactor(centred)) throw DesignError(kIndefinite);
}

} // namespace

Eigen::MatrixXd WireCounts::sumsByWire(const Eigen::Ref<const Eigen::MatrixXd>& all) const {
  assert(all.rows() == electrodes() && "one row for each electrode");
  Eigen::MatrixXd sums(wires(), all.cols());
  const int upper = rowWires * electrodesPerRowWire;
  for (int w = 0; w < rowWires; ++w)
    sums.row(w) = all.middleRows(w * electrodesPerRowWire, electrodesPerRowWire).colwise().sum();
  for (int w = 0; w < columnWires; ++w)
    sums.row(rowWires + w) =
        all.middleRows(upper + w * electrodesPerColumnWire, electrodesPerColumnWire).colwise().sum();
  return sums;
}

Eigen::VectorXd WireCounts::atElectrodes(const Eigen::Ref<const Eigen::VectorXd>& all) const {
  assert(all.size() == this->wires() && "one value for each wire");
  return incidence(*this) * all;
}

TerminalNetwork::TerminalNetwork(const Eigen::Ref<const Eigen::MatrixXd>& potentials_ohm, const WireCounts& counts,
                                 double wire_ohm)
    : counts_(counts) {
  requirePositive(potentials_ohm);
  const Eigen::PartialPivLU<Eigen::MatrixXd> p(potentials_ohm);
  const Eigen::VectorXd even = p.solve(Eigen::VectorXd::Ones(potentials_ohm.rows()));
  const Eigen::MatrixXd free = p.solve(incidence(counts));
  currents_ = free - even * (free.colwise().sum() / even.sum()); // so that each column sums to 0
  conductances_ = symmetric(counts.sumsByWire(currents_));
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(counts.wires(), counts.wires());
  inBlock_ = one;
  if (wire_ohm == 0) return;
  inBlock_ = symmetric(solvePositive<DesignError>(one + wire_ohm * conductances_, one, kIndefinite));
  conductances_ = symmetric(inBlock_ * conductances_);
}

Eigen::MatrixXd TerminalNetwork::change(const Eigen::Ref<const Eigen::MatrixXd>& currentsTimesChange) const {
  return -symmetric(inBlock_ * currentsTimesChange * inBlock_);
}

NetworkReading::NetworkReading(const TerminalNetwork& network, Readout readout)
    : rows_(network.counts().rowWires), columns_(network.counts().columnWires), resistances_ohm_(rows_, columns_),
      adjoint_(network.counts().wires(), rows_ * columns_), drive_(network.counts().wires(), rows_ * columns_) {
  const Eigen::MatrixXd& y = network.conductances();
  switch (readout) {
  case Readout::Floating:
    readFloating(y);
    break;
  case Readout::VirtualGround:
    readVirtualGround(y);
    break;
  case Readout::RowsGrounded:
    readRowsGrounded(y);
    break;
  case Readout::OthersAtHalf:
    readOthersAtHalf(y);
    break;
  }
}

void NetworkReading::setPotentials(Eigen::Index cell, const Eigen::VectorXd& adjoint, const Eigen::VectorXd& drive) {
  adjoint_.col(cell) = adjoint;
  drive_.col(cell) = drive;
}

/// R = (e_r - e_c)' Y^+ (e_r - e_c),  dR = - v' dY v,  v = Y^+ (e_r - e_c).
void NetworkReading::readFloating(const Eigen::MatrixXd& y) {
  const Eigen::MatrixXd z = pseudoInverse(y);
  for (Eigen::Index c = 0; c < columns_; ++c)
    for (Eigen::Index r = 0; r < rows_; ++r) {
      const Eigen::VectorXd v = z.col(r) - z.col(rows_ + c);
      const double resistance = v(r) - v(rows_ + c);
      resistances_ohm_(r, c) = resistance;
      setPotentials(r + rows_ * c, v / resistance, v);
    }
}

/// R = - 1 / Y_rc,  d ln R = - dY_rc / Y_rc.
void NetworkReading::readVirtualGround(const Eigen::MatrixXd& y) {
  for (Eigen::Index c = 0; c < columns_; ++c)
    for (Eigen::Index r = 0; r < rows_; ++r) {
      const double conductance = y(r, rows_ + c);
      resistances_ohm_(r, c) = -1 / conductance;
      setPotentials(r + rows_ * c, Eigen::VectorXd::Unit(y.rows(), rows_ + c) / conductance,
                    Eigen::VectorXd::Unit(y.rows(), r));
    }
}

/// R = - 1 / S_rc with S the conductances of the row-wires and one column-wire while the other column-wires f float:
/// S = T' Y T, T the potentials of all wires at 1 V on one of those, dS = T' dY T.
void NetworkReading::readRowsGrounded(const Eigen::MatrixXd& y) {
  for (Eigen::Index c = 0; c < columns_; ++c) {
    std::vector<Eigen::Index> kept, floating;
    for (Eigen::Index w = 0; w < y.rows(); ++w) (w < rows_ || w == rows_ + c ? kept : floating).push_back(w);
    Eigen::MatrixXd t = Eigen::MatrixXd::Zero(y.rows(), rows_ + 1);
    t(kept, Eigen::all).setIdentity();
    t(floating, Eigen::all) = -solvePositive<DesignError>(y(floating, floating), y(floating, kept), kIndefinite);
    const Eigen::MatrixXd s = t.transpose() * y * t;
    for (Eigen::Index r = 0; r < rows_; ++r) {
      resistances_ohm_(r, c) = -1 / s(r, rows_);
      setPotentials(r + rows_ * c, t.col(rows_) / s(r, rows_), t.col(r));
    }
  }
}

/// Measured from half of the drive voltage U only the pair is driven, by U/2 and -U/2: R = 2 / (Y_cc - Y_rc).
void NetworkReading::readOthersAtHalf(const Eigen::MatrixXd& y) {
  for (Eigen::Index c = 0; c < columns_; ++c)
    for (Eigen::Index r = 0; r < rows_; ++r) {
      const double conductance = y(rows_ + c, rows_ + c) - y(r, rows_ + c);
      resistances_ohm_(r, c) = 2 / conductance;
      Eigen::VectorXd drive = Eigen::VectorXd::Unit(y.rows(), rows_ + c);
      drive(r) = -1;
      setPotentials(r + rows_ * c, Eigen::VectorXd::Unit(y.rows(), rows_ + c) / conductance, drive);
    }
}

Eigen::MatrixXd NetworkReading::logChange(const Eigen::Ref<const Eigen::MatrixXd>& conductanceChange) const {
  const Eigen::RowVectorXd change = -(adjoint_.cwiseProduct(conductanceChange * drive_)).colwise().sum();
  return change.reshaped(rows_, columns_);
}

} // namespace palp
