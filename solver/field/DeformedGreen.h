#pragma once

#include "model/BoxGreen.h"
#include "solver/field/BoundaryIntegrals.h"
#include "solver/field/ConductionMatrix.h"
#include "solver/field/Conductivity.h"
#include "solver/field/FieldSources.h"
#include "solver/field/SphericalMeans.h"
#include "solver/field/UnevenConductivity.h"

#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

namespace palp {

/// Where nodes (of FieldMesh) and electrodes stand in a deformed block, and how well it conducts.
struct FieldState {
  Eigen::Matrix3Xd nodes_mm;
  Eigen::Matrix3Xd electrodes_mm;
  Conductivity conductivity{};
  double radius_mm = 0; ///< of the electrodes, on whose spheres an uneven conductivity is felt
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
/// What stands at an electrode p follows from Green's identity rather than from w_q there, by the energy of two fields,
/// whose error is of the square of their own:
///   w_q(x_p) = integral grad w_p . grad w_q - oint s_p s_q,n dS + terms of q alone and of p alone,
/// and such terms no current of zero sum sees. Where k varies, G(., x_q) = s_q / (m m_q) + w_q as UnevenConductivity
/// has it. (resources/docs/numerics/field-deformed.md.)
class DeformedGreen {
public:
  DeformedGreen(const Mesh& solverMesh, const Eigen::Vector3d& block_mm, const Eigen::Matrix3Xd& electrodes_mm);

  [[nodiscard]] const FieldMesh& mesh() const { return mesh_; }

  /// As boxGreen, but for terms of p alone and of q alone, without curvature. None: stopped. Throws DesignError where
  /// an element is inside out.
  [[nodiscard]] std::optional<BoxGreen> at(const FieldState& state, int threads, const std::stop_token& stop) const;
  /// k at the electrodes.
  [[nodiscard]] Eigen::VectorXd conductivities(const FieldState& state) const;

  /// Potential of these currents (one an electrode, sum 0) from the electrodes' spheres, inside of which it is
  /// constant; but for a constant. None: stopped.
  [[nodiscard]] std::optional<NodalPotential> potential(const FieldState& state, const Eigen::VectorXd& currents,
                                                        int threads, const std::stop_token& stop) const;

private:
  /// An element and a point in it.
  struct Place {
    int element = 0;
    Eigen::Vector4d barycentric;
  };
  /// Where each electrode lies in the deformed mesh: in all elements around it.
  [[nodiscard]] std::vector<std::vector<Place>> places(const FieldState& state) const;
  /// Gradients in space of the functions at a place; those that the element has not are 0.
  [[nodiscard]] Eigen::Matrix<double, 3, FieldFunctions::most>
  gradientsIn(const FieldFunctions& functions, const FieldState& state, const Place& place) const;
  [[nodiscard]] std::vector<AtElectrode> atElectrodes(const FieldState& state, const FieldFunctions& functions,
                                                      const std::vector<double>& reaches_mm, int threads) const;
  /// Of balls around the electrodes that end at the nearest face.
  [[nodiscard]] std::vector<double> reaches_mm(const std::vector<Eigen::Matrix3Xd>& sources_mm) const;
  /// Of the pressure in space, at the nodes: means of the elements around.
  [[nodiscard]] Eigen::Matrix3Xd pressureSlopes(const FieldState& state, const FieldFunctions& functions) const;
  /// What a function's factor adds to a gradient.
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
  double reach_mm_; ///< faces nearer to an electrode mirror
  FieldSources sources_;
  BoundaryIntegrals boundary_;
  ConductionMatrix matrix_;
  SphericalMeans means_;
  std::vector<std::vector<Place>> atRest_;
  std::vector<std::vector<int>> neighbours_; ///< elements around those
};

} // namespace palp
