#include "solver/assembly/Assembler.h"

#include "model/base/Parallel.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <mutex>

namespace palp {

namespace {

constexpr int blocksAChunk = 8;
constexpr int nodesAChunk = 256;

void setLaw(RubberConstants& rubber, const MooneyRivlin& law) {
  rubber.law = KernelLaw::MooneyRivlin;
  rubber.constants[0] = law.c10_MPa;
  rubber.constants[1] = law.c01_MPa;
}
void setLaw(RubberConstants& rubber, const NeoHooke& law) {
  setLaw(rubber, MooneyRivlin{law.c10_MPa, 0});
}
void setLaw(RubberConstants& rubber, const Yeoh& law) {
  rubber.law = KernelLaw::Yeoh;
  rubber.constants[0] = law.c10_MPa;
  rubber.constants[1] = law.c20_MPa;
  rubber.constants[2] = law.c30_MPa;
}
void setLaw(RubberConstants& rubber, const Gent& law) {
  rubber.law = KernelLaw::Gent;
  rubber.constants[0] = law.mu_MPa;
  rubber.constants[1] = law.jm;
}
void setLaw(RubberConstants& rubber, const Ogden& law) {
  assert(law.alpha.size() <= std::size_t(ogdenTerms) && law.mu_MPa.size() == law.alpha.size() && "a checked design");
  rubber.law = KernelLaw::Ogden;
  for (std::size_t k = 0; k < law.alpha.size(); ++k) {
    rubber.constants[2 * k] = law.mu_MPa[k];
    rubber.constants[2 * k + 1] = law.alpha[k];
  }
}

} // namespace

RubberConstants rubberConstants(const Material& material) {
  RubberConstants rubber{};
  std::visit([&](const auto& law) { setLaw(rubber, law); }, material.law);
  rubber.shearModulus_MPa = material.shearModulus_MPa();
  rubber.compressibility_per_MPa = material.compressibility_per_MPa();
  rubber.tangentCompressibility_per_MPa = std::max(rubber.compressibility_per_MPa, 1e-6 / rubber.shearModulus_MPa);
  return rubber;
}

Assembler::Assembler(std::shared_ptr<const Discretisation> mesh, const RubberConstants& rubber)
    : mesh_(std::move(mesh)), rubber_(rubber) {
  for (int e = 0; e < mesh_->elements(); ++e)
    volumeForce_.push_back(rubber.shearModulus_MPa / std::cbrt(mesh_->volume(e)));
  findNeighbours();
  findPattern();
}

void Assembler::findNeighbours() {
  const int nodesAnElement = mesh_->kernels().nodes;
  aroundStart_.assign(mesh_->nodes() + 1, 0);
  for (int e = 0; e < mesh_->elements(); ++e)
    for (int n = 0; n < nodesAnElement; ++n) ++aroundStart_[mesh_->node(e, n) + 1];
  for (int i = 0; i < mesh_->nodes(); ++i) aroundStart_[i + 1] += aroundStart_[i];
  around_.resize(aroundStart_.back());
  std::vector<int> next = aroundStart_;
  for (int e = 0; e < mesh_->elements(); ++e)
    for (int n = 0; n < nodesAnElement; ++n) around_[next[mesh_->node(e, n)]++] = e * nodesAnElement + n;
}

void Assembler::findPattern() {
  auto pattern = std::make_shared<SparsePattern>();
  const int nodesAnElement = mesh_->kernels().nodes;
  groupOfNode_.assign(mesh_->nodes(), -1);
  pattern->groupStart = {0};
  for (int node = 0; node < mesh_->nodes(); ++node) {
    int free = 0;
    for (int d = 0; d < 3; ++d) free += mesh_->freeIndex(3 * node + d) >= 0;
    if (free == 0) continue;
    groupOfNode_[node] = static_cast<int>(nodeOfGroup_.size());
    nodeOfGroup_.push_back(node);
    pattern->groupStart.push_back(pattern->groupStart.back() + free);
  }
  pattern->groupPositions_mm = mesh_->positions_mm()(Eigen::all, nodeOfGroup_);
  const auto groupSize = [&](int g) { return pattern->groupStart[g + 1] - pattern->groupStart[g]; };
  rowOffset_.assign(std::size_t(mesh_->elements()) * nodesAnElement * nodesAnElement, -1);
  pattern->groupColumns = {0};
  pattern->columns = {0};
  std::vector<int> rows, offsetOfGroup(nodeOfGroup_.size());
  for (int g = 0; g < static_cast<int>(nodeOfGroup_.size()); ++g) {
    rows.clear();
    const int node = nodeOfGroup_[g];
    for (int k = aroundStart_[node]; k < aroundStart_[node + 1]; ++k)
      for (int n = 0; n < nodesAnElement; ++n)
        if (const int other = groupOfNode_[mesh_->node(around_[k] / nodesAnElement, n)]; other >= g)
          rows.push_back(other);
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    int length = 0;
    for (int other : rows) {
      offsetOfGroup[other] = length;
      length += groupSize(other);
    }
    for (int k = aroundStart_[node]; k < aroundStart_[node + 1]; ++k)
      for (int n = 0; n < nodesAnElement; ++n)
        if (const int other = groupOfNode_[mesh_->node(around_[k] / nodesAnElement, n)]; other >= g)
          rowOffset_[std::size_t(around_[k]) * nodesAnElement + n] = offsetOfGroup[other];
    pattern->groupRows.insert(pattern->groupRows.end(), rows.begin(), rows.end());
    pattern->groupColumns.push_back(static_cast<int>(pattern->groupRows.size()));
    for (int c = 0; c < groupSize(g); ++c) {
      for (int other : rows)
        for (int r = other == g ? c : 0; r < groupSize(other); ++r)
          pattern->rows.push_back(pattern->groupStart[other] + r);
      pattern->columns.push_back(static_cast<int>(pattern->rows.size()));
    }
  }
  pattern->groupRows.shrink_to_fit();
  pattern->rows.shrink_to_fit();
  pattern_ = std::move(pattern);
}

/// kernel(block, displacements, residual): one call a block; gathers the range of J over all.
template <class Kernel>
void Assembler::overBlocks(ElementForces& forces, int threads, const std::stop_token& stop, Kernel kernel) const {
  const std::size_t d = mesh_->elementDofs(), x = mesh_->unknowns();
  forces.forces.resize(mesh_->blocks() * d * lanes);
  forces.raw.resize(forces.forces.size());
  forces.local.resize(mesh_->blocks() * x * lanes);
  std::mutex rangeMutex;
  forces.smallestJ = forces.largestJ = 1;
  forChunks(mesh_->blocks(), blocksAChunk, threads, [&](int begin, int end) {
    alignas(64) std::array<double, largestElementDofs * lanes> u;
    alignas(64) std::array<double, 2 * lanes> range;
    range.fill(1);
    for (int b = begin; b < end && !stop.stop_requested(); ++b)
      kernel(b, u.data(),
             ElementResidual{forces.forces.data() + b * d * lanes, forces.local.data() + b * x * lanes, range.data()});
    const std::lock_guard lock(rangeMutex);
    forces.smallestJ = std::min(forces.smallestJ, *std::min_element(range.begin(), range.begin() + lanes));
    forces.largestJ = std::max(forces.largestJ, *std::max_element(range.begin() + lanes, range.end()));
  });
}

void Assembler::tangent(const ElementState& state, ElementTangents& tangents, ElementForces& forces, int threads,
                        const std::stop_token& stop) const {
  const std::size_t d = mesh_->elementDofs(), x = mesh_->unknowns(), entries = d * (d + 1) / 2;
  tangents.stiffness.resize(mesh_->elements() * entries);
  tangents.elimination.resize(mesh_->blocks() * x * d * lanes);
  tangents.localInverse.resize(mesh_->blocks() * x * (x + 1) / 2 * lanes);
  overBlocks(forces, threads, stop, [&](int b, double* u, const ElementResidual& out) {
    LaneVector stiffness(entries * lanes);
    mesh_->gather(b, state.displacements, u);
    double* elimination = tangents.elimination.data() + b * x * d * lanes;
    mesh_->kernels().of(rubber_).tangent(
        rubber_, {mesh_->geometry(b), u, state.unknowns.data() + b * x * lanes}, out,
        {stiffness.data(), elimination, tangents.localInverse.data() + b * x * (x + 1) / 2 * lanes});
    std::copy_n(out.forces, d * lanes, forces.raw.data() + b * d * lanes);
    mesh_->kernels().condense(elimination, out.local, out.forces);
    for (int lane = 0; lane < lanes && b * lanes + lane < mesh_->elements(); ++lane) {
      double* k = tangents.stiffness.data() + (b * lanes + lane) * entries;
      for (std::size_t i = 0; i < entries; ++i) k[i] = stiffness[lanes * i + lane];
    }
  });
}

void Assembler::residual(const ElementState& state, const ElementTangents& tangents, ElementForces& forces,
                         int threads) const {
  const std::size_t d = mesh_->elementDofs(), x = mesh_->unknowns();
  overBlocks(forces, threads, {}, [&](int b, double* u, const ElementResidual& out) {
    mesh_->gather(b, state.displacements, u);
    mesh_->kernels().of(rubber_).residual(rubber_, {mesh_->geometry(b), u, state.unknowns.data() + b * x * lanes}, out);
    std::copy_n(out.forces, d * lanes, forces.raw.data() + b * d * lanes);
    mesh_->kernels().condense(tangents.elimination.data() + b * x * d * lanes, out.local, out.forces);
  });
}

void Assembler::addNodeColumns(const ElementTangents& tangents, int group, LaneVector& values) const {
  const int nodesAnElement = mesh_->kernels().nodes, node = nodeOfGroup_[group];
  const std::size_t d = mesh_->elementDofs(), entries = d * (d + 1) / 2;
  const int firstColumn = pattern_->groupStart[group];
  for (int k = aroundStart_[node]; k < aroundStart_[node + 1]; ++k) {
    const int element = around_[k] / nodesAnElement, a = around_[k] % nodesAnElement;
    const double* K = tangents.stiffness.data() + element * entries;
    for (int b = 0; b < nodesAnElement; ++b) {
      const int offset = rowOffset_[std::size_t(around_[k]) * nodesAnElement + b];
      if (offset < 0) continue;
      const int other = mesh_->node(element, b);
      for (int c = 0, column = firstColumn; c < 3; ++c) {
        if (mesh_->freeIndex(3 * node + c) < 0) continue;
        double* out = values.data() + pattern_->columns[column] + offset - (column - firstColumn);
        for (int r = 0, row = 0; r < 3; ++r) {
          if (mesh_->freeIndex(3 * other + r) < 0) continue;
          const int i = 3 * a + c, j = 3 * b + r, low = std::min(i, j), high = std::max(i, j);
          if (other != node || r >= c) out[row] += K[high * (high + 1) / 2 + low];
          ++row;
        }
        ++column;
      }
    }
  }
}

LaneVector Assembler::matrix(const ElementTangents& tangents, int threads) const {
  LaneVector values(pattern_->rows.size());
  forChunks(static_cast<int>(nodeOfGroup_.size()), nodesAChunk, threads, [&](int begin, int end) {
    for (int g = begin; g < end; ++g) addNodeColumns(tangents, g, values);
  });
  return values;
}

Eigen::VectorXd Assembler::sum(const LaneVector& forces, int threads) const {
  const int nodesAnElement = mesh_->kernels().nodes;
  const std::size_t d = mesh_->elementDofs();
  Eigen::VectorXd total = Eigen::VectorXd::Zero(3 * Eigen::Index(mesh_->nodes()));
  forChunks(mesh_->nodes(), nodesAChunk, threads, [&](int begin, int end) {
    for (int node = begin; node < end; ++node)
      for (int k = aroundStart_[node]; k < aroundStart_[node + 1]; ++k) {
        const int element = around_[k] / nodesAnElement, n = around_[k] % nodesAnElement;
        for (int c = 0; c < 3; ++c) total(3 * node + c) += forces[laneIndex(element, d, 3 * n + c)];
      }
  });
  return total;
}

double Assembler::localNorm(const ElementForces& forces) const {
  const int own = mesh_->unknowns(), bubbles = mesh_->kernels().bubbles;
  double squares = 0;
  for (int e = 0; e < mesh_->elements(); ++e)
    for (int k = 0; k < own; ++k) {
      const double r = forces.local[laneIndex(e, own, k)];
      const double force = k < bubbles ? r : volumeForce_[e] * r;
      squares += force * force;
    }
  return std::sqrt(squares);
}

Eigen::VectorXd Assembler::stiffnessTimes(const ElementTangents& tangents, const Eigen::VectorXd& du) const {
  const std::size_t d = mesh_->elementDofs(), entries = d * (d + 1) / 2;
  Eigen::VectorXd product = Eigen::VectorXd::Zero(du.size());
  for (int e = 0; e < mesh_->elements(); ++e) {
    const double* K = tangents.stiffness.data() + e * entries;
    const auto component = [&](std::size_t i) {
      return 3 * Eigen::Index(mesh_->node(e, static_cast<int>(i) / 3)) + static_cast<int>(i) % 3;
    };
    for (std::size_t j = 0; j < d; ++j)
      for (std::size_t i = 0; i <= j; ++i) {
        const double k = K[j * (j + 1) / 2 + i];
        product(component(i)) += k * du(component(j));
        if (i != j) product(component(j)) += k * du(component(i));
      }
  }
  return product;
}

LaneVector Assembler::recover(const ElementTangents& tangents, const ElementForces& forces, const Eigen::VectorXd& du,
                              int threads) const {
  const std::size_t d = mesh_->elementDofs(), x = mesh_->unknowns();
  LaneVector dx(mesh_->blocks() * x * lanes);
  forChunks(mesh_->blocks(), blocksAChunk, threads, [&](int begin, int end) {
    alignas(64) std::array<double, largestElementDofs * lanes> u;
    for (int b = begin; b < end; ++b) {
      mesh_->gather(b, du, u.data());
      mesh_->kernels().recover(tangents.elimination.data() + b * x * d * lanes,
                               tangents.localInverse.data() + b * x * (x + 1) / 2 * lanes,
                               forces.local.data() + b * x * lanes, u.data(), dx.data() + b * x * lanes);
    }
  });
  return dx;
}

} // namespace palp
