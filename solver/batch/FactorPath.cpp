#include "solver/batch/FactorPath.h"

#include <algorithm>

namespace palp {

FactorPath::FactorPath(const SupernodeTree& tree, std::span<const int> rows) {
  std::vector<char> on(std::size_t(tree.count()), 0);
  for (const int row : rows)
    if (row < tree.size())
      on[std::size_t(std::upper_bound(tree.first.begin(), tree.first.end(), row) - tree.first.begin() - 1)] = 1;
  for (int s = 0; s < tree.count(); ++s) { // children come before their parents
    if (!on[std::size_t(s)]) continue;
    if (const int parent = tree.parent[std::size_t(s)]; parent >= 0) on[std::size_t(parent)] = 1;
    if (supernodes_.empty() || supernodes_.back().second != s) supernodes_.emplace_back(s, s);
    supernodes_.back().second = s + 1;
  }
  for (const auto& [from, to] : supernodes_) {
    rows_.emplace_back(tree.first[std::size_t(from)], tree.first[std::size_t(to)]);
    rowCount_ += std::size_t(rows_.back().second - rows_.back().first);
  }
}

} // namespace palp
