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

std::optional<TouchedTangent> touchedTangent(const LinearisedBlock& linearised, const Rectangle& touched, int threads,
                                             const std::stop_token& stop) {
  auto pattern = std::make_shared<SparsePattern>(*linearised.assembler.pattern());
  for (const int node : TopCompliance::nodesIn(linearised.mesh, touched))
    pattern->lastGroups.push_back(linearised.assembler.group(node));
  const auto products = linearised.assembler.rubber().roundsWell() ? UpdatePrecision::Single : UpdatePrecision::Double;
  auto rest = linearised.makeTangent(std::make_shared<const CholeskyPlan>(std::move(pattern)), threads, stop, products);
  if (!rest) return {};
  const Eigen::MatrixXd inverse = rest->factor.inverseOfLast(stop);
  if (stop.stop_requested()) return {};
  rest->factor.keepFactorAlone();
  return TouchedTangent{std::move(rest), inverse.cast<float>()};
}

} // namespace palp
