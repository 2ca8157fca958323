#pragma once

#include <Eigen/Core>

#include <memory>
#include <span>
#include <vector>

namespace palp {

/// Lower triangle of a symmetric matrix by columns, whose unknowns come in groups (the components of a node) that
/// share their pattern: the ordering is found on the groups.
struct SparsePattern {
  std::vector<int> groupStart;   ///< first unknown of each group, and the number of unknowns
  std::vector<int> groupColumns; ///< start of each group's column in groupRows
  std::vector<int> groupRows;    ///< groups at or below the diagonal, ascending, the diagonal first
  std::vector<int> columns;      ///< start of each unknown's column in rows
  std::vector<int> rows;         ///< unknowns at or below the diagonal, ascending
  [[nodiscard]] int size() const { return groupStart.back(); }
};

/// Sparse Cholesky factorisation by supernodes (CHOLMOD with METIS on OpenBLAS). The answers do not depend on the
/// number of threads.
class SparseCholesky {
public:
  explicit SparseCholesky(std::shared_ptr<const SparsePattern> pattern);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// False: the matrix is not positive definite.
  [[nodiscard]] bool factorise(std::span<const double> values);
  /// Solves in place, one column a right side.
  void solve(Eigen::Ref<Eigen::MatrixXd> rightSides) const;
  [[nodiscard]] std::size_t factorEntries() const;

private:
  struct Cholmod;
  std::unique_ptr<Cholmod> cholmod_;
};

} // namespace palp
