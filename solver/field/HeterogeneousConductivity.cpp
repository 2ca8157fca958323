#include "solver/field/HeterogeneousConductivity.h"

#include "model/base/Parallel.h"
#include "solver/element/ElementGeometry.h"
#include "solver/element/LaneKernels.h"
#include "solver/field/TetRule.h"
#include "solver/linear/Front.h"

#include <Eigen/Dense>
#include <cblas.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp {

HeterogeneousConductivity::HeterogeneousConductivity(const FieldMesh& mesh, const Eigen::Matrix3Xd& nodes_mm,
                                                     const FieldFunctions& functions, int threads)
    : mesh_(&mesh), functions_(&functions) {
  const FieldConductivity& conductivity = functions.conductivity();
  const Eigen::MatrixXi& nodes = mesh.tets().elements;
  const auto pressuresOf = [&](int e) -> Eigen::Matrix<double, 10, 1> {
    return conductivity.pressures_MPa(nodes.col(e));
  };
  for (int e = 0; e < mesh.elements(); ++e)
    if ((pressuresOf(e).array() > 0).any()) elements_.push_back(e);
  // The slope of l jumps where the pressure changes its sign. The error of a rule that integrates across the jump is
  // the same share of all sources' products, also between electrodes that others screen from one another.
  std::vector<std::vector<TetPoint>> points(elements_.size());
  inParallel(elements_.size(), threads,
             [&](std::size_t i) { points[i] = tetPointsAroundKink(pressuresOf(elements_[i])); });
  first_.push_back(0);
  for (const auto& own : points) first_.push_back(first_.back() + static_cast<Eigen::Index>(own.size()));
  at_.resize(first_.back(), 6);
  spans_mm_.resize(elements_.size());
  squareSlopes_.resize(at_.rows());
  shapes_.resize(FieldFunctions::most, squareSlopes_.size());
  gradients_.resize(FieldFunctions::most, squareSlopes_.size());
  inParallel(elements_.size(), threads, [&](std::size_t i) {
    const auto own = nodes.col(elements_[i]);
    const Eigen::Matrix<double, 3, 10> places = nodes_mm(Eigen::all, own);
    const Eigen::Matrix<double, 10, 1> pressures = pressuresOf(elements_[i]);
    for (std::size_t q = 0; q < points[i].size(); ++q) {
      const Eigen::Index point = first_[i] + static_cast<Eigen::Index>(q);
      const FieldFunctions::Point there = functions.at(elements_[i], points[i][q].barycentric);
      const Eigen::Matrix<double, 10, 1> shapes = there.values.head<10>();
      const Eigen::Matrix3d map = places * there.gradients.topRows<10>();
      const double volume = points[i][q].weight * map.determinant() / 6;
      at_.row(point).head<3>() = (places * shapes).transpose();
      const Eigen::Matrix<double, FieldFunctions::most, 3> gradients = there.gradients * map.inverse();
      const double p = shapes.dot(pressures), m = std::exp(conductivity.halfLogConductivity(p));
      const Eigen::Vector3d slope =
          conductivity.halfLogConductivitySlope(p) * (gradients.topRows<10>().transpose() * pressures);
      at_.row(point).tail<3>() = volume * slope.transpose();
      squareSlopes_(point) = static_cast<float>(volume * slope.squaredNorm() / 2);
      shapes_.col(point) = (m * there.values).cast<float>();
      gradients_.col(point) = (m * volume * (gradients * slope)).cast<float>();
    }
    const auto all = at_.leftCols<3>().middleRows(first_[i], first_[i + 1] - first_[i]);
    spans_mm_[i] = (all.rowwise() - all.row(0)).rowwise().norm().maxCoeff();
  });
}

/// For elements first .. first + count - 1: the contributions to `right` for each of their functions, by rows of 14,
/// and those added to `products`. Both are sums over the sources without subtracted poles: single precision leaves 1e-7
/// of them.
void HeterogeneousConductivity::addElements(int first, int count, const std::vector<Eigen::Matrix3Xd>& sources_mm,
                                            float* onElements, Eigen::MatrixXd& products) const {
  const auto sources = static_cast<int>(sources_mm.size());
  const Eigen::Index from = first_[std::size_t(first)];
  const auto points = static_cast<int>(first_[std::size_t(first + count)] - from);
  Eigen::MatrixXf potentials(points, sources), slopes(points, sources);
  Eigen::VectorXd potential(points), slope(points);
  const auto part = [&](Eigen::Index k) { return at_.col(k).data() + from; };
  const SurfacePoints places{part(0), part(1), part(2), part(3), part(4), part(5), points};
  for (int q = 0; q < sources; ++q) {
    potential.setZero();
    slope.setZero();
    const Eigen::Matrix3Xd& of = sources_mm[std::size_t(q)];
    for (Eigen::Index m = 0; m < of.cols(); ++m)
      laneKernels().addPointSource(places, of.col(m).data(), potential.data(), slope.data());
    potentials.col(q) = (potential / kFourPi).cast<float>();
    slopes.col(q) = (slope / kFourPi).cast<float>();
  }
  for (int e = 0; e < count; ++e) {
    const Eigen::Index own = first_[std::size_t(first + e)] - from;
    const auto some = static_cast<int>(first_[std::size_t(first + e) + 1] - from - own);
    const auto add = [&](const Eigen::MatrixXf& factors, const Eigen::MatrixXf& fields, float old) {
      cblas_sgemm(CblasColMajor, CblasTrans, CblasTrans, sources, functions_->count(elements_[std::size_t(first + e)]),
                  some, 1, fields.data() + own, points, factors.col(from + own).data(), FieldFunctions::most, old,
                  onElements + std::size_t(e) * FieldFunctions::most * std::size_t(sources), sources);
    };
    add(shapes_, slopes, 0);
    add(gradients_, potentials, 1);
  }
  for (int q = 0; q < sources; ++q)
    slopes.col(q).array() -= squareSlopes_.segment(from, points).array() * potentials.col(q).array();
  Eigen::MatrixXf gained(sources, sources);
  cblas_ssyr2k(CblasColMajor, CblasUpper, CblasTrans, sources, points, 1, potentials.data(), points, slopes.data(),
               points, 0, gained.data(), sources);
  for (int q = 0; q < sources; ++q) products.col(q).head(q + 1) += gained.col(q).head(q + 1).cast<double>();
}

