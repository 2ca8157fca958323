#include "solver/field/UnevenConductivity.h"

#include "model/base/Parallel.h"
#include "solver/element/LaneKernels.h"
#include "solver/field/TetRule.h"
#include "solver/linear/Front.h"

#include <Eigen/Dense>
#include <cblas.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp {

namespace {

constexpr int kRulePoints = TetRule::points;
using Rows = ConductionSolve::Rows;

} // namespace

UnevenConductivity::UnevenConductivity(const FieldMesh& mesh, const Eigen::Matrix3Xd& nodes_mm,
                                       const Conductivity& conductivity, const Eigen::Matrix3Xd& pressureSlopes,
                                       double reach_mm)
    : mesh_(&mesh), reach_mm_(reach_mm), elements_(std::size_t(mesh.elements())),
      at_(Eigen::Index(mesh.elements()) * kRulePoints, 6), volumes_(at_.rows()) {
  const Eigen::MatrixXi& nodes = mesh.tets().elements;
  const auto pressuresOf = [&](int e) -> Eigen::Matrix<double, 10, 1> {
    return conductivity.pressures_MPa(nodes.col(e));
  };
  for (int e = 0; e < mesh.elements(); ++e) elements_[std::size_t(e)] = e;
  const auto even = std::stable_partition(elements_.begin(), elements_.end(),
                                          [&](int e) { return (pressuresOf(e).array() > 0).any(); });
  uneven_ = static_cast<int>(even - elements_.begin());
  squareSlopes_.resize(Eigen::Index(uneven_) * kRulePoints);
  shapes_.resize(10, squareSlopes_.size());
  gradients_.resize(10, squareSlopes_.size());
  const TetRule& rule = tetRule();
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const auto own = nodes.col(elements_[i]);
    const Eigen::Matrix<double, 3, 10> places = nodes_mm(Eigen::all, own);
    const Eigen::Matrix<double, 10, 1> pressures = pressuresOf(elements_[i]);
    for (int q = 0; q < kRulePoints; ++q) {
      const Eigen::Index point = Eigen::Index(i) * kRulePoints + q;
      const Eigen::Matrix<double, 10, 3>& local = rule.gradients[std::size_t(q)];
      const Eigen::Matrix3d map = places * local;
      const double volume = rule.weights[std::size_t(q)] * map.determinant() / 6;
      volumes_(point) = volume;
      at_.row(point).head<3>() = (places * rule.shapes.col(q)).transpose();
      at_.row(point).tail<3>().setZero();
      if (static_cast<int>(i) >= uneven_) continue;
      const Eigen::Matrix<double, 10, 3> gradients = local * map.inverse();
      const double p = rule.shapes.col(q).dot(pressures), m = std::exp(conductivity.half(p));
      const Eigen::Vector3d slope =
          conductivity.halfByPressure(p) * (pressureSlopes(Eigen::all, own) * rule.shapes.col(q));
      at_.row(point).tail<3>() = volume * slope.transpose();
      squareSlopes_(point) = volume * slope.squaredNorm() / 2;
      shapes_.col(point) = m * rule.shapes.col(q);
      gradients_.col(point) = m * volume * (gradients * slope);
    }
  }
}

/// Of elements first .. first + count - 1: what stands in `right` at each of their nodes, by rows of ten.
void UnevenConductivity::addElements(int first, int count, const std::vector<Eigen::Matrix3Xd>& sources_mm,
                                     Rows& onElements, Eigen::MatrixXd& products) const {
  const auto sources = static_cast<int>(sources_mm.size());
  const Eigen::Index from = Eigen::Index(first) * kRulePoints;
  const int points = count * kRulePoints;
  Eigen::MatrixXd potentials = Eigen::MatrixXd::Zero(points, sources), slopes = potentials;
  const auto part = [&](Eigen::Index k) { return at_.col(k).data() + from; };
  const SurfacePoints places{part(0), part(1), part(2), part(3), part(4), part(5), points};
  for (int q = 0; q < sources; ++q) {
    const Eigen::Matrix3Xd& of = sources_mm[std::size_t(q)];
    for (Eigen::Index m = 0; m < of.cols(); ++m)
      laneKernels().addPointSource(places, of.col(m).data(), potentials.col(q).data(), slopes.col(q).data());
  }
  potentials /= kFourPi;
  slopes /= kFourPi;
  for (int e = 0; e < count; ++e) {
    const Eigen::Index own = Eigen::Index(e) * kRulePoints;
    auto out = onElements.middleRows(10 * Eigen::Index(e), 10);
    out.noalias() = shapes_.middleCols(from + own, kRulePoints) * slopes.middleRows(own, kRulePoints);
    out.noalias() += gradients_.middleCols(from + own, kRulePoints) * potentials.middleRows(own, kRulePoints);
  }
  for (int q = 0; q < sources; ++q)
    slopes.col(q).array() -= squareSlopes_.segment(from, points).array() * potentials.col(q).array();
  for (int q = 0; q < sources; q += batchLanes) {
    const int columns = std::min(batchLanes, sources - q);
    const auto add = [&](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
      cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, q + columns, columns, points, 1, a.data(), points,
                  b.col(q).data(), points, 1, products.col(q).data(), sources);
    };
    add(potentials, slopes);
    add(slopes, potentials);
  }
}

