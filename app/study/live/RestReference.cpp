#include "app/study/live/RestReference.h"

#include <limits>

namespace palp {

void RestReference::reset(Eigen::MatrixXd design_ohm) {
  design_ohm_ = std::move(design_ohm);
  first_ohm_.resize(0, 0);
  clearTare();
}

void RestReference::startTare(int frames) {
  tareLeft_ = frames;
  sum_ohm_.resize(0, 0);
}

void RestReference::setTare(Eigen::MatrixXd rest_ohm) {
  tareLeft_ = 0;
  tared_ohm_ = std::move(rest_ohm);
}

void RestReference::clearTare() {
  tareLeft_ = 0;
  tared_ohm_.resize(0, 0);
}

void RestReference::add(const BoardFrame& frame) {
  const Eigen::MatrixXd& now_ohm = frame.resistances_ohm;
  const auto good = (frame.state.array() == ReadingState::Good).eval();
  if (first_ohm_.size() != now_ohm.size()) first_ohm_ = Eigen::MatrixXd::Zero(now_ohm.rows(), now_ohm.cols());
  first_ohm_ = (good && first_ohm_.array() == 0).select(now_ohm, first_ohm_);
  if (tareLeft_ == 0) return;
  if (sum_ohm_.size() != now_ohm.size()) sum_ohm_ = counts_ = Eigen::MatrixXd::Zero(now_ohm.rows(), now_ohm.cols());
  sum_ohm_ += good.select(now_ohm, 0.0).matrix();
  counts_ += good.cast<double>().matrix();
  if (--tareLeft_ > 0) return;
  tared_ohm_ = (counts_.array() > 0).select(sum_ohm_.array() / counts_.array().max(1), 0.0);
}

Eigen::MatrixXd RestReference::change(const BoardFrame& frame) const {
  const Eigen::MatrixXd& now_ohm = frame.resistances_ohm;
  const Eigen::MatrixXd& rest_ohm = tared_ohm_.size() == now_ohm.size()
                                        ? tared_ohm_
                                        : (design_ohm_.size() == now_ohm.size() ? design_ohm_ : first_ohm_);
  if (rest_ohm.size() != now_ohm.size())
    return Eigen::MatrixXd::Constant(now_ohm.rows(), now_ohm.cols(), std::numeric_limits<double>::quiet_NaN());
  return (frame.state.array() == ReadingState::Good && rest_ohm.array() > 0)
      .select(now_ohm.array() / rest_ohm.array() - 1, std::numeric_limits<double>::quiet_NaN());
}

const char* RestReference::name() const {
  if (tared_ohm_.size() > 0) return "the tared frames";
  return design_ohm_.size() > 0 ? "the design at rest" : "the first frame";
}

} // namespace palp
