#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace palp {

/// Lower triangle of a symmetric matrix by columns, whose unknowns come in groups (the components of a node) that
/// share their pattern: the ordering is found on the groups.
struct SparsePattern {
  Eigen::Matrix3Xd groupPositions_mm; ///< 3 x groups
  std::vector<int> groupStart;        ///< first unknown of each group, and the number of unknowns
  std::vector<int> groupColumns;      ///< start of each group's column in groupRows
  std::vector<int> groupRows;         ///< groups at or below the diagonal, ascending, the diagonal first
  std::vector<int> columns;           ///< start of each unknown's column in rows
  std::vector<int> rows;              ///< unknowns at or below the diagonal, ascending
  std::vector<int> lastGroups{};      ///< to be eliminated after all others; most often none
  [[nodiscard]] int size() const { return groupStart.back(); }
};

/// Shape of the Cholesky factor L of P A P^T: runs of columns with the same rows below (supernodes), each a dense panel
/// of height x width numbers by columns; its first `width` rows are the columns' own. The parent of a supernode is the
/// one that owns the first of its rows below; children come before their parents (Davis, Direct Methods for Sparse
/// Linear Systems, 2006, chapter 4).
struct SupernodeTree {
  std::vector<int> order;            ///< P: the unknown that each row of the factor belongs to
  std::vector<int> first;            ///< first row of each supernode, and the number of unknowns
  std::vector<std::size_t> rowStart; ///< of each supernode in rows
  std::vector<int> rows;             ///< rows of the factor in each panel, ascending; the supernode's own come first
  std::vector<int> parent;           ///< -1: a root

  [[nodiscard]] int count() const { return static_cast<int>(parent.size()); }
  [[nodiscard]] int size() const { return first.back(); }
  [[nodiscard]] int width(int s) const { return first[s + 1] - first[s]; }
  [[nodiscard]] int height(int s) const { return static_cast<int>(rowStart[s + 1] - rowStart[s]); }
  [[nodiscard]] int below(int s) const { return height(s) - width(s); }
  [[nodiscard]] const int* rowsOf(int s) const { return rows.data() + rowStart[s]; }
};

/// Fill-reducing order by nested dissection; the symbolic factorisation of the groups is CHOLMOD's.
SupernodeTree supernodeTree(const SparsePattern& pattern);

} // namespace palp
