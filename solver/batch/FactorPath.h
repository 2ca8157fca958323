#pragma once

#include "solver/linear/SupernodeTree.h"

#include <span>
#include <utility>
#include <vector>

namespace palp {

/// The part of a factor that some of its rows depend on: their supernodes and all ancestors of those. For a right-hand
/// side with entries in these rows alone the forward sweep stays within it, and these rows of the solution need no
/// other part of the backward sweep. It is small where these rows are the factor's last.
class FactorPath {
public:
  /// `rows` of the factor; rows past its last (padding) are ignored.
  FactorPath(const SupernodeTree& tree, std::span<const int> rows);

  using Range = std::pair<int, int>;                                                 ///< first, one past the last
  [[nodiscard]] const std::vector<Range>& supernodes() const { return supernodes_; } ///< ascending
  [[nodiscard]] const std::vector<Range>& rows() const { return rows_; }             ///< of the factor, ascending
  [[nodiscard]] std::size_t rowCount() const { return rowCount_; }

private:
  std::vector<Range> supernodes_, rows_;
  std::size_t rowCount_ = 0;
};

} // namespace palp
