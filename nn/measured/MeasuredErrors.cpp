#include "nn/measured/MeasuredErrors.h"

#include "nn/NetworkError.h"
#include "nn/linear/Lapack.h"
#include "nn/measured/MeasuredFeatures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp {

namespace {

constexpr double kBeyondRange = 0.1;
constexpr double kWithinOne = 0.683;

struct Shares {
  double all = 0, lower = 0, upper = 0;
};
static Shares sharesWithin(const Eigen::VectorXd& error, const Eigen::VectorXd& size, double median, double a,
                           double b) {
  double count[2] = {}, within[2] = {};
  for (Eigen::Index i = 0; i < error.size(); ++i) {
    const int half = size(i) > median ? 1 : 0;
    ++count[half];
    if (error(i) <= std::hypot(a, b * size(i))) ++within[half];
  }
  const auto share = [](double part, double of) { return of > 0 ? part / of : 1; };
  return {share(within[0] + within[1], count[0] + count[1]), share(within[0], count[0]), share(within[1], count[1])};
}

TrainingEllipse ellipseOf(const Eigen::MatrixXd& scaled) {
  TrainingEllipse ellipse;
  ellipse.offset = scaled.rowwise().mean();
  const Eigen::MatrixXd centred = scaled.colwise() - ellipse.offset;
  Eigen::MatrixXd covariance = centred * centred.transpose() / std::max(1.0, static_cast<double>(scaled.cols() - 1));
  covariance.diagonal().array() += 1e-4 * covariance.trace() / static_cast<double>(scaled.rows());
  if (!lapack::choleskyInPlace(covariance)) throw NetworkError("the readings do not vary");
  const Eigen::MatrixXd half =
      lapack::solveLower(covariance, Eigen::MatrixXd::Identity(scaled.rows(), scaled.rows()), false);
  ellipse.inverseCovariance = half.transpose() * half;
  return ellipse;
}

} // namespace

Eigen::MatrixXd DeviationLaw::at(const Eigen::Ref<const Eigen::MatrixXd>& predicted) const {
  Eigen::RowVectorXd square = Eigen::RowVectorXd::Zero(predicted.cols());
  for (Eigen::Index j = 0; j < predicted.rows(); ++j)
    if (range(j) > 0) square += (predicted.row(j) / range(j)).cwiseAbs2();
  Eigen::MatrixXd all(predicted.rows(), predicted.cols());
  for (Eigen::Index j = 0; j < predicted.rows(); ++j) all.row(j) = (a(j) * a(j) + b(j) * b(j) * square.array()).sqrt();
  return all;
}

double TrainingEllipse::distance(const Eigen::Ref<const Eigen::VectorXd>& scaled) const {
  const Eigen::VectorXd from = scaled - offset;
  return from.dot(inverseCovariance * from);
}

DeviationLaw fitDeviation(const Eigen::MatrixXd& targets, const Eigen::MatrixXd& errors, Eigen::Index forces) {
  DeviationLaw law;
  law.range = (targets.colwise().maxCoeff() - targets.colwise().minCoeff()).transpose();
  law.a = law.b = Eigen::VectorXd::Zero(targets.cols());
  Eigen::VectorXd size = Eigen::VectorXd::Zero(targets.rows());
  if (forces < 0) forces = targets.cols();
  law.range.tail(targets.cols() - forces).setZero();
  for (Eigen::Index j = 0; j < forces; ++j)
    if (law.range(j) > 0) size += ((targets.col(j) - errors.col(j)) / law.range(j)).cwiseAbs2();
  size = size.cwiseSqrt();
  const double median = percentile(size, 0.5);
  for (Eigen::Index j = 0; j < targets.cols(); ++j) {
    const double range = targets.col(j).maxCoeff() - targets.col(j).minCoeff();
    if (!(range > 0)) continue;
    const Eigen::VectorXd error = errors.col(j).cwiseAbs();
    double least = std::numeric_limits<double>::infinity();
    for (const double percent : {0, 1, 2, 4, 6, 9, 13, 18, 25, 35}) {
      const double b = percent / 100 * range;
      double low = 1e-9 * range, high = 10 * range, a = low;
      Shares shares;
      for (int i = 0; i < 60; ++i) {
        a = std::sqrt(low * high);
        shares = sharesWithin(error, size, median, a, b);
        (shares.all < kWithinOne ? low : high) = a;
      }
      const double off =
          std::abs(shares.upper - shares.lower) + 10 * std::max(0.0, std::abs(shares.all - kWithinOne) - 0.01);
      if (!(off < least - 0.02)) continue;
      least = off;
      law.a(j) = a;
      law.b(j) = b;
    }
  }
  return law;
}

TrainingEllipse fitEllipse(const Eigen::MatrixXd& scaled, const std::vector<Fold>& folds) {
  std::vector<double> distances;
  for (const Fold& fold : folds) {
    std::vector<Eigen::Index> stay;
    std::size_t next = 0;
    for (Eigen::Index i = 0; i < scaled.cols(); ++i) {
      if (next < fold.judged.size() && fold.judged[next] == i)
        ++next;
      else
        stay.push_back(i);
    }
    if (stay.size() < 2) continue;
    const TrainingEllipse others = ellipseOf(scaled(Eigen::all, stay));
    for (const Eigen::Index i : fold.judged) distances.push_back(others.distance(scaled.col(i)));
  }
  TrainingEllipse ellipse = ellipseOf(scaled);
  ellipse.limit =
      distances.empty()
          ? std::numeric_limits<double>::max()
          : percentile(Eigen::Map<const Eigen::VectorXd>(distances.data(), static_cast<Eigen::Index>(distances.size())),
                       0.99);
  return ellipse;
}

Judge::Judge(const Eigen::MatrixXd& targets) : targets_(targets) {
  const Eigen::RowVectorXd low = targets.colwise().minCoeff(), high = targets.colwise().maxCoeff();
  low_ = low - kBeyondRange * (high - low);
  high_ = high + kBeyondRange * (high - low);
  variance_ =
      (targets.rowwise() - targets.colwise().mean()).colwise().squaredNorm() / static_cast<double>(targets.rows());
  if (!(variance_.maxCoeff() > 0)) throw NetworkError("the forces do not vary");
}

Eigen::MatrixXd Judge::limited(const Eigen::MatrixXd& errors) const {
  Eigen::MatrixXd all = errors;
  for (Eigen::Index i = 0; i < all.rows(); ++i)
    all.row(i) = targets_.row(i) - (targets_.row(i) - errors.row(i)).cwiseMax(low_).cwiseMin(high_);
  return all;
}

double Judge::score(const Eigen::MatrixXd& limitedErrors) const {
  double sum = 0;
  int varying = 0;
  for (Eigen::Index j = 0; j < variance_.size(); ++j) {
    if (!(variance_(j) > 0)) continue;
    sum += limitedErrors.col(j).squaredNorm() / static_cast<double>(limitedErrors.rows()) / variance_(j);
    ++varying;
  }
  return std::isfinite(sum) ? std::sqrt(sum / varying) : std::numeric_limits<double>::infinity();
}

Eigen::VectorXd rootMeanSquareOfColumns(const Eigen::MatrixXd& errors) {
  return errors.array().square().colwise().mean().sqrt().transpose();
}

} // namespace palp
