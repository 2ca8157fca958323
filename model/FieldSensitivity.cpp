#include "model/FieldSensitivity.h"

#include "model/BoxGreen.h"
#include "model/base/Cancelled.h"
#include "model/base/Parallel.h"
#include "model/field/FaceField.h"
#include "model/field/FaceGrid.h"

#include <cassert>
#include <numbers>

namespace palp {

namespace {

Eigen::MatrixXd plusTranspose(const Eigen::MatrixXd& m) {
  return m + m.transpose();
}

/// Index of d2 / dx_i dx_j in BoxGreen::Curvature::own.
constexpr std::size_t kOwn[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

} // namespace

FieldSensitivity::FieldSensitivity(const SensorDesign& design, const FieldLaw& law, SphereModel model, double fineness,
                                   int threads)
    : FieldSensitivity(design, law, model, fineness,
                       boxGreen(design.block_mm, electrodes_mm(design), model == SphereModel::Dipoles, threads)) {}

FieldSensitivity::FieldSensitivity(SensorDesign design, const FieldLaw& law, SphereModel model, double fineness,
                                   const BoxGreen& green)
    : design_(std::move(design)), law_(law),
      network_(potentials_ohm(green, law_, model), wireCounts(design_), law_.wire_ohm),
      dipole_(model == SphereModel::Dipoles ? 4 * std::numbers::pi * std::pow(law_.electrodeRadius_mm, 3) : 0),
      faces_(movingFaces(design_, fineness)) {
  const Eigen::MatrixXd& q = network_.currents();
  for (std::size_t i = 0; i < 3; ++i) gradient_[i] = green.slope[i] * q;
  totalGradient_ = gradient_;
  if (dipole_ > 0) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        totalGradient_[j] -= dipole_ * green.curvature.mixed[3 * i + j].transpose() * gradient_[i];
    for (std::size_t i = 0; i < 6; ++i) curvature_[i] = green.curvature.own[i] * q;
  }
  Eigen::Index points = 0, at = 0;
  for (const FaceGrid& face : faces_) points += face.count();
  facePoints_mm_.resize(3, points);
  faceNormals_ = Eigen::Matrix3Xd::Zero(3, points);
  for (const FaceGrid& face : faces_) {
    facePoints_mm_.middleCols(at, face.count()) = face.points_mm();
    faceNormals_.row(face.axis).segment(at, face.count()).setConstant(face.high ? 1 : -1);
    at += face.count();
  }
}

FieldSensitivity::~FieldSensitivity() = default;
FieldSensitivity::FieldSensitivity(FieldSensitivity&&) noexcept = default;

/// With E_s the gradient at electrode s (rows of gradient_), c = 4 pi a^3 and u_s its displacement,
///   Q' dP Q / rho = [Q' Z] + [Q' Z]',           Z_s = u_s . (E_s - c sum_r (d2G / dx_r dx_s)' E_r)
///                 - c sum_s [(B_s u_s) . E_s] + [...]',   B_s the second derivatives at s of the potential of all
///                 others.
Eigen::MatrixXd FieldSensitivity::ofElectrodes(const Eigen::Matrix3Xd& motion_mm) const {
  const Eigen::MatrixXd& q = network_.currents();
  Eigen::MatrixXd z = Eigen::MatrixXd::Zero(q.rows(), q.cols());
  for (std::size_t i = 0; i < 3; ++i) z += motion_mm.row(static_cast<Eigen::Index>(i)).asDiagonal() * totalGradient_[i];
  Eigen::MatrixXd change = plusTranspose(q.transpose() * z);
  if (dipole_ == 0) return change;
  for (std::size_t i = 0; i < 3; ++i) {
    Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(q.rows(), q.cols());
    for (std::size_t j = 0; j < 3; ++j)
      moved += motion_mm.row(static_cast<Eigen::Index>(j)).asDiagonal() * curvature_[kOwn[i][j]];
    change -= dipole_ * plusTranspose(moved.transpose() * gradient_[i]);
  }
  return change;
}

ElectrodeSources FieldSensitivity::sources() const {
  ElectrodeSources sources{electrodes_mm(design_), network_.currents(), {}};
  if (dipole_ > 0)
    for (std::size_t i = 0; i < 3; ++i) sources.dipoles[i] = -dipole_ * gradient_[i];
  return sources;
}

std::vector<Eigen::MatrixXd> FieldSensitivity::conductanceChanges(std::span<const SensorMotion> motions, int threads,
                                                                  const std::stop_token& stop) const {
  const ElectrodeSources electrodes = sources();
  std::vector<Eigen::MatrixXd> changes;
  Eigen::MatrixXd outward(facePoints_mm_.cols(), static_cast<Eigen::Index>(motions.size()));
  for (const SensorMotion& motion : motions) {
    assert(motion.faces_mm.size() == outward.rows() && "one displacement for each point of the faces");
    outward.col(static_cast<Eigen::Index>(changes.size())) = motion.faces_mm;
    changes.push_back(ofElectrodes(motion.electrodes_mm));
  }
  Eigen::Index at = 0;
  for (const FaceGrid& face : faces_) {
    const auto part =
        faceChanges(design_.block_mm, face, electrodes, outward.middleRows(at, face.count()), threads, stop);
    for (std::size_t m = 0; m < changes.size(); ++m) changes[m] += part[m];
    at += face.count();
  }
  for (Eigen::MatrixXd& change : changes) change = network_.change(law_.resistivity_ohm_mm * change);
  return changes;
}

ReadingGradient FieldSensitivity::readingGradient(Readout readout, int threads, const std::stop_token& stop) const {
  const NetworkReading reading(network_, readout);
  const auto readings = [&](const Eigen::MatrixXd& change) -> Eigen::VectorXd {
    return reading.logChange(network_.change(law_.resistivity_ohm_mm * change)).reshaped();
  };
  const Eigen::Index wires = network_.counts().wires(), count = reading.resistances_ohm().size();
  Eigen::MatrixXd sums(wires * (wires + 1) / 2, count); // of the pairs of wires, for each reading
  for (Eigen::Index b = 0, pair = 0; b < wires; ++b)
    for (Eigen::Index a = 0; a <= b; ++a, ++pair) {
      Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(wires, wires);
      unit(a, b) = unit(b, a) = 1;
      sums.row(pair) = readings(unit).transpose();
    }
  ReadingGradient gradient;
  const Eigen::Index electrodes = network_.counts().electrodes();
  gradient.electrodes_per_mm.resize(count, 3 * electrodes);
  forChunks(static_cast<int>(electrodes), 1, threads, [&](int electrode, int) {
    if (stop.stop_requested()) throw Cancelled();
    Eigen::Matrix3Xd motion = Eigen::Matrix3Xd::Zero(3, electrodes);
    for (int axis = 0; axis < 3; ++axis) {
      motion.col(electrode) = Eigen::Vector3d::Unit(axis);
      gradient.electrodes_per_mm.col(3 * electrode + axis) = readings(ofElectrodes(motion));
    }
  });
  gradient.faces_per_mm.resize(count, facePoints_mm_.cols());
  Eigen::Index at = 0;
  for (const FaceGrid& face : faces_) {
    gradient.faces_per_mm.middleCols(at, face.count()) =
        faceWeights(design_.block_mm, face, sources(), sums, threads, stop).transpose();
    at += face.count();
  }
  return gradient;
}

} // namespace palp
