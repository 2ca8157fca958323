#include "solver/SparseCholesky.h"

#include <cholmod.h>

#include <stdexcept>

extern "C" void openblas_set_num_threads(int);

namespace palp {

namespace {

cholmod_sparse view(const SparsePattern& pattern, double* values) {
  cholmod_sparse A{};
  A.nrow = A.ncol = pattern.size();
  A.nzmax = pattern.rows.size();
  A.p = const_cast<int*>(pattern.columns.data());
  A.i = const_cast<int*>(pattern.rows.data());
  A.x = values;
  A.stype = -1;
  A.itype = CHOLMOD_INT;
  A.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = A.packed = 1;
  return A;
}

cholmod_sparse groupView(const SparsePattern& pattern) {
  cholmod_sparse A = view(pattern, nullptr);
  A.nrow = A.ncol = pattern.groupColumns.size() - 1;
  A.nzmax = pattern.groupRows.size();
  A.p = const_cast<int*>(pattern.groupColumns.data());
  A.i = const_cast<int*>(pattern.groupRows.data());
  return A;
}

} // namespace

struct SparseCholesky::Cholmod {
  std::shared_ptr<const SparsePattern> pattern;
  cholmod_common common;
  cholmod_factor* factor = nullptr;

  explicit Cholmod(std::shared_ptr<const SparsePattern> p) : pattern(std::move(p)) {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
    common.quick_return_if_not_posdef = 1;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = 1;
    std::vector<int> order = ordering();
    cholmod_sparse A = view(*pattern, nullptr);
    factor = cholmod_analyze_p(&A, order.data(), nullptr, 0, &common);
    if (!factor) throw std::runtime_error("the sparse matrix could not be analysed (memory?)");
  }

  ~Cholmod() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }

  /// Fill-reducing order of the unknowns, from METIS on the groups.
  std::vector<int> ordering() {
    cholmod_sparse groups = groupView(*pattern);
    std::vector<int> groupOrder(groups.nrow), order;
    if (!cholmod_metis(&groups, nullptr, 0, 1, groupOrder.data(), &common))
      throw std::runtime_error("the sparse matrix could not be ordered");
    order.reserve(pattern->size());
    for (int g : groupOrder)
      for (int i = pattern->groupStart[g]; i < pattern->groupStart[g + 1]; ++i) order.push_back(i);
    return order;
  }
};

SparseCholesky::SparseCholesky(std::shared_ptr<const SparsePattern> pattern)
    : cholmod_(std::make_unique<Cholmod>(std::move(pattern))) {}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

bool SparseCholesky::factorise(std::span<const double> values) {
  // One thread in BLAS: its sums are cut by the number of threads.
  openblas_set_num_threads(1);
  cholmod_sparse A = view(*cholmod_->pattern, const_cast<double*>(values.data()));
  cholmod_factorize(&A, cholmod_->factor, &cholmod_->common);
  if (cholmod_->common.status < 0) throw std::runtime_error("the sparse factorisation failed (memory?)");
  return cholmod_->common.status == CHOLMOD_OK;
}

void SparseCholesky::solve(Eigen::Ref<Eigen::MatrixXd> rightSides) const {
  cholmod_common common;
  cholmod_start(&common);
  common.print = 0;
  cholmod_dense B{};
  B.nrow = rightSides.rows();
  B.d = rightSides.outerStride();
  B.ncol = rightSides.cols();
  B.nzmax = B.d * B.ncol;
  B.x = rightSides.data();
  B.xtype = CHOLMOD_REAL;
  B.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* X = cholmod_solve(CHOLMOD_A, cholmod_->factor, &B, &common);
  if (X) {
    rightSides = Eigen::Map<Eigen::MatrixXd>(static_cast<double*>(X->x), rightSides.rows(), rightSides.cols());
    cholmod_free_dense(&X, &common);
  }
  const bool failed = common.status < 0;
  cholmod_finish(&common);
  if (failed) throw std::runtime_error("the sparse solve failed (memory?)");
}

std::size_t SparseCholesky::factorEntries() const {
  return cholmod_->factor->xsize;
}

} // namespace palp