/// What the quadrature makes of the integrals of grad l . grad(s) chi and grad l . grad(s^2) chi as AtElectrode has
/// them: poles of second and third order, too steep for it.
HeterogeneousConductivity::Poles HeterogeneousConductivity::poles(const Eigen::Vector3d& centre_mm,
                                                                  double cutoff_mm) const {
  Poles sums;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    if ((at_.row(first_[e]).head<3>().transpose() - centre_mm).norm() >= cutoff_mm + spans_mm_[e]) continue;
    for (Eigen::Index i = first_[e]; i < first_[e + 1]; ++i) {
      const Eigen::Vector3d d = at_.row(i).head<3>().transpose() - centre_mm;
      const double square = d.squaredNorm();
      if (square >= cutoff_mm * cutoff_mm) continue;
      const double s = 1 / (kFourPi * std::sqrt(square));
      const double simple =
          -AtElectrode::cutOff(square / (cutoff_mm * cutoff_mm)) * s * at_.row(i).tail<3>().dot(d) / square;
      sums.simple += simple;
      sums.square += 2 * s * simple;
    }
  }
  return sums;
}

void HeterogeneousConductivity::addIntegrals(const std::vector<Eigen::Matrix3Xd>& sources_mm,
                                             const std::vector<AtElectrode>& electrodes,
                                             const std::vector<double>& cutoffs_mm, int threads,
                                             const std::stop_token& stop, SourceRows& right,
                                             Eigen::MatrixXd& products) const {
  constexpr int parts = 8, elementsAPiece = 16, elementsAWave = parts * 4 * elementsAPiece;
  const auto count = static_cast<int>(sources_mm.size()), heterogeneous = static_cast<int>(elements_.size());
  std::vector<Eigen::MatrixXd> of(parts, Eigen::MatrixXd::Zero(count, count));
  constexpr int most = FieldFunctions::most;
  UnsetArray<float> onElements(std::size_t(most * elementsAWave) * std::size_t(count)); // by rows of `count`
  const auto rowsOf = [&](int element) { return onElements.data() + std::size_t(most * element) * std::size_t(count); };
  for (int wave = 0; wave < heterogeneous && !stop.stop_requested(); wave += elementsAWave) {
    const int some = std::min(elementsAWave, heterogeneous - wave);
    forChunks(parts, 1, threads, [&](int part, int) {
      const int last = (part + 1) * some / parts;
      for (int first = part * some / parts; first < last && !stop.stop_requested(); first += elementsAPiece) {
        const int piece = std::min(elementsAPiece, last - first);
        addElements(wave + first, piece, sources_mm, rowsOf(first), of[std::size_t(part)]);
      }
    });
    if (stop.stop_requested()) return;
    forChunks(count, batchColumns, threads, [&](int begin, int end) {
      for (int i = 0; i < some; ++i) {
        const int element = elements_[std::size_t(wave + i)];
        for (int n = 0; n < functions_->count(element); ++n)
          right.row(functions_->row(n, element)).segment(begin, end - begin) +=
              Eigen::Map<const Eigen::RowVectorXf>(rowsOf(i) + n * count + begin, end - begin).cast<double>();
      }
    });
  }
  for (const Eigen::MatrixXd& part : of) products += part;
  // The electrodes' poles, times the other factors there, by spheres instead of the quadrature.
  std::vector<Poles> poles(sources_mm.size());
  Eigen::MatrixXd others(count, count);
  inParallel(poles.size(), threads, [&](std::size_t p) {
    if (stop.stop_requested()) return;
    poles[p] = this->poles(sources_mm[p].col(0), cutoffs_mm[p]);
    poles[p].simple -= electrodes[p].simple;
    poles[p].square -= electrodes[p].square;
  });
  forChunks(count, 8, threads, [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      const auto own = static_cast<std::size_t>(p);
      const Eigen::Vector3d place = sources_mm[own].col(0);
      for (int q = 0; q < count; ++q) {
        const Eigen::Matrix3Xd& images = sources_mm[static_cast<std::size_t>(q)];
        double there = 0;
        for (Eigen::Index m = p == q ? 1 : 0; m < images.cols(); ++m)
          there += 1 / (kFourPi * (images.col(m) - place).norm());
        others(q, p) = there * poles[own].simple;
      }
    }
  });
  products -= others + others.transpose();
  for (int p = 0; p < count; ++p) {
    const AtElectrode& at = electrodes[static_cast<std::size_t>(p)];
    const Poles& pole = poles[static_cast<std::size_t>(p)];
    products(p, p) -= pole.square;
    for (int n = 0; n < functions_->count(at.element); ++n)
      right(functions_->row(n, at.element), p) -= std::exp(at.value) * at.there.values(n) * pole.simple;
  }
}

} // namespace palp
