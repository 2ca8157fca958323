#pragma once

#include <cstddef>

/// The hot loops, compiled for several instruction sets and chosen at run time; plain pointers, no Eigen, so that no
/// inline code of others is compiled for a machine that may not be there.
namespace palp::kernels {

/// Lanes that a block of packed centres has.
inline constexpr std::size_t kBlockLanes = 16;

/// values[i] = exp(-rate * values[i]), values >= 0, to 1 ulp or so; exponents below -708 give 0.
void gaussian(double* values, std::size_t count, double rate);

/// values[i] = exp(-t) - 1 + t with t = rate * values[i] >= 0, to a few ulp also where t is small.
void gaussianRemainder(double* values, std::size_t count, double rate);

/// result[i] = sum_d (rows[d * stride + i] - point[d])^2: `count` points stored input by input.
void squaredDistancesToPoint(const double* rows, std::size_t stride, std::size_t count, std::size_t dimensions,
                             const double* point, double* result);

/// Columns that splines over two places weigh: four along each.
inline constexpr std::size_t kSplineColumns = 16;
/// results[o * rows + i] = sum_c columns[c][i] shares[o * kSplineColumns + c] for three results o: each number is read
/// once.
void threeSums(const double* const* columns, std::size_t rows, const double* shares, double* results);
/// The same of columns in single precision, summed in double: half of the memory to be read.
void threeSums(const float* const* columns, std::size_t rows, const double* shares, double* results);

/// Packed Gaussian network.
struct PackedNetwork {
  std::size_t inputs, outputs, blocks;
  double rate;           ///< gamma of exp(-gamma r^2)
  bool remainder;        ///< the basis is exp(-gamma r^2) - 1 + gamma r^2
  const double* centers; ///< [block][input][lane]
  const double* weights; ///< [output][block][lane]
};

/// output[o] += sum_c weights[o][c] basis(|scaled - c|^2) for one sample; `basis` is scratch, one double a lane of the
/// blocks.
void addGaussians(const PackedNetwork& network, const double* scaled, double* basis, double* output);
/// The same, to the bit, for eight samples together: scaled[s * inputs + d], basis[s * blocks * lanes + c],
/// output[s * outputs + o].
void addGaussiansEight(const PackedNetwork& network, const double* scaled, double* basis, double* output);

} // namespace palp::kernels
