#include "solver/field/ConductionMatrix.h"

#include "model/base/Parallel.h"
#include "solver/field/TetRule.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr int kElementsAChunk = 256;

constexpr std::size_t pairs(int functions) {
  return std::size_t(functions) * std::size_t(functions + 1) / 2;
}

using Stiffness = Eigen::Matrix<double, FieldFunctions::most, FieldFunctions::most>;
using Volumes = Eigen::Matrix<double, FieldFunctions::most, 1>;

} // namespace

ConductionMatrix::ConductionMatrix(const FieldMesh& mesh) : mesh_(&mesh), uniform_(numbering(10)) {}

const ConductionMatrix::Numbering& ConductionMatrix::numberingOf(const FieldConductivity& conductivity) const {
  if (!conductivity.heterogeneous()) return uniform_;
  std::call_once(heterogeneousFound_, [&] { heterogeneous_ = numbering(FieldFunctions::most); });
  return heterogeneous_;
}

const std::shared_ptr<const CholeskyPlan>& ConductionMatrix::plan(const FieldConductivity& conductivity) const {
  return numberingOf(conductivity).plan;
}

ConductionMatrix::Numbering ConductionMatrix::numbering(int functions) const {
  const Eigen::MatrixXi& elements = mesh_->tets().elements;
  Numbering result{functions, mesh_->nodes() + (functions == 10 ? 0 : mesh_->corners())};
  const int unknowns = result.rows - 1;
  const auto rowOf = [&](int function, int e) { return FieldFunctions::row(*mesh_, function, e); };
  std::vector<std::vector<int>> below(static_cast<std::size_t>(unknowns));
  for (int e = 0; e < mesh_->elements(); ++e)
    for (int a = 0; a < functions; ++a)
      for (int b = 0; b < functions; ++b)
        if (const int low = rowOf(a, e), high = rowOf(b, e); low > 0 && high >= low)
          below[static_cast<std::size_t>(low - 1)].push_back(high - 1);
  auto pattern = std::make_shared<SparsePattern>();
  const Eigen::Matrix3Xd& nodes_mm = mesh_->tets().nodes_mm;
  pattern->groupPositions_mm.resize(3, unknowns);
  pattern->groupPositions_mm << nodes_mm.rightCols(mesh_->nodes() - 1), nodes_mm.leftCols(result.rows - mesh_->nodes());
  pattern->groupColumns = {0};
  pattern->groupStart.push_back(0);
  for (int i = 0; i < unknowns; ++i) {
    std::vector<int>& rows = below[static_cast<std::size_t>(i)];
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    pattern->groupRows.insert(pattern->groupRows.end(), rows.begin(), rows.end());
    pattern->groupColumns.push_back(static_cast<int>(pattern->groupRows.size()));
    pattern->groupStart.push_back(i + 1);
  }
  pattern->columns = pattern->groupColumns;
  pattern->rows = pattern->groupRows;
  result.entries.assign(static_cast<std::size_t>(elements.cols()) * pairs(functions), -1);
  std::size_t at = 0;
  for (int e = 0; e < mesh_->elements(); ++e)
    for (int a = 0; a < functions; ++a)
      for (int b = 0; b <= a; ++b, ++at) {
        const auto [low, high] = std::minmax({rowOf(a, e), rowOf(b, e)});
        if (low == 0) continue;
        const auto first = pattern->rows.begin() + pattern->columns[static_cast<std::size_t>(low - 1)];
        const auto last = pattern->rows.begin() + pattern->columns[static_cast<std::size_t>(low)];
        result.entries[at] = static_cast<int>(std::lower_bound(first, last, high - 1) - pattern->rows.begin());
      }
  result.plan = std::make_shared<const CholeskyPlan>(std::move(pattern));
  return result;
}

