#pragma once

#include "model/BoxGreen.h"
#include "solver/field/BoundaryIntegrals.h"
#include "solver/field/ConductionMatrix.h"
#include "solver/field/FieldConductivity.h"
#include "solver/field/FieldSources.h"
#include "solver/field/HeterogeneousConductivity.h"
#include "solver/field/SphericalMeans.h"

#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

namespace palp {

/// A deformed block: positions of the nodes (of FieldMesh) and electrodes, and its conductivity.
struct FieldState {
  Eigen::Matrix3Xd nodes_mm;
  Eigen::Matrix3Xd electrodes_mm;
  FieldConductivity conductivity{};
  double radius_mm = 0; ///< of the electrodes, on whose spheres a heterogeneous conductivity acts
};

/// Potential and its gradient at all nodes [1/mm, 1/mm2] for conductivity k, and the potential on each electrode.
struct NodalPotential {
  Eigen::VectorXd value;
  Eigen::Matrix3Xd gradient;
  Eigen::VectorXd electrodes;
};

/// Green's function of the insulated deformed block of conductivity k between its electrodes.
///
/// For k = 1, G(., x_q) = s_q + w_q with s_q the sources of FieldSources; w_q is smooth and the mesh's part:
///   integral grad w_q . grad v = - oint s_q,n v dS - mean(v)   for all v.
/// The value at an electrode p follows from Green's identity instead of from w_q there, by the energy of two fields,
/// whose error is the product of theirs:
///   w_q(x_p) = integral grad w_p . grad w_q - oint s_p s_q,n dS + terms of q alone and of p alone,
/// and such terms have no effect for currents of zero sum. Where k varies, G(., x_q) = s_q / (m m_q) + w_q
/// (HeterogeneousConductivity). Why: resistances change by 1e-3 under a touch, and sources subtracted in closed form
/// leave a field that a coarse mesh resolves. Where to read more: resources/docs/numerics/field-deformed.md.
///
/// `at` in stages: systemAt (sources, matrix, factor) > integrals (right-hand sides) > solve in batches > energies >
/// sources' own part.
class DeformedGreen {
public:
  DeformedGreen(const Mesh& solverMesh, const Eigen::Vector3d& block_mm, const Eigen::Matrix3Xd& electrodes_mm);

  [[nodiscard]] const FieldMesh& mesh() const { return mesh_; }

  /// As boxGreen, up to terms of p alone and of q alone, without curvature. Returns nullopt if cancelled. Throws
  /// DesignError where an element is inside out.
  [[nodiscard]] std::optional<BoxGreen> at(const FieldState& state, int threads, const std::stop_token& stop) const;
  /// k at the electrodes.
  [[nodiscard]] Eigen::VectorXd conductivities(const FieldState& state) const;

  /// Potential of these currents (one an electrode, sum 0) from the electrodes' spheres, inside of which it is
  /// constant; up to a constant. Returns nullopt if cancelled.
  [[nodiscard]] std::optional<NodalPotential> potential(const FieldState& state, const Eigen::VectorXd& currents,
                                                        int threads, const std::stop_token& stop) const;

private:
  /// An element and a point in it.
  struct Place {
    int element = 0;
    Eigen::Vector4d barycentric;
  };
  /// Location of each electrode in the deformed mesh, in each of its host elements.
  [[nodiscard]] std::vector<std::vector<Place>> places(const FieldState& state) const;
  /// Gradients in space of the functions at a place; those that the element has not are 0.
  [[nodiscard]] Eigen::Matrix<double, 3, FieldFunctions::most>
  gradientsIn(const FieldFunctions& functions, const FieldState& state, const Place& place) const;
  [[nodiscard]] std::vector<AtElectrode> atElectrodes(const FieldState& state, const FieldFunctions& functions,
                                                      const std::vector<double>& cutoffs_mm, int threads) const;
  /// Of balls around the electrodes that end at the nearest face.
  [[nodiscard]] std::vector<double> cutoffs_mm(const std::vector<Eigen::Matrix3Xd>& sources_mm) const;
  /// Of the pressure in space, at the nodes: means of the elements around.
  [[nodiscard]] Eigen::Matrix3Xd pressureSlopes(const FieldState& state, const FieldFunctions& functions) const;
  /// Contribution of a function to a gradient, per unit of its coefficient.
  struct Slope {
    int row = 0;
    Eigen::Vector3d weight;
  };
  [[nodiscard]] std::vector<std::vector<Slope>> slopes(const FieldState& state, const FieldFunctions& functions) const;
  struct System; ///< a state's factorised matrix
  struct SourceIntegrals;
  [[nodiscard]] SourceIntegrals integrals(const FieldState& state, const System& system, int threads,
                                          const std::stop_token& stop) const;
  [[nodiscard]] std::unique_ptr<System> systemAt(const FieldState& state, int threads,
                                                 const std::stop_token& stop) const;

  FieldMesh mesh_;
  double cutoff_mm_; ///< faces nearer to an electrode have image sources
  FieldSources sources_;
  BoundaryIntegrals boundary_;
  ConductionMatrix matrix_;
  SphericalMeans means_;
  std::vector<std::vector<Place>> atRest_;
  std::vector<std::vector<int>> neighbours_; ///< elements around those
};

} // namespace palp
