#include "solver/contact/TouchedTangent.h"

#include "solver/contact/TopCompliance.h"

namespace palp {

namespace {

constexpr std::size_t mostNodesLast = 2000;

} // namespace

bool canBeLast(const Mesh& mesh, const Rectangle& touched) {
  const std::size_t count = TopCompliance::nodesIn(mesh, touched).size();
  return count > 0 && count <= mostNodesLast;
}

std::optional<TouchedTangent> touchedTangent(const HyperelasticProblem::Parts& parts, const Rectangle& touched,
                                             int threads, const std::stop_token& stop) {
  auto pattern = std::make_shared<SparsePattern>(*parts.assembler.pattern());
  for (const int node : TopCompliance::nodesIn(parts.mesh, touched))
    pattern->lastGroups.push_back(parts.assembler.group(node));
  const auto products = parts.assembler.rubber().roundsWell() ? Products::Single : Products::Double;
  auto rest = parts.makeTangent(std::make_shared<const CholeskyPlan>(std::move(pattern)), threads, stop, products);
  if (!rest) return {};
  const Eigen::MatrixXd inverse = rest->factor.inverseOfLast(stop);
  if (stop.stop_requested()) return {};
  rest->factor.keepFactorAlone();
  return TouchedTangent{std::move(rest), inverse.cast<float>()};
}

} // namespace palp
