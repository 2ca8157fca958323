#include "model/field/FaceField.h"

#include "model/base/Cancelled.h"
#include "model/base/Parallel.h"
#include "model/field/HeatKernel.h"

#include <algorithm>

namespace palp {

namespace {

constexpr double kDigitsOnFaces = 7;      // of the integrals over time; the quadrature on the face leaves 1e-5
constexpr Eigen::Index kLinePoints = 512; // points of a face that are worked on at a time

/// Kernels along an axis from each electrode to each place, at all times: places x times.
struct AxisKernels {
  Eigen::MatrixXd k, place, source, both; ///< value, derivatives by the place, by the electrode's place, by both
};

AxisKernels axisKernels(const Eigen::Ref<const Eigen::ArrayXd>& places, double source, const Eigen::ArrayXd& times,
                        double length) {
  AxisKernels kernels;
  for (Eigen::MatrixXd* part : {&kernels.k, &kernels.place, &kernels.source, &kernels.both})
    part->resize(places.size(), times.size());
  for (Eigen::Index t = 0; t < times.size(); ++t)
    for (Eigen::Index i = 0; i < places.size(); ++i) {
      const KernelJet near = circleKernel(places(i) - source, times(t), length);
      const KernelJet far = circleKernel(places(i) + source, times(t), length);
      kernels.k(i, t) = near.value + far.value;
      kernels.place(i, t) = far.slope + near.slope;
      kernels.source(i, t) = far.slope - near.slope;
      kernels.both(i, t) = far.curvature - near.curvature;
    }
  return kernels;
}

/// Of each electrode those along one axis; electrodes of one coordinate share them.
class KernelsByCoordinate {
public:
  KernelsByCoordinate(const Eigen::ArrayXd& places, const Eigen::RowVectorXd& coordinates, const Eigen::ArrayXd& times,
                      double length, int threads) {
    std::vector<double> distinct(coordinates.begin(), coordinates.end());
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    for (const double x : coordinates)
      of_.push_back(static_cast<std::size_t>(std::lower_bound(distinct.begin(), distinct.end(), x) - distinct.begin()));
    kernels_.resize(distinct.size());
    inParallel(distinct.size(), threads,
               [&](std::size_t i) { kernels_[i] = axisKernels(places, distinct[i], times, length); });
  }
  const AxisKernels& operator[](Eigen::Index electrode) const {
    return kernels_[of_[static_cast<std::size_t>(electrode)]];
  }

private:
  std::vector<std::size_t> of_;
  std::vector<AxisKernels> kernels_;
};

/// Potentials of unit sources at the electrodes, differentiated along one direction of the face: points x electrodes,
/// and points x (3 electrodes) of unit dipoles along x, y, z (x of all electrodes first).
struct UnitFields {
  Eigen::MatrixXd monopoles, dipoles;
};

class FaceWork {
public:
  FaceWork(const Eigen::Vector3d& block, const FaceGrid& face, const ElectrodeSources& sources, int threads)
      : face_(face), sources_(sources), times_(heatTimes(face.nearest_mm, block.maxCoeff(), kDigitsOnFaces)),
        normal_(Eigen::ArrayXd::Constant(1, face.at_mm), sources.electrodes_mm.row(face.axis), times_.time,
                block(face.axis), threads),
        u_(face.u_mm, sources.electrodes_mm.row(face.first), times_.time, block(face.first), threads),
        v_(face.v_mm, sources.electrodes_mm.row(face.second), times_.time, block(face.second), threads),
        moments_(3 * sources.currents.rows(), sources.currents.cols()) {
    if (dipoles())
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        moments_.middleRows(axis * sources.currents.rows(), sources.currents.rows()) =
            sources.dipoles[static_cast<std::size_t>(axis)];
  }

  /// What the lines v = [begin, end) of the face give to each motion: pairs of wires (a <= b, by b) x motions.
  [[nodiscard]] Eigen::MatrixXd ofLines(const Eigen::Ref<const Eigen::MatrixXd>& motions, Eigen::Index begin,
                                        Eigen::Index end) const {
    const Eigen::Index along = face_.u_mm.size();
    return -(products(begin, end).transpose() *
             (weights(begin, end).asDiagonal() * motions.middleRows(begin * along, along * (end - begin))));
  }

  /// What multiplies the motion of the points of these lines in sums of the pairs' changes: points x sums.
  [[nodiscard]] Eigen::MatrixXd weightsOfLines(const Eigen::Ref<const Eigen::MatrixXd>& sums, Eigen::Index begin,
                                               Eigen::Index end) const {
    return -(weights(begin, end).asDiagonal() * (products(begin, end) * sums));
  }

private:
  [[nodiscard]] bool dipoles() const { return sources_.dipoles[0].size() > 0; }

  /// Of the quadrature over these lines.
  [[nodiscard]] Eigen::VectorXd weights(Eigen::Index begin, Eigen::Index end) const {
    return (face_.uWeights.matrix() * face_.vWeights.segment(begin, end - begin).matrix().transpose()).reshaped();
  }

