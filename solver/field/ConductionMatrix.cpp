#include "solver/field/ConductionMatrix.h"

#include "model/base/Parallel.h"
#include "solver/field/TetRule.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr int kPairs = 55; // of an element's ten nodes
constexpr int kElementsAChunk = 256;

} // namespace

ConductionMatrix::ConductionMatrix(const FieldMesh& mesh) : mesh_(&mesh) {
  const Eigen::MatrixXi& elements = mesh.tets().elements;
  const int unknowns = mesh.nodes() - 1;
  std::vector<std::vector<int>> below(static_cast<std::size_t>(unknowns));
  for (Eigen::Index e = 0; e < elements.cols(); ++e)
    for (int a = 0; a < 10; ++a)
      for (int b = 0; b < 10; ++b)
        if (elements(a, e) > 0 && elements(b, e) >= elements(a, e))
          below[static_cast<std::size_t>(elements(a, e) - 1)].push_back(elements(b, e) - 1);
  auto pattern = std::make_shared<SparsePattern>();
  pattern->groupPositions_mm = mesh.tets().nodes_mm.rightCols(unknowns);
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
  entries_.assign(static_cast<std::size_t>(elements.cols()) * kPairs, -1);
  std::size_t at = 0;
  for (Eigen::Index e = 0; e < elements.cols(); ++e)
    for (int a = 0; a < 10; ++a)
      for (int b = 0; b <= a; ++b, ++at) {
        const auto [low, high] = std::minmax(elements(a, e), elements(b, e));
        if (low == 0) continue;
        const auto first = pattern->rows.begin() + pattern->columns[static_cast<std::size_t>(low - 1)];
        const auto last = pattern->rows.begin() + pattern->columns[static_cast<std::size_t>(low)];
        entries_[at] = static_cast<int>(std::lower_bound(first, last, high - 1) - pattern->rows.begin());
      }
  plan_ = std::make_shared<const CholeskyPlan>(std::move(pattern));
}

ConductionMatrix::Values ConductionMatrix::at(const Eigen::Matrix3Xd& nodes_mm, const Conductivity& conductivity,
                                              int threads) const {
  const TetRule& rule = tetRule();
  const Eigen::MatrixXi& elements = mesh_->tets().elements;
  const bool uneven = conductivity.uneven();
  UnsetArray<double> own(entries_.size()), load(10 * static_cast<std::size_t>(elements.cols()));
  forChunks(mesh_->elements(), kElementsAChunk, threads, [&](int begin, int end) {
    Eigen::Matrix<double, 3, 10> places;
    Eigen::Matrix<double, 10, 1> atNodes = Eigen::Matrix<double, 10, 1>::Ones(); // pressures, or k = 1
    for (int e = begin; e < end; ++e) {
      for (int n = 0; n < 10; ++n) places.col(n) = nodes_mm.col(elements(n, e));
      if (uneven)
        for (int n = 0; n < 10; ++n) atNodes(n) = conductivity.pressures_MPa(elements(n, e));
      Eigen::Matrix<double, 10, 10> stiffness = Eigen::Matrix<double, 10, 10>::Zero();
      Eigen::Matrix<double, 10, 1> volumes = Eigen::Matrix<double, 10, 1>::Zero();
      for (std::size_t q = 0; q < TetRule::points; ++q) {
        const Eigen::Matrix3d map = places * rule.gradients[q];
        const Eigen::Matrix<double, 10, 3> gradients = rule.gradients[q] * map.inverse();
        const auto shapes = rule.shapes.col(static_cast<Eigen::Index>(q));
        const double weight = rule.weights[q] * map.determinant() / 6;
        const double between = shapes.dot(atNodes), k = uneven ? std::exp(2 * conductivity.half(between)) : between;
        stiffness.noalias() += (weight * k) * (gradients * gradients.transpose());
        volumes += weight * shapes;
      }
      double* out = own.data() + static_cast<std::size_t>(e) * kPairs;
      for (int a = 0; a < 10; ++a)
        for (int b = 0; b <= a; ++b) *out++ = stiffness(a, b);
      std::copy_n(volumes.data(), 10, load.data() + 10 * static_cast<std::size_t>(e));
    }
  });
  Values values{LaneVector(plan_->pattern().rows.size()), Eigen::VectorXd::Zero(mesh_->nodes())};
  for (std::size_t i = 0; i < entries_.size(); ++i)
    if (entries_[i] >= 0) values.matrix[static_cast<std::size_t>(entries_[i])] += own.data()[i];
  for (Eigen::Index e = 0; e < elements.cols(); ++e)
    for (int n = 0; n < 10; ++n) values.volumes(elements(n, e)) += load.data()[10 * e + n];
  return values;
}

} // namespace palp