/// What the quadrature makes of integral slope . grad(s) chi and of integral slope . grad(s^2) chi, with s = 1/(4 pi r)
/// and chi = (1 - (r / reach)^2)^2 up to the nearest face: poles of second and third order, too steep for it, that are
/// odd, so that the integrals themselves are zero.
UnevenConductivity::Poles UnevenConductivity::poles(const Eigen::Matrix3Xd& sources_mm,
                                                    const Eigen::Vector3d& slope) const {
  const Eigen::Vector3d centre = sources_mm.col(0);
  double reach = reach_mm_; // a face nearer than that has an image, so that the ball lies in the block
  for (Eigen::Index m = 1; m < sources_mm.cols(); ++m) reach = std::min(reach, (sources_mm.col(m) - centre).norm() / 2);
  Poles sums;
  for (Eigen::Index i = 0; i < at_.rows(); ++i) {
    const Eigen::Vector3d d = at_.row(i).head<3>().transpose() - centre;
    const double square = d.squaredNorm();
    if (square >= reach * reach) continue;
    const double cut = 1 - square / (reach * reach), s = 1 / (kFourPi * std::sqrt(square));
    const double simple = -volumes_(i) * cut * cut * s * slope.dot(d) / square;
    sums.simple += simple;
    sums.square += 2 * s * simple;
  }
  return sums;
}

void UnevenConductivity::addIntegrals(const std::vector<Eigen::Matrix3Xd>& sources_mm,
                                      const std::vector<AtElectrode>& electrodes, int threads,
                                      const std::stop_token& stop, Rows& right, Eigen::MatrixXd& products) const {
  constexpr int parts = 8, elementsAPiece = 16, elementsAWave = parts * 16 * elementsAPiece;
  const auto count = static_cast<int>(sources_mm.size());
  std::vector<Eigen::MatrixXd> of(parts, Eigen::MatrixXd::Zero(count, count));
  for (int wave = 0; wave < uneven_ && !stop.stop_requested(); wave += elementsAWave) {
    const int some = std::min(elementsAWave, uneven_ - wave);
    Rows onElements(10 * Eigen::Index(some), count);
    forChunks(parts, 1, threads, [&](int part, int) {
      const int last = (part + 1) * some / parts;
      for (int first = part * some / parts; first < last && !stop.stop_requested(); first += elementsAPiece) {
        const int piece = std::min(elementsAPiece, last - first);
        Rows own(10 * Eigen::Index(piece), count);
        addElements(wave + first, piece, sources_mm, own, of[std::size_t(part)]);
        onElements.middleRows(10 * Eigen::Index(first), own.rows()) = own;
      }
    });
    if (stop.stop_requested()) return;
    forChunks(count, batchLanes, threads, [&](int begin, int end) {
      for (int i = 0; i < some; ++i)
        for (int n = 0; n < 10; ++n)
          right.row(mesh_->tets().elements(n, elements_[std::size_t(wave + i)])).segment(begin, end - begin) +=
              onElements.row(10 * Eigen::Index(i) + n).segment(begin, end - begin);
    });
  }
  for (const Eigen::MatrixXd& part : of) products += part;
  // Without what the quadrature makes of the electrodes' poles, times what stands beside them there.
  std::vector<Poles> poles(sources_mm.size());
  Eigen::MatrixXd beside(count, count);
  inParallel(poles.size(), threads, [&](std::size_t p) {
    if (!stop.stop_requested()) poles[p] = this->poles(sources_mm[p], electrodes[p].slope);
  });
  forChunks(count, 8, threads, [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      const auto own = static_cast<std::size_t>(p);
      const Eigen::Vector3d place = sources_mm[own].col(0);
      for (int q = 0; q < count; ++q) {
        const Eigen::Matrix3Xd& others = sources_mm[static_cast<std::size_t>(q)];
        double there = 0;
        for (Eigen::Index m = p == q ? 1 : 0; m < others.cols(); ++m)
          there += 1 / (kFourPi * (others.col(m) - place).norm());
        beside(q, p) = there * poles[own].simple;
      }
    }
  });
  products -= beside + beside.transpose();
  for (int p = 0; p < count; ++p) {
    const auto& [value, slope, element, shapes] = electrodes[static_cast<std::size_t>(p)];
    const Poles& pole = poles[static_cast<std::size_t>(p)];
    products(p, p) -= pole.square;
    for (int n = 0; n < 10; ++n)
      right(mesh_->tets().elements(n, element), p) -= std::exp(value) * shapes(n) * pole.simple;
  }
}

} // namespace palp
