#include "solver/contact/TopCompliance.h"

#include "model/base/Parallel.h"
#include "solver/contact/ContactPoints.h"

#include <algorithm>
#include <numeric>

namespace palp {

namespace {

std::vector<int> rowsOf(const std::vector<int>& nodes, const ElementwiseTangent& tangent) {
  std::vector<int> rows;
  for (const int node : nodes)
    for (std::size_t d = 0; d < 3; ++d) rows.push_back(tangent.factorRows()[3 * std::size_t(node) + d]);
  return rows;
}

} // namespace

std::vector<int> TopCompliance::nodesIn(const Mesh& mesh, const std::optional<Rectangle>& part) {
  std::vector<int> nodes;
  for (const ContactPoint& point : contactPoints(mesh)) {
    const Eigen::Vector2d place_mm = mesh.nodes_mm.col(point.node).head<2>();
    if (!part || ((place_mm - part->low_mm).minCoeff() >= 0 && (part->high_mm - place_mm).minCoeff() >= 0))
      nodes.push_back(point.node);
  }
  return nodes;
}

TopCompliance::TopCompliance(const ElementwiseTangent& tangent, const Mesh& mesh, const std::optional<Rectangle>& part,
                             Eigen::MatrixXf blocks)
    : nodes_(nodesIn(mesh, part)), places_mm_(mesh.nodes_mm(Eigen::all, nodes_)),
      path_(tangent.tree(), rowsOf(nodes_, tangent)), blocks_(std::move(blocks)) {
  std::vector<bool> excluded(static_cast<std::size_t>(mesh.nodeCount()));
  for (const ContactPoint& point : contactPoints(mesh))
    excluded[std::size_t(point.node)] = !std::binary_search(nodes_.begin(), nodes_.end(), point.node);
  std::vector<bool> nextToExcluded(excluded.size());
  for (Eigen::Index f = 0; f < mesh.topFaces.cols(); ++f) {
    const auto face = mesh.topFaces.col(f);
    if (std::any_of(face.begin(), face.end(), [&](int node) { return excluded[std::size_t(node)]; }))
      for (const int node : face) nextToExcluded[std::size_t(node)] = true;
  }
  for (const int node : nodes_) atBorder_.push_back(nextToExcluded[std::size_t(node)]);
}

std::shared_ptr<const TopCompliance> TopCompliance::find(const ElementwiseTangent& tangent, const Mesh& mesh,
                                                         const std::optional<Rectangle>& part, int threads,
                                                         const std::stop_token& stop) {
  auto found = std::make_shared<TopCompliance>(tangent, mesh, part, Eigen::MatrixXf());
  const int count = found->count();
  found->blocks_.resize(3 * Eigen::Index(count), 3 * Eigen::Index(count));
  const BlockedFactor factor = tangent.factor();
  const auto row = [&](int i) { // of the factor, for unknown i of the pressed nodes
    return std::size_t(tangent.factorRows()[3 * std::size_t(found->nodes_[i / 3]) + i % 3]);
  };
  // The inverse is symmetric: of each column only the entries in later rows of the factor are computed, which needs no
  // supernode before the column's own. Columns that are solved together start close to each other.
  std::vector<int> order(3 * std::size_t(count));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return row(a) < row(b); });
  forChunks(3 * count, batchColumns, threads, [&](int begin, int end) {
    std::vector<float> x(std::size_t(tangent.rightSideRows()) * batchColumns);
    for (int i = begin; i < end; ++i) x[row(order[i]) * batchColumns + (i - begin)] = 1;
    constexpr unsigned all = (1U << unsigned(batchColumns / lanes)) - 1;
    constexpr int supernodesAtOnce = 64; // between looks at a stop request
    const auto own = std::upper_bound(factor.first, factor.first + factor.count, int(row(order[begin]))) - 1;
    const int from = int(own - factor.first);
    for (int first = from; first < factor.count && !stop.stop_requested(); first += supernodesAtOnce)
      laneKernels().forward(factor, first, std::min(factor.count, first + supernodesAtOnce), all, x.data());
    for (int last = factor.count; last > from && !stop.stop_requested(); last -= supernodesAtOnce)
      laneKernels().backward(factor, std::max(from, last - supernodesAtOnce), last, all, x.data());
    for (int i = begin; i < end; ++i)
      for (int k = i; k < 3 * count; ++k)
        found->blocks_(order[k], order[i]) = found->blocks_(order[i], order[k]) =
            x[row(order[k]) * batchColumns + (i - begin)];
  });
  if (stop.stop_requested()) return {};
  return found;
}

} // namespace palp
