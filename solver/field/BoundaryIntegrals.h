#pragma once

#include "solver/field/BoundaryQuadrature.h"
#include "solver/field/FieldFunctions.h"
#include "solver/field/FieldMesh.h"

#include <stop_token>
#include <vector>

namespace palp {

/// What the sources of all electrodes make of the boundary of the deformed block. For k = 1 the product of two of them,
///   oint s_p s_q,n dS = sum over nodes a of s_p(x_a) oint N_a s_q,n dS + oint (s_p - I s_p) s_q,n dS,
/// needs the points of a quadrature for the second part alone, I s_p being quadratic between the nodes' values, and of
/// the faces near p alone: what the others leave of it is 1e-7 of R.
class BoundaryIntegrals {
public:
  BoundaryIntegrals(const FieldMesh& mesh, const Eigen::Matrix3Xd& electrodes_mm);

  struct Result {
    SourceRows right; ///< - oint m s_q,n N_a, m that of HeterogeneousConductivity or 1; rows() x electrodes
    SourceRows
        potentials; ///< s_p at the boundary's nodes for k = 1, where oint I s_p s_q,n is still to come; else none
    Eigen::MatrixXd products; ///< - oint (s_p - I s_p) s_q,n, or - oint s_p s_q,n; for p <= q by complete batches
  };
  /// The same bytes at any number of threads.
  [[nodiscard]] Result at(const Eigen::Matrix3Xd& nodes_mm, const std::vector<Eigen::Matrix3Xd>& sources_mm,
                          const FieldFunctions& functions, int threads, const std::stop_token& stop) const;
  /// Of the functions (FieldFunctions) that the rows of `right` belong to, ascending: those of the boundary's nodes, or
  /// all where k varies.
  [[nodiscard]] const std::vector<int>& rows(const FieldConductivity& conductivity) const {
    return conductivity.heterogeneous() ? all_ : boundary_;
  }

private:
  /// Some faces in turn, and which electrodes are near one of them.
  struct Piece {
    int first = 0, count = 0;
    std::vector<int> near{};
  };
  /// Pieces in turn. Nodes that a part before has as well are summed up apart.
  struct Part {
    std::vector<Piece> pieces{};
    std::vector<int> shared{}; ///< their rows
  };
  struct Room;
  void findParts(const Eigen::Matrix3Xd& electrodes_mm);
  [[nodiscard]] SourceRows potentials(const Eigen::Matrix3Xd& nodes_mm, const std::vector<Eigen::Matrix3Xd>& sources_mm,
                                      int threads) const;
  void addProducts(const Piece& piece, const SourceRows& potentials, Room& room, Eigen::MatrixXd& products) const;

  const FieldMesh* mesh_;
  Eigen::MatrixXi faces_; ///< ordered so that neighbours are close together
  std::vector<int> all_, boundary_;
  std::vector<Part> parts_;
  Eigen::MatrixXi rows_;   ///< of the boundary's nodes, 6 x faces
  Eigen::MatrixXi places_; ///< the same, or where the shared ones are in their part: - 1 - place
};

} // namespace palp
