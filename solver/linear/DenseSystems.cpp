#include "solver/linear/DenseSystems.h"

#include "solver/linear/Front.h"

#include <vector>

extern "C" void dpotri_(const char* uplo, const int* n, double* a, const int* lda, int* info);
extern "C" void dgesv_(const int* n, const int* columns, double* a, const int* lda, int* pivots, double* b,
                       const int* ldb, int* info);

namespace palp {

void invertFromCholesky(Eigen::MatrixXd& lower) {
  useOneBlasThread();
  const auto n = static_cast<int>(lower.rows());
  int info = 0;
  if (n > 0) dpotri_("L", &n, lower.data(), &n, &info);
}

bool solveDense(Eigen::MatrixXd& matrix, Eigen::VectorXd& rightSide) {
  useOneBlasThread();
  const auto n = static_cast<int>(matrix.rows());
  const int one = 1;
  int info = 0;
  std::vector<int> pivots(static_cast<std::size_t>(n));
  if (n > 0) dgesv_(&n, &one, matrix.data(), &n, pivots.data(), rightSide.data(), &n, &info);
  return info == 0 && rightSide.allFinite();
}

} // namespace palp
