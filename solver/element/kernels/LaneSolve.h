#pragma once

#include "solver/element/LaneKernels.h"
#include "solver/element/kernels/Pack.h"

namespace palp::PALP_KERNEL {

typedef float FloatPack __attribute__((vector_size(8 * PALP_PACK)));
constexpr int floatPackSize = 2 * PALP_PACK;
constexpr int rowsABlock = factorBlockRows;

PALP_INLINE FloatPack loadFloats(const float* p) {
  FloatPack v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
PALP_INLINE void storeFloats(float* p, FloatPack v) {
  __builtin_memcpy(p, &v, sizeof v);
}

/// Packs that go through the factor together, and rows of a block at a time, for which there are registers.
constexpr int mostPacks = PALP_PACK > 2 ? 2 : 1;
template <int Packs> constexpr int rowsTogether = PALP_PACK == 8 || Packs == 1 ? rowsABlock : rowsABlock / 2;

template <int Packs> struct Rows { FloatPack row[rowsABlock][Packs]; };

/// sums[r] = sum over k of block[k][r] x[k] for one block of rows.
template <int Packs> PALP_INLINE void rowSums(const float* block, int columns, const float* x, Rows<Packs>& sums) {
  constexpr int count = rowsTogether<Packs>;
  for (int r0 = 0; r0 < rowsABlock; r0 += count) {
    FloatPack sum[count][Packs] = {};
    for (int k = 0; k < columns; ++k) {
      FloatPack v[Packs];
      for (int p = 0; p < Packs; ++p) v[p] = loadFloats(x + k * batchColumns + p * floatPackSize);
      for (int r = 0; r < count; ++r)
        for (int p = 0; p < Packs; ++p) sum[r][p] += block[k * rowsABlock + r0 + r] * v[p];
    }
    for (int r = 0; r < count; ++r)
      for (int p = 0; p < Packs; ++p) sums.row[r0 + r][p] = sum[r][p];
  }
}

/// The same for several columns, whose sums are independent of each other.
template <int Packs, int Columns> PALP_INLINE void subtractColumns(const float* block, const Rows<Packs>& t, float* x) {
  FloatPack v[Columns][Packs];
  for (int k = 0; k < Columns; ++k)
    for (int p = 0; p < Packs; ++p) v[k][p] = loadFloats(x + k * batchColumns + p * floatPackSize);
  for (int r = 0; r < rowsABlock; ++r)
    for (int k = 0; k < Columns; ++k)
      for (int p = 0; p < Packs; ++p) v[k][p] -= block[k * rowsABlock + r] * t.row[r][p];
  for (int k = 0; k < Columns; ++k)
    for (int p = 0; p < Packs; ++p) storeFloats(x + k * batchColumns + p * floatPackSize, v[k][p]);
}

/// x[k] -= sum over r of block[k][r] t[r] for one block of rows. The next block is stored before this one, which
/// the hardware does not prefetch: it is prefetched here, which saves a third of the time.
template <int Packs>
PALP_INLINE void subtractTransposed(const float* block, int columns, const Rows<Packs>& t, float* x) {
  constexpr int together = 2; // a cache line of the block
  int k = 0;
  for (; k + together <= columns; k += together) {
    __builtin_prefetch(block + (k - columns) * rowsABlock);
    subtractColumns<Packs, together>(block + k * rowsABlock, t, x + k * batchColumns);
  }
  for (; k < columns; ++k) subtractColumns<Packs, 1>(block + k * rowsABlock, t, x + k * batchColumns);
}

/// Lanes that have right sides, in pieces that go through the factor together. A block of the factor's rows serves all
/// of them before the next is read: the panels of wide supernodes fit no cache.
struct LivePieces {
  int count = 0;
  int lane[batchColumns / floatPackSize], packs[batchColumns / floatPackSize];
};
PALP_INLINE LivePieces livePieces(unsigned live) {
  LivePieces pieces;
  for (int lane = 0; lane < batchColumns; lane += floatPackSize) {
    unsigned any = 0;
    for (int block = lane / 8; block <= (lane + floatPackSize - 1) / 8; ++block) any |= live >> block & 1U;
    if (any == 0) continue;
    const int last = pieces.count - 1;
    if (mostPacks > 1 && last >= 0 && pieces.packs[last] == 1 && pieces.lane[last] + floatPackSize == lane) {
      pieces.packs[last] = mostPacks;
      continue;
    }
    pieces.lane[pieces.count] = lane;
    pieces.packs[pieces.count++] = 1;
  }
  return pieces;
}

template <int Packs> PALP_INLINE void forwardOwnRows(const float* block, int r0, int rows, float* own) {
  const float* triangle = block + r0 * rowsABlock;
  Rows<Packs> sums;
  rowSums(block, r0, own, sums);
  for (int r = 0; r < rows; ++r)
    for (int p = 0; p < Packs; ++p) {
      float* column = own + p * floatPackSize;
      FloatPack v = loadFloats(column + (r0 + r) * batchColumns) - sums.row[r][p];
      for (int k = 0; k < r; ++k) v -= triangle[k * rowsABlock + r] * loadFloats(column + (r0 + k) * batchColumns);
      storeFloats(column + (r0 + r) * batchColumns, v * triangle[r * rowsABlock + r]);
    }
}

template <int Packs>
PALP_INLINE void forwardRowsBelow(const float* block, int width, const float* own, const int* rows, float* x) {
  Rows<Packs> sums;
  rowSums(block, width, own, sums);
  for (int r = 0; r < rowsABlock; ++r)
    for (int p = 0; p < Packs; ++p) {
      float* y = x + std::size_t(rows[r]) * batchColumns + p * floatPackSize;
      storeFloats(y, loadFloats(y) - sums.row[r][p]);
    }
}

/// Forward substitution through one supernode: its own rows, then those below.
PALP_INLINE void forwardSupernode(const BlockedFactor& L, int s, float* x, const LivePieces& live) {
  const int width = L.first[s + 1] - L.first[s];
  const float* block = L.values + L.start[s];
  float* own = x + std::size_t(L.first[s]) * batchColumns;
  for (int r0 = 0; r0 < width; r0 += rowsABlock) {
    const int rows = width - r0 < rowsABlock ? width - r0 : rowsABlock;
    for (int i = 0; i < live.count; ++i)
      if (live.packs[i] == 1)
        forwardOwnRows<1>(block, r0, rows, own + live.lane[i]);
      else
        forwardOwnRows<mostPacks>(block, r0, rows, own + live.lane[i]);
    block += (r0 + rowsABlock) * rowsABlock;
  }
  for (int b = L.blockStart[s]; b < L.blockStart[s + 1]; ++b, block += width * rowsABlock) {
    const int* rows = L.rows + std::size_t(b) * rowsABlock;
    for (int i = 0; i < live.count; ++i)
      if (live.packs[i] == 1)
        forwardRowsBelow<1>(block, width, own + live.lane[i], rows, x + live.lane[i]);
      else
        forwardRowsBelow<mostPacks>(block, width, own + live.lane[i], rows, x + live.lane[i]);
  }
}

template <int Packs>
PALP_INLINE void backwardRowsBelow(const float* block, int width, const int* rows, const float* x, float* own) {
  Rows<Packs> t;
  for (int r = 0; r < rowsABlock; ++r)
    for (int p = 0; p < Packs; ++p)
      t.row[r][p] = loadFloats(x + std::size_t(rows[r]) * batchColumns + p * floatPackSize);
  subtractTransposed(block, width, t, own);
}

template <int Packs> PALP_INLINE void backwardOwnRows(const float* block, int r0, int rows, float* own) {
  const float* triangle = block + r0 * rowsABlock;
  Rows<Packs> t;
  for (int r = 0; r < rowsABlock; ++r)
    for (int p = 0; p < Packs; ++p) t.row[r][p] = FloatPack{};
  for (int r = rows - 1; r >= 0; --r)
    for (int p = 0; p < Packs; ++p) {
      float* value = own + (r0 + r) * batchColumns + p * floatPackSize;
      FloatPack v = loadFloats(value);
      for (int k = r + 1; k < rows; ++k) v -= triangle[r * rowsABlock + k] * t.row[k][p];
      t.row[r][p] = v * triangle[r * rowsABlock + r];
      storeFloats(value, t.row[r][p]);
    }
  subtractTransposed(block, r0, t, own);
}

/// Backward substitution, in the opposite order over the same blocks.
PALP_INLINE void backwardSupernode(const BlockedFactor& L, int s, float* x, const LivePieces& live) {
  const int width = L.first[s + 1] - L.first[s];
  const float* block = L.values + L.start[s + 1];
  float* own = x + std::size_t(L.first[s]) * batchColumns;
  constexpr bool together = rowsTogether<mostPacks> == rowsABlock; // all rows of a block have registers
  for (int b = L.blockStart[s + 1] - 1; b >= L.blockStart[s]; --b) {
    block -= width * rowsABlock;
    const int* rows = L.rows + std::size_t(b) * rowsABlock;
    for (int i = 0; i < live.count; ++i)
      if (together && live.packs[i] == mostPacks)
        backwardRowsBelow<mostPacks>(block, width, rows, x + live.lane[i], own + live.lane[i]);
      else
        for (int lane = live.lane[i], p = 0; p < live.packs[i]; ++p, lane += floatPackSize)
          backwardRowsBelow<1>(block, width, rows, x + lane, own + lane);
  }
  for (int r0 = (width - 1) / rowsABlock * rowsABlock; r0 >= 0; r0 -= rowsABlock) {
    block -= (r0 + rowsABlock) * rowsABlock;
    const int rows = width - r0 < rowsABlock ? width - r0 : rowsABlock;
    for (int i = 0; i < live.count; ++i)
      if (together && live.packs[i] == mostPacks)
        backwardOwnRows<mostPacks>(block, r0, rows, own + live.lane[i]);
      else
        for (int lane = live.lane[i], p = 0; p < live.packs[i]; ++p, lane += floatPackSize)
          backwardOwnRows<1>(block, r0, rows, own + lane);
  }
}

PALP_INLINE void forwardLanes(const BlockedFactor& L, int first, int last, unsigned live, float* x) {
  const LivePieces pieces = livePieces(live);
  for (int s = first; s < last; ++s) forwardSupernode(L, s, x, pieces);
}

PALP_INLINE void backwardLanes(const BlockedFactor& L, int first, int last, unsigned live, float* x) {
  const LivePieces pieces = livePieces(live);
  for (int s = last - 1; s >= first; --s) backwardSupernode(L, s, x, pieces);
}

typedef float NarrowPack __attribute__((vector_size(4 * PALP_PACK)));

PALP_INLINE NarrowPack loadNarrow(const float* p) {
  NarrowPack v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
PALP_INLINE Pack wide(NarrowPack v) {
  return __builtin_convertvector(v, Pack);
}

constexpr int packsABlock = rowsABlock / packSize;

/// The rows of a block in one column, in double precision.
PALP_INLINE void widen(const float* column, Pack rows[packsABlock]) {
  for (int i = 0; i < packsABlock; ++i) rows[i] = wide(loadNarrow(column + i * packSize));
}

/// sums[r] = sum over k of block[k][r] x[k].
PALP_INLINE void rowSumsOfOne(const float* block, int columns, const double* x, double sums[rowsABlock]) {
  constexpr int chains = 4; // so that one addition need not wait for the last
  Pack partial[chains][packsABlock] = {};
  Pack rows[packsABlock];
  int k = 0;
  for (; k + chains <= columns; k += chains)
    for (int c = 0; c < chains; ++c) {
      widen(block + std::size_t(k + c) * rowsABlock, rows);
      for (int i = 0; i < packsABlock; ++i) partial[c][i] += rows[i] * x[k + c];
    }
  for (; k < columns; ++k) {
    widen(block + std::size_t(k) * rowsABlock, rows);
    for (int i = 0; i < packsABlock; ++i) partial[0][i] += rows[i] * x[k];
  }
  for (int i = 0; i < packsABlock; ++i)
    store(sums + i * packSize, (partial[0][i] + partial[1][i]) + (partial[2][i] + partial[3][i]));
}

/// x[k] -= sum over b and r of blocks[b][k][r] t[b][r], for several blocks, `size` numbers apart; as many
/// blocks before them come next.
template <int Blocks>
PALP_INLINE void subtractTransposedOfOne(const float* blocks, std::size_t size, int columns, const double* t,
                                         double* x) {
  Pack factors[Blocks][packsABlock];
  for (int b = 0; b < Blocks; ++b)
    for (int i = 0; i < packsABlock; ++i) factors[b][i] = load(t + b * rowsABlock + i * packSize);
  Pack rows[packsABlock];
  for (int k = 0; k < columns; ++k) {
    Pack products{};
    for (int b = 0; b < Blocks; ++b) {
      const float* column = blocks + b * size + std::size_t(k) * rowsABlock;
      __builtin_prefetch(column - Blocks * size);
      widen(column, rows);
      for (int i = 0; i < packsABlock; ++i) products += rows[i] * factors[b][i];
    }
    double sum = 0;
    for (int i = 0; i < packSize; ++i) sum += products[i];
    x[k] -= sum;
  }
}

PALP_INLINE void forwardSupernodeOfOne(const BlockedFactor& L, int s, double* x) {
  const int width = L.first[s + 1] - L.first[s];
  const float* block = L.values + L.start[s];
  double* own = x + L.first[s];
  for (int r0 = 0; r0 < width; r0 += rowsABlock) {
    double sums[rowsABlock];
    rowSumsOfOne(block, r0, own, sums);
    const float* triangle = block + r0 * rowsABlock;
    const int rows = width - r0 < rowsABlock ? width - r0 : rowsABlock;
    for (int r = 0; r < rows; ++r) {
      double v = own[r0 + r] - sums[r];
      for (int k = 0; k < r; ++k) v -= double(triangle[k * rowsABlock + r]) * own[r0 + k];
      own[r0 + r] = v * double(triangle[r * rowsABlock + r]);
    }
    block = triangle + rowsABlock * rowsABlock;
  }
  for (int b = L.blockStart[s]; b < L.blockStart[s + 1]; ++b, block += width * rowsABlock) {
    double sums[rowsABlock];
    rowSumsOfOne(block, width, own, sums);
    const int* rows = L.rows + std::size_t(b) * rowsABlock;
    for (int r = 0; r < rowsABlock; ++r) x[rows[r]] -= sums[r];
  }
}

PALP_INLINE void backwardSupernodeOfOne(const BlockedFactor& L, int s, double* x) {
  const int width = L.first[s + 1] - L.first[s];
  const float* block = L.values + L.start[s + 1];
  double* own = x + L.first[s];
  constexpr int together = 4; // sums across lanes are slow
  double t[together * rowsABlock];
  const auto gather = [&](int b, int blocks) {
    const int* rows = L.rows + std::size_t(b) * rowsABlock;
    for (int r = 0; r < blocks * rowsABlock; ++r) t[r] = x[rows[r]];
  };
  const std::size_t size = std::size_t(width) * rowsABlock;
  int b = L.blockStart[s + 1];
  for (; b - together >= L.blockStart[s]; b -= together) {
    block -= together * size;
    gather(b - together, together);
    subtractTransposedOfOne<together>(block, size, width, t, own);
  }
  for (; b > L.blockStart[s]; --b) {
    block -= size;
    gather(b - 1, 1);
    subtractTransposedOfOne<1>(block, size, width, t, own);
  }
  for (int r0 = (width - 1) / rowsABlock * rowsABlock; r0 >= 0; r0 -= rowsABlock) {
    block -= (r0 + rowsABlock) * rowsABlock;
    const float* triangle = block + r0 * rowsABlock;
    const int rows = width - r0 < rowsABlock ? width - r0 : rowsABlock;
    for (int r = 0; r < rowsABlock; ++r) t[r] = 0;
    for (int r = rows - 1; r >= 0; --r) {
      double v = own[r0 + r];
      for (int k = r + 1; k < rows; ++k) v -= double(triangle[r * rowsABlock + k]) * t[k];
      own[r0 + r] = t[r] = v * double(triangle[r * rowsABlock + r]);
    }
    subtractTransposedOfOne<1>(block, std::size_t(r0) * rowsABlock, r0, t, own);
  }
}

/// out[row][8] += sum over t of coefficients[row][t] monomials[t][8].
PALP_INLINE void evaluatePolynomials(const double* coefficients, int terms, const double* monomials, int rows,
                                     double* out, int stride) {
  for (int row = 0; row < rows; ++row)
    for (int lane = 0; lane < 8; lane += packSize) {
      Pack sum = load(out + std::size_t(row) * stride + lane);
      for (int t = 0; t < terms; ++t)
        sum += coefficients[std::size_t(row) * terms + t] * load(monomials + 8 * t + lane);
      store(out + std::size_t(row) * stride + lane, sum);
    }
}

/// An element's part of values at the nodes.
PALP_INLINE void gatherRows(const double* values, const int* nodes, int count, double* out) {
  for (int n = 0; n < count; ++n) {
    const double* node = values + 3 * std::size_t(nodes[n]) * batchColumns;
    for (int d = 0; d < 3; ++d, node += batchColumns, out += 8)
      for (int lane = 0; lane < 8; lane += packSize) store(out + lane, load(node + lane));
  }
}

/// values -= an element's forces at its nodes.
PALP_INLINE void subtractRows(const double* forces, const int* nodes, int count, double* values) {
  for (int n = 0; n < count; ++n) {
    double* node = values + 3 * std::size_t(nodes[n]) * batchColumns;
    for (int d = 0; d < 3; ++d, node += batchColumns, forces += 8)
      for (int lane = 0; lane < 8; lane += packSize) store(node + lane, load(node + lane) - load(forces + lane));
  }
}

/// Lanes from `lane` on, one register, of scale x[row].
PALP_INLINE Pack scaled(const float* x, int row, const double* scale, int lane) {
  return load(scale + lane) * wide(loadNarrow(x + std::size_t(row) * batchColumns + lane));
}

PALP_INLINE void gatherScaledRows(const float* x, const int* rows, const double* scale, const int* nodes, int count,
                                  double* out) {
  for (int n = 0; n < count; ++n)
    for (int d = 0; d < 3; ++d, out += 8)
      for (int lane = 0; lane < 8; lane += packSize) store(out + lane, scaled(x, rows[3 * nodes[n] + d], scale, lane));
}

} // namespace palp::PALP_KERNEL
