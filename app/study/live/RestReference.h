#pragma once

#include "io/board/BoardFrame.h"

#include <optional>

namespace palp {

/// What the relative change of a reading counts from: the board's own rest where it was tared, else the network's
/// design at rest, else the first reading that was good.
class RestReference {
public:
  /// Starts over; `design_ohm` may be empty (not known).
  void reset(Eigen::MatrixXd design_ohm);
  /// Averages each reading over the next frames that hold it.
  void startTare(int frames);
  /// Known from elsewhere.
  void setTare(Eigen::MatrixXd rest_ohm);
  void clearTare();
  void add(const BoardFrame& frame);

  /// R / R at rest - 1, row-wires x column-wires; NaN where the reading is not good.
  [[nodiscard]] Eigen::MatrixXd change(const BoardFrame& frame) const;
  /// As text: "the tared frames", "the design at rest" or "the first frame".
  [[nodiscard]] const char* name() const;

private:
  Eigen::MatrixXd design_ohm_;
  Eigen::MatrixXd first_ohm_; ///< 0 where no good reading has come
  Eigen::MatrixXd tared_ohm_; ///< empty: not tared
  Eigen::MatrixXd sum_ohm_, counts_;
  int tareLeft_ = 0;
};

} // namespace palp
