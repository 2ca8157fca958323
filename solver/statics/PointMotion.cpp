#include "solver/statics/PointMotion.h"

#include <cmath>

namespace palp {

namespace {

constexpr double noBubble = 1e-12; // weight of a bubble on a face of its element, but for rounding

} // namespace

Eigen::Matrix3Xd pointMotion(const PointProbe::Host& host, const Discretisation& mesh, const InitialTangent& rest) {
  const Eigen::Index nodes = host.shapes.size();
  Eigen::Matrix3Xd motion = Eigen::Matrix3Xd::Zero(3, 3 * nodes);
  for (Eigen::Index n = 0; n < nodes; ++n) motion.middleCols<3>(3 * n).diagonal().setConstant(host.shapes(n));
  if (!(std::abs(host.bubble) > noBubble)) return motion;
  const std::size_t dofs = static_cast<std::size_t>(mesh.elementDofs());
  const auto e = static_cast<std::size_t>(host.element);
  const double* const elimination = rest.tangents.elimination.data() +
                                    e / lanes * static_cast<std::size_t>(mesh.unknowns()) * dofs * lanes + e % lanes;
  for (std::size_t i = 0; i < 3; ++i) // the bubble's displacement comes first
    for (std::size_t k = 0; k < static_cast<std::size_t>(3 * nodes); ++k)
      motion(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) -=
          host.bubble * elimination[(i * dofs + k) * lanes];
  return motion;
}

} // namespace palp
