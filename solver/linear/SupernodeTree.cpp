#include "solver/linear/SupernodeTree.h"

#include "model/base/Error.h"
#include "solver/linear/NestedDissection.h"

#include <cholmod.h>

#include <algorithm>
#include <new>
#include <numeric>
#include <string>

namespace palp {

namespace {

/// Groups up to which supernodes are merged for more and more zeros; CHOLMOD's own are meant for single unknowns.
constexpr std::size_t mergedUpTo[] = {2, 6, 16};

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
    for (int i = 0; i < 3; ++i) c.nrelax[i] = mergedUpTo[i];
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

/// The groups' columns and rows, coupled so that the last groups stay last when CHOLMOD brings the order into
/// postorder: each part that the others fall into without them is coupled to the first of them, and each of them to the
/// next. So they are one path of the elimination tree, below which all else hangs. Where they are coupled anyway, as
/// those of a surface over one connected body are, that changes nothing.
struct Coupled {
  std::vector<int> columns, rows;
};
Coupled coupled(const SparsePattern& pattern) {
  const auto groups = static_cast<int>(pattern.groupColumns.size()) - 1;
  std::vector<bool> isLast(groups);
  for (const int g : pattern.lastGroups) isLast[g] = true;
  std::vector<int> part(groups); // another group of the same part, nearer to its representative, or that itself
  std::iota(part.begin(), part.end(), 0);
  const auto representative = [&](int g) {
    while (part[g] != g) g = part[g] = part[part[g]];
    return g;
  };
  std::vector<std::vector<int>> below(groups);
  for (int g = 0; g < groups; ++g) {
    below[g].assign(pattern.groupRows.begin() + pattern.groupColumns[g],
                    pattern.groupRows.begin() + pattern.groupColumns[g + 1]);
    for (const int other : below[g])
      if (!isLast[g] && !isLast[other]) part[representative(other)] = representative(g);
  }
  const auto couple = [&](int a, int b) { below[std::min(a, b)].push_back(std::max(a, b)); };
  for (int g = 0; g < groups; ++g)
    if (!isLast[g] && part[g] == g) couple(g, pattern.lastGroups.front());
  for (std::size_t i = 1; i < pattern.lastGroups.size(); ++i) couple(pattern.lastGroups[i - 1], pattern.lastGroups[i]);
  Coupled result{{0}, {}};
  for (std::vector<int>& rows : below) {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    result.rows.insert(result.rows.end(), rows.begin(), rows.end());
    result.columns.push_back(static_cast<int>(result.rows.size()));
  }
  return result;
}

/// The tree of the unknowns from that of their groups.
SupernodeTree expanded(const cholmod_factor& factor, const SparsePattern& pattern) {
  const auto groups = static_cast<int>(factor.n);
  const int* groupAt = static_cast<const int*>(factor.Perm);
  const int* super = static_cast<const int*>(factor.super);
  const int* rowStart = static_cast<const int*>(factor.pi);
  const int* rows = static_cast<const int*>(factor.s);
  SupernodeTree tree;
  std::vector<int> firstRow{0}; // of each group in the factor
  for (int p = 0; p < groups; ++p) {
    for (int i = pattern.groupStart[groupAt[p]]; i < pattern.groupStart[groupAt[p] + 1]; ++i) tree.order.push_back(i);
    firstRow.push_back(static_cast<int>(tree.order.size()));
  }
  std::vector<int> supernodeOf(groups);
  tree.first = {0};
  tree.rowStart = {0};
  for (int s = 0; s < static_cast<int>(factor.nsuper); ++s) {
    tree.first.push_back(firstRow[super[s + 1]]);
    for (int p = super[s]; p < super[s + 1]; ++p) supernodeOf[p] = s;
    for (int r = rowStart[s]; r < rowStart[s + 1]; ++r)
      for (int i = firstRow[rows[r]]; i < firstRow[rows[r] + 1]; ++i) tree.rows.push_back(i);
    tree.rowStart.push_back(tree.rows.size());
  }
  for (int s = 0; s < static_cast<int>(factor.nsuper); ++s) {
    const int below = rowStart[s] + super[s + 1] - super[s];
    tree.parent.push_back(below < rowStart[s + 1] ? supernodeOf[rows[below]] : -1);
  }
  return tree;
}

} // namespace

SupernodeTree supernodeTree(const SparsePattern& pattern) {
  Common common;
  std::vector<int> order = nestedDissection(pattern);
  const Coupled some = pattern.lastGroups.empty() ? Coupled{} : coupled(pattern);
  cholmod_sparse groups =
      pattern.lastGroups.empty() ? view(pattern.groupColumns, pattern.groupRows) : view(some.columns, some.rows);
  cholmod_factor* factor = cholmod_analyze_p(&groups, order.data(), nullptr, 0, &common.c);
  if (!factor && common.c.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  if (!factor)
    throw Error("the mesh has " + std::to_string(pattern.groupColumns.size()) +
                " nodes, whose matrix is larger than the factorisation can number; choose a coarser mesh");
  SupernodeTree tree = expanded(*factor, pattern);
  cholmod_free_factor(&factor, &common.c);
  return tree;
}

} // namespace palp
