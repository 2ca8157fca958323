#include "solver/SupernodeTree.h"

#include <cholmod.h>

#include <stdexcept>

namespace palp {

namespace {

/// CHOLMOD's workspace, freed at the end of its scope.
struct Common {
  cholmod_common c;
  Common() {
    cholmod_start(&c);
    c.print = 0;
    c.supernodal = CHOLMOD_SUPERNODAL;
    c.nmethods = 1;
    c.method[0].ordering = CHOLMOD_GIVEN;
    c.postorder = 1;
  }
  ~Common() { cholmod_finish(&c); }
  Common(const Common&) = delete;
  Common& operator=(const Common&) = delete;
};

cholmod_sparse view(const std::vector<int>& columns, const std::vector<int>& rows) {
  cholmod_sparse A{};
  A.nrow = A.ncol = columns.size() - 1;
  A.nzmax = rows.size();
  A.p = const_cast<int*>(columns.data()); // read only
  A.i = const_cast<int*>(rows.data());
  A.stype = -1;
  A.itype = CHOLMOD_INT;
  A.xtype = CHOLMOD_PATTERN;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = A.packed = 1;
  return A;
}

std::vector<int> fillReducingOrder(const SparsePattern& pattern, Common& common) {
  cholmod_sparse groups = view(pattern.groupColumns, pattern.groupRows);
  std::vector<int> groupOrder(groups.nrow), order;
  if (!cholmod_metis(&groups, nullptr, 0, 1, groupOrder.data(), &common.c))
    throw std::runtime_error("the sparse matrix could not be ordered (memory?)");
  order.reserve(pattern.size());
  for (int g : groupOrder)
    for (int i = pattern.groupStart[g]; i < pattern.groupStart[g + 1]; ++i) order.push_back(i);
  return order;
}

template <class T> std::vector<T> copied(const void* from, std::size_t count) {
  const int* p = static_cast<const int*>(from);
  return {p, p + count};
}

SupernodeTree copied(const cholmod_factor& factor) {
  SupernodeTree tree;
  tree.order = copied<int>(factor.Perm, factor.n);
  tree.first = copied<int>(factor.super, factor.nsuper + 1);
  tree.rowStart = copied<std::size_t>(factor.pi, factor.nsuper + 1);
  tree.rows = copied<int>(factor.s, factor.ssize);
  std::vector<int> supernodeOf(factor.n);
  tree.panelStart = {0};
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    const int node = static_cast<int>(s);
    tree.panelStart.push_back(tree.panelStart.back() + std::size_t(tree.height(node)) * tree.width(node));
    for (int i = tree.first[s]; i < tree.first[s + 1]; ++i) supernodeOf[i] = node;
  }
  // CHOLMOD's own panel offsets are 32-bit; ours are not.
  tree.parent.resize(factor.nsuper, -1);
  for (int s = 0; s < tree.count(); ++s)
    if (tree.below(s) > 0) tree.parent[s] = supernodeOf[tree.rowsOf(s)[tree.width(s)]];
  return tree;
}

} // namespace

SupernodeTree supernodeTree(const SparsePattern& pattern) {
  Common common;
  std::vector<int> order = fillReducingOrder(pattern, common);
  cholmod_sparse A = view(pattern.columns, pattern.rows);
  cholmod_factor* factor = cholmod_analyze_p(&A, order.data(), nullptr, 0, &common.c);
  if (!factor) throw std::runtime_error("the sparse matrix could not be analysed (memory?)");
  SupernodeTree tree = copied(*factor);
  cholmod_free_factor(&factor, &common.c);
  return tree;
}

} // namespace palp
