#pragma once

#include "solver/linear/SupernodeTree.h"

#include <span>
#include <utility>
#include <vector>

namespace palp {

/// The part of a factor that some of its rows depend on: their supernodes and all above those. Of a right side with
/// numbers in these rows alone the substitution forwards stays within it, and these rows of the solution need no other
/// part of the substitution backwards. Where these rows are the factor's last it is a small part.
class FactorPath {
public:
  /// `rows` of the factor; those past its last, which fill it up, count for nothing.
  FactorPath(const SupernodeTree& tree, std::span<const int> rows);

  using Range = std::pair<int, int>;                                                 ///< from, to before
  [[nodiscard]] const std::vector<Range>& supernodes() const { return supernodes_; } ///< ascending
  [[nodiscard]] const std::vector<Range>& rows() const { return rows_; }             ///< of the factor, ascending
  [[nodiscard]] std::size_t rowCount() const { return rowCount_; }

private:
  std::vector<Range> supernodes_, rows_;
  std::size_t rowCount_ = 0;
};

} // namespace palp