ConductionMatrix::Values ConductionMatrix::at(const Eigen::Matrix3Xd& nodes_mm, const FieldFunctions& functions,
                                              int threads) const {
  const TetRule& rule = tetRule();
  const FieldConductivity& conductivity = functions.conductivity();
  const Numbering& numbering = numberingOf(conductivity);
  const Eigen::MatrixXi& elements = mesh_->tets().elements;
  const auto most = static_cast<std::size_t>(numbering.functions);
  UnsetArray<double> own(numbering.entries.size()), load(most * static_cast<std::size_t>(elements.cols()));
  forChunks(mesh_->elements(), kElementsAChunk, threads, [&](int begin, int end) {
    Eigen::Matrix<double, 3, 10> places;
    for (int e = begin; e < end; ++e) {
      for (int n = 0; n < 10; ++n) places.col(n) = nodes_mm.col(elements(n, e));
      Stiffness stiffness = Stiffness::Zero();
      Volumes volumes = Volumes::Zero();
      if (functions.count(e) == 10) {
        Eigen::Matrix<double, 10, 1> atNodes = Eigen::Matrix<double, 10, 1>::Ones(); // pressures, or k = 1
        if (conductivity.heterogeneous()) atNodes = conductivity.pressures_MPa(elements.col(e));
        for (std::size_t q = 0; q < TetRule::points; ++q) {
          const Eigen::Matrix3d map = places * rule.gradients[q];
          const Eigen::Matrix<double, 10, 3> gradients = rule.gradients[q] * map.inverse();
          const auto shapes = rule.shapes.col(static_cast<Eigen::Index>(q));
          const double weight = rule.weights[q] * map.determinant() / 6;
          const double between = shapes.dot(atNodes);
          const double k =
              conductivity.heterogeneous() ? std::exp(2 * conductivity.halfLogConductivity(between)) : between;
          stiffness.topLeftCorner<10, 10>().noalias() += (weight * k) * (gradients * gradients.transpose());
          volumes.head<10>() += weight * shapes;
        }
      } else {
        const Eigen::Matrix<double, 10, 1> pressures = conductivity.pressures_MPa(elements.col(e));
        for (const TetPoint& point : tetPointsAroundKink(pressures)) {
          const FieldFunctions::Point at = functions.at(e, point.barycentric);
          const Eigen::Matrix3d map = places * at.gradients.topRows<10>();
          const Eigen::Matrix<double, FieldFunctions::most, 3> gradients = at.gradients * map.inverse();
          const double weight = point.weight * map.determinant() / 6;
          const double k = std::exp(2 * conductivity.halfLogConductivity(at.values.head<10>().dot(pressures)));
          stiffness.noalias() += (weight * k) * (gradients * gradients.transpose());
          volumes += weight * at.values;
        }
      }
      double* out = own.data() + static_cast<std::size_t>(e) * pairs(numbering.functions);
      for (int a = 0; a < numbering.functions; ++a)
        for (int b = 0; b <= a; ++b) *out++ = stiffness(a, b);
      std::copy_n(volumes.data(), most, load.data() + most * static_cast<std::size_t>(e));
    }
  });
  Values values{LaneVector(numbering.plan->pattern().rows.size()), Eigen::VectorXd::Zero(numbering.rows)};
  for (std::size_t i = 0; i < numbering.entries.size(); ++i)
    if (numbering.entries[i] >= 0) values.matrix[static_cast<std::size_t>(numbering.entries[i])] += own.data()[i];
  for (int e = 0; e < mesh_->elements(); ++e)
    for (int n = 0; n < numbering.functions; ++n)
      values.volumes(functions.row(n, e)) += load.data()[most * static_cast<std::size_t>(e) + std::size_t(n)];
  for (int row = mesh_->nodes(); row < numbering.rows; ++row) { // functions that are 0
    double& diagonal = values.matrix[static_cast<std::size_t>(numbering.plan->pattern().columns[std::size_t(row - 1)])];
    if (diagonal == 0) diagonal = 1;
  }
  return values;
}

} // namespace palp
