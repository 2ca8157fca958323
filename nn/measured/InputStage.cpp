#include "nn/measured/InputStage.h"

#include "nn/NetworkError.h"

#include <cmath>

namespace palp {

Eigen::Index InputStage::inputs(Eigen::Index readings) const {
  const Eigen::Index signals = weights.size() > 0 ? weights.rows() : readings;
  return readings + signals * static_cast<Eigen::Index>(times_s.size());
}

Eigen::MatrixXd InputStage::transformed(const Eigen::Ref<const Eigen::MatrixXd>& readings) const {
  switch (transform) {
  case ReadingTransform::None:
    return readings;
  case ReadingTransform::Logarithm:
    return readings.array().log();
  case ReadingTransform::Inverse:
    return readings.cwiseInverse();
  }
  return readings;
}

Eigen::MatrixXd InputStage::rememberedOf(const Eigen::Ref<const Eigen::MatrixXd>& transformed) const {
  if (weights.size() == 0) return transformed;
  return (weights * transformed).colwise() + constant;
}

Eigen::MatrixXd InputStage::held(const Eigen::Ref<const Eigen::MatrixXd>& readings) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(inputs(readings.rows()), readings.cols());
  result.topRows(readings.rows()) = transformed(readings);
  return result;
}

Eigen::MatrixXd InputStage::slope(const Eigen::Ref<const Eigen::VectorXd>& readings) const {
  Eigen::VectorXd direct = Eigen::VectorXd::Ones(readings.size());
  if (transform == ReadingTransform::Logarithm) direct = readings.cwiseInverse();
  if (transform == ReadingTransform::Inverse) direct = -readings.cwiseInverse().cwiseAbs2();
  Eigen::MatrixXd result(inputs(readings.size()), readings.size());
  result.topRows(readings.size()) = direct.asDiagonal();
  if (!hasMemory()) return result;
  const Eigen::MatrixXd remembered =
      weights.size() == 0 ? Eigen::MatrixXd(direct.asDiagonal()) : Eigen::MatrixXd(weights * direct.asDiagonal());
  result.bottomRows(result.rows() - readings.size()) =
      remembered.replicate(static_cast<Eigen::Index>(times_s.size()), 1);
  return result;
}

Eigen::MatrixXd InputStage::apply(const Eigen::Ref<const Eigen::MatrixXd>& readings, const Eigen::MatrixXd& clock_s,
                                  const Eigen::MatrixXd& runs) const {
  const Eigen::MatrixXd direct = transformed(readings);
  if (!hasMemory()) return direct;
  if (!rowsAreClock && clock_s.rows() == 0 && readings.cols() > 0)
    throw NetworkError("the network has a memory and needs the time of each sample");
  const Eigen::MatrixXd all = rememberedOf(direct);
  Eigen::MatrixXd result(inputs(readings.rows()), readings.cols());
  result.topRows(readings.rows()) = direct;
  MemoryStates states(times_s, longestGap_s);
  for (Eigen::Index i = 0; i < readings.cols(); ++i) {
    if (i > 0 && runs.rows() > 0 && runs(0, i) != runs(0, i - 1)) states.reset();
    result.col(i).tail(result.rows() - readings.rows()) =
        states.next(rowsAreClock ? static_cast<double>(i) : clock_s(0, i), all.col(i));
  }
  return result;
}

const Eigen::VectorXd& MemoryStates::next(double time_s, const Eigen::Ref<const Eigen::VectorXd>& signals) {
  const auto times = static_cast<Eigen::Index>(times_s_.size());
  const double gap_s = time_s - time_s_;
  if (!started_ || gap_s < 0 || (longestGap_s_ > 0 && gap_s > longestGap_s_)) {
    started_ = true;
    states_ = signals.replicate(1, times);
    differences_.setZero(signals.size() * times);
  } else {
    for (Eigen::Index k = 0; k < times; ++k) {
      // s_new = a s + (c - a) g_old + (1 - c) g_new with a = exp(-h), c = (1 - a) / h, h = gap / tau.
      const double h = gap_s / times_s_[static_cast<std::size_t>(k)];
      const double a = std::exp(-h), c = h > 1e-6 ? -std::expm1(-h) / h : 1 - h / 2;
      states_.col(k) = a * states_.col(k) + (c - a) * before_ + (1 - c) * signals;
      differences_.segment(k * signals.size(), signals.size()) = signals - states_.col(k);
    }
  }
  time_s_ = time_s;
  before_ = signals;
  return differences_;
}

} // namespace palp
