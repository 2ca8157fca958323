#pragma once

#include "solver/field/FieldFunctions.h"
#include "solver/field/SphericalMeans.h"

#include <Eigen/Core>

#include <stop_token>
#include <vector>

namespace palp {

/// A conductivity k that varies over the deformed block. With l = ln(k)/2 and m = e^l a source is s_q / (m m_q), which
/// solves div(k grad .) but for the Laplacian of m (J. Liouville's substitution). Weakly:
///   integral k grad(s_q / (m m_q)) . grad v = v(x_q) + (oint m s_q,n v - integral grad m . grad(s_q v)) / m_q
/// Here are the integrals over the volume.
class HeterogeneousConductivity {
public:
  HeterogeneousConductivity(const FieldMesh& mesh, const Eigen::Matrix3Xd& nodes_mm, const FieldFunctions& functions,
                            int threads);

  /// `right` (functions x sources) += integral grad m . grad(s_q N_a);
  /// `products` += integral grad l . grad(s_p s_q) - |grad l|^2 s_p s_q, for p <= q.
  /// Each electrode is the first of its sources; within `cutoffs_mm` its own poles are as SphericalMeans has them. The
  /// same bytes at any number of threads.
  void addIntegrals(const std::vector<Eigen::Matrix3Xd>& sources_mm, const std::vector<AtElectrode>& electrodes,
                    const std::vector<double>& cutoffs_mm, int threads, const std::stop_token& stop, SourceRows& right,
                    Eigen::MatrixXd& products) const;

private:
  void addElements(int first, int count, const std::vector<Eigen::Matrix3Xd>& sources_mm, float* onElements,
                   Eigen::MatrixXd& products) const;
  /// Of an electrode's own 1/(4 pi r): s and s^2.
  struct Poles {
    double simple = 0, square = 0;
  };
  [[nodiscard]] Poles poles(const Eigen::Vector3d& centre_mm, double cutoff_mm) const;

  const FieldMesh* mesh_;
  const FieldFunctions* functions_;
  std::vector<int> elements_;                   ///< those in which k is not 1
  std::vector<Eigen::Index> first_;             ///< of each of their points, and one more
  Eigen::Matrix<double, Eigen::Dynamic, 6> at_; ///< their points x (place, volume times grad l)
  std::vector<double> spans_mm_;                ///< how far an element's points are from its first one
  Eigen::VectorXf squareSlopes_;                ///< |grad l|^2 / 2 times volume
  Eigen::MatrixXf shapes_, gradients_;          ///< 14 x points: m N_a, m grad l . grad N_a times volume
};

} // namespace palp