  /// The integrand at their points: points x pairs.
  [[nodiscard]] Eigen::MatrixXd products(Eigen::Index begin, Eigen::Index end) const {
    const Eigen::Index points = face_.u_mm.size() * (end - begin), wires = sources_.currents.cols();
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(points, wires * (wires + 1) / 2);
    for (const bool alongU : {true, false}) {
      const UnitFields unit = fields(alongU, begin, end);
      const Eigen::MatrixXd phi = unit.monopoles * sources_.currents;
      Eigen::MatrixXd half = phi / 2; // phi_a half_b + half_a phi_b is the integrand
      if (dipoles()) half += unit.dipoles * moments_;
      for (Eigen::Index b = 0, pair = 0; b < wires; ++b)
        for (Eigen::Index a = 0; a <= b; ++a, ++pair)
          result.col(pair) += phi.col(a).cwiseProduct(half.col(b)) + half.col(a).cwiseProduct(phi.col(b));
    }
    return result;
  }

  [[nodiscard]] UnitFields fields(bool alongU, Eigen::Index begin, Eigen::Index end) const {
    const Eigen::Index electrodes = sources_.currents.rows(), along = face_.u_mm.size(), lines = end - begin;
    UnitFields unit{Eigen::MatrixXd(along * lines, electrodes),
                    Eigen::MatrixXd(dipoles() ? along * lines : 0, 3 * electrodes)};
    for (Eigen::Index p = 0; p < electrodes; ++p) {
      const AxisKernels &n = normal_[p], &u = u_[p], &v = v_[p];
      const Eigen::VectorXd level = times_.weight.matrix().cwiseProduct(n.k.row(0).transpose());
      const Eigen::MatrixXd& uSide = alongU ? u.place : u.k;
      const Eigen::MatrixXd& vSide = alongU ? v.k : v.place;
      const Eigen::MatrixXd scaled = uSide * level.asDiagonal();
      const auto product = [&](const Eigen::MatrixXd& left, const Eigen::MatrixXd& right) {
        return (left * right.middleRows(begin, lines).transpose()).reshaped();
      };
      unit.monopoles.col(p) = product(scaled, vSide);
      if (!dipoles()) continue;
      const Eigen::VectorXd slope = times_.weight.matrix().cwiseProduct(n.source.row(0).transpose());
      unit.dipoles.col(face_.axis * electrodes + p) = product(uSide * slope.asDiagonal(), vSide);
      unit.dipoles.col(face_.first * electrodes + p) =
          product((alongU ? u.both : u.source) * level.asDiagonal(), vSide);
      unit.dipoles.col(face_.second * electrodes + p) = product(scaled, alongU ? v.source : v.both);
    }
    return unit;
  }

  const FaceGrid& face_;
  const ElectrodeSources& sources_;
  HeatTimes times_;
  KernelsByCoordinate normal_, u_, v_;
  Eigen::MatrixXd moments_;
};

int linesAtOnce(const FaceGrid& face) {
  return std::max(1, static_cast<int>(kLinePoints / face.u_mm.size()));
}

} // namespace

std::vector<Eigen::MatrixXd> faceChanges(const Eigen::Vector3d& block_mm, const FaceGrid& face,
                                         const ElectrodeSources& sources,
                                         const Eigen::Ref<const Eigen::MatrixXd>& motions, int threads,
                                         const std::stop_token& stop) {
  const FaceWork work(block_mm, face, sources, threads);
  const int lines = static_cast<int>(face.v_mm.size()), chunk = linesAtOnce(face);
  std::vector<Eigen::MatrixXd> parts(static_cast<std::size_t>((lines + chunk - 1) / chunk));
  forChunks(lines, chunk, threads, [&](int begin, int end) {
    if (stop.stop_requested()) throw Cancelled();
    parts[static_cast<std::size_t>(begin / chunk)] = work.ofLines(motions, begin, end);
  });
  Eigen::MatrixXd sum = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) sum += parts[i]; // in one order at any number of threads
  std::vector<Eigen::MatrixXd> changes;
  for (Eigen::Index m = 0; m < motions.cols(); ++m) {
    Eigen::MatrixXd& change = changes.emplace_back(sources.currents.cols(), sources.currents.cols());
    for (Eigen::Index b = 0, pair = 0; b < change.cols(); ++b)
      for (Eigen::Index a = 0; a <= b; ++a, ++pair) change(a, b) = change(b, a) = sum(pair, m);
  }
  return changes;
}

Eigen::MatrixXd faceWeights(const Eigen::Vector3d& block_mm, const FaceGrid& face, const ElectrodeSources& sources,
                            const Eigen::Ref<const Eigen::MatrixXd>& sums, int threads, const std::stop_token& stop) {
  const FaceWork work(block_mm, face, sources, threads);
  Eigen::MatrixXd weights(face.count(), sums.cols());
  forChunks(static_cast<int>(face.v_mm.size()), linesAtOnce(face), threads, [&](int begin, int end) {
    if (stop.stop_requested()) throw Cancelled();
    const Eigen::Index along = face.u_mm.size();
    weights.middleRows(begin * along, (end - begin) * along) = work.weightsOfLines(sums, begin, end);
  });
  return weights;
}

} // namespace palp
