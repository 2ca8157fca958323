#include "solver/field/DeformedGreen.h"

#include "model/DesignError.h"
#include "model/base/GotExpected.h"
#include "model/base/Parallel.h"
#include "model/base/Text.h"
#include "solver/element/ElementGeometry.h"
#include "solver/field/TetRule.h"
#include "solver/linear/Front.h"

#include <Eigen/Dense>
#include <cblas.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp {

namespace {

/// Distance up to which faces have image sources, relative to the edge of the mesh's faces. Beyond it the flux through
/// a face is smooth on the scale of its elements.
constexpr double kCutoffInEdges = 2.5;

double cutoff_mm(const FieldMesh& mesh, const Eigen::Vector3d& b) {
  const double area = 2 * (b.x() * b.y() + b.y() * b.z() + b.z() * b.x());
  return kCutoffInEdges * std::sqrt(4 / std::sqrt(3.) * area / static_cast<double>(mesh.faces().cols()));
}

/// Barycentric coordinates of a point in a deformed element, by Newton's method from a first guess.
Eigen::Vector4d barycentricIn(const Eigen::Matrix<double, 3, 10>& nodes, const Eigen::Vector3d& point,
                              Eigen::Vector4d l) {
  for (int iteration = 0; iteration < 8; ++iteration) {
    const Eigen::Matrix3d map = nodes * tetLocalGradients(l);
    const Eigen::Vector3d change = map.inverse() * (point - nodes * tetShapes(l));
    l.tail<3>() += change;
    l(0) -= change.sum();
    if (change.cwiseAbs().maxCoeff() < 1e-13) break;
  }
  return l;
}

} // namespace

struct DeformedGreen::System {
  FieldFunctions functions;
  std::vector<Eigen::Matrix3Xd> sources;
  std::vector<double> cutoffs_mm;
  std::vector<AtElectrode> electrodes;
  Eigen::VectorXd volumes; ///< ConductionMatrix::Values
  SparseCholesky factor;
};

DeformedGreen::DeformedGreen(const Mesh& solverMesh, const Eigen::Vector3d& block_mm,
                             const Eigen::Matrix3Xd& electrodes_mm)
    : mesh_(solverMesh), cutoff_mm_(cutoff_mm(mesh_, block_mm)), sources_(mesh_, block_mm, electrodes_mm, cutoff_mm_),
      boundary_(mesh_, electrodes_mm), matrix_(mesh_), means_(mesh_) {
  const Eigen::MatrixXi& elements = mesh_.tets().elements;
  std::vector<std::vector<int>> around(static_cast<std::size_t>(mesh_.nodes()));
  for (int e = 0; e < mesh_.elements(); ++e)
    for (int n = 0; n < 4; ++n) around[static_cast<std::size_t>(elements(n, e))].push_back(e);
  const PointProbe probe(mesh_.tets(), electrodes_mm);
  for (const auto& hosts : probe.hosts()) {
    std::vector<Place>& own = atRest_.emplace_back();
    std::vector<int>& near = neighbours_.emplace_back();
    for (const PointProbe::Host& host : hosts) {
      own.push_back({host.element, host.pressure});
      for (int n = 0; n < 4; ++n) {
        const std::vector<int>& more = around[static_cast<std::size_t>(elements(n, host.element))];
        near.insert(near.end(), more.begin(), more.end());
      }
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
  }
}

Eigen::Matrix<double, 3, FieldFunctions::most>
DeformedGreen::gradientsIn(const FieldFunctions& functions, const FieldState& state, const Place& place) const {
  const FieldFunctions::Point there = functions.at(place.element, place.barycentric);
  const Eigen::Matrix<double, 3, 10> nodes = state.nodes_mm(Eigen::all, mesh_.tets().elements.col(place.element));
  const Eigen::Matrix<double, 3, FieldFunctions::most> local = there.gradients.transpose();
  return (local.leftCols<10>() * nodes.transpose()).inverse() * local;
}

std::vector<std::vector<DeformedGreen::Place>> DeformedGreen::places(const FieldState& state) const {
  // Barycentric tolerance: the rubber moves past fixed electrodes, and values in their host elements at rest change
  // smoothly with the load, where a change of host element would be a jump.
  constexpr double inside = 0.3;
  std::vector<std::vector<Place>> all(atRest_.size());
  for (std::size_t p = 0; p < all.size(); ++p) {
    const Eigen::Vector3d point = state.electrodes_mm.col(static_cast<Eigen::Index>(p));
    const auto in = [&](int e, const Eigen::Vector4d& guess) {
      return barycentricIn(state.nodes_mm(Eigen::all, mesh_.tets().elements.col(e)), point, guess);
    };
    for (const Place& place : atRest_[p])
      if (const Eigen::Vector4d l = in(place.element, place.barycentric); l.allFinite() && l.minCoeff() > -inside)
        all[p].push_back({place.element, l});
    if (!all[p].empty()) continue;
    for (const int e : neighbours_[p]) { // far outside of them
      const Eigen::Vector4d l = in(e, Eigen::Vector4d::Constant(0.25));
      if (!l.allFinite()) continue; // an element turned inside out contains no point
      if (all[p].empty()) all[p].push_back({e, l});
      if (l.minCoeff() > all[p].front().barycentric.minCoeff()) all[p].front() = {e, l};
    }
    if (all[p].empty())
      throw DesignError("electrode " + std::to_string(p) +
                        ": no element of the deformed mesh contains it; expected smaller loads, or a finer mesh");
  }
  return all;
}

Eigen::Matrix3Xd DeformedGreen::pressureSlopes(const FieldState& state, const FieldFunctions& functions) const {
  Eigen::Matrix3Xd slopes = Eigen::Matrix3Xd::Zero(3, mesh_.nodes());
  if (!state.conductivity.heterogeneous()) return slopes;
  Eigen::VectorXd around = Eigen::VectorXd::Zero(mesh_.nodes());
  for (int e = 0; e < mesh_.elements(); ++e) {
    const auto nodes = mesh_.tets().elements.col(e);
    const Eigen::Matrix<double, 3, 4> at = state.nodes_mm(Eigen::all, nodes.head<4>());
    const Eigen::Matrix<double, 10, 1> pressures = state.conductivity.pressures_MPa(nodes);
    const double volume = (at.rightCols<3>().colwise() - at.col(0)).determinant();
    for (int n = 0; n < 10; ++n) {
      slopes.col(nodes(n)) += volume * (gradientsIn(functions, state, {e, tetNode(n)}).leftCols<10>() * pressures);
      around(nodes(n)) += volume;
    }
  }
  slopes.array().rowwise() /= around.transpose().array();
  return slopes;
}

std::vector<double> DeformedGreen::cutoffs_mm(const std::vector<Eigen::Matrix3Xd>& sources_mm) const {
  std::vector<double> all;
  for (const Eigen::Matrix3Xd& of : sources_mm) {
    double cutoff = cutoff_mm_; // a nearer face has an image
    for (Eigen::Index m = 1; m < of.cols(); ++m) cutoff = std::min(cutoff, (of.col(m) - of.col(0)).norm() / 2);
    all.push_back(cutoff);
  }
  return all;
}

std::vector<AtElectrode> DeformedGreen::atElectrodes(const FieldState& state, const FieldFunctions& functions,
                                                     const std::vector<double>& cutoffs_mm, int threads) const {
  std::vector<AtElectrode> all(atRest_.size());
  if (!state.conductivity.heterogeneous()) return all;
  const std::vector<std::vector<Place>> where = places(state);
  inParallel(all.size(), threads, [&](std::size_t p) {
    const Place& place = where[p].front();
    all[p] = means_.around(state.nodes_mm, functions,
                           {place.element, place.barycentric, state.electrodes_mm.col(static_cast<Eigen::Index>(p)),
                            state.radius_mm, cutoffs_mm[p]});
  });
  return all;
}

Eigen::VectorXd DeformedGreen::conductivities(const FieldState& state) const {
  const std::vector<AtElectrode> at =
      atElectrodes(state, FieldFunctions(mesh_, state.conductivity, 1),
                   std::vector<double>(atRest_.size(), state.radius_mm), 1); // not beyond their spheres
  Eigen::VectorXd k(static_cast<Eigen::Index>(at.size()));
  for (std::size_t p = 0; p < at.size(); ++p) k(static_cast<Eigen::Index>(p)) = std::exp(2 * at[p].value);
  return k;
}

std::unique_ptr<DeformedGreen::System> DeformedGreen::systemAt(const FieldState& state, int threads,
                                                               const std::stop_token& stop) const {
  useOneBlasThread();
  FieldFunctions functions(mesh_, state.conductivity, threads);
  ConductionMatrix::Values values = matrix_.at(state.nodes_mm, functions, threads);
  if (stop.stop_requested()) return {};
  SparseCholesky factor(matrix_.plan(state.conductivity));
  if (factor.factorise(std::move(values.matrix), threads, stop) == SparseCholesky::Outcome::NotPositiveDefinite) {
    constexpr double mostContrast = 1e9; // that the equations bear
    const FieldConductivity& k = state.conductivity;
    const double contrast = k.heterogeneous() ? std::exp(2 * k.halfLogConductivity(k.pressures_MPa.maxCoeff())) : 1;
    if (!(contrast < mostContrast))
      throw DesignError("resistance.pressure_law: conductivity under the largest pressure: " +
                        gotExpected(contrast, " times that at rest", "up to some 1e9 times"));
    throw DesignError("the conduction field: the load turns an element inside out");
  }
  if (stop.stop_requested()) return {};
  std::vector<Eigen::Matrix3Xd> sources = sources_.at(state.nodes_mm, state.electrodes_mm);
  const std::vector<double> cutoffs = cutoffs_mm(sources);
  std::vector<AtElectrode> electrodes = atElectrodes(state, functions, cutoffs, threads);
  return std::make_unique<System>(System{std::move(functions), std::move(sources), cutoffs, std::move(electrodes),
                                         std::move(values.volumes), std::move(factor)});
}

/// Right sides b of w are - oint s_q,n N_a - mean(N_a), or as k has it: rows of `boundary` less `netCurrent` times
/// volumes.
struct DeformedGreen::SourceIntegrals {
  BoundaryIntegrals::Result boundary;
  const std::vector<int>* functions; ///< of its rows
  Eigen::RowVectorXd
      netCurrent; ///< the sources' total current, including the quadrature error, absorbed uniformly over the volume
};

DeformedGreen::SourceIntegrals DeformedGreen::integrals(const FieldState& state, const System& system, int threads,
                                                        const std::stop_token& stop) const {
  SourceIntegrals result{boundary_.at(state.nodes_mm, system.sources, system.functions, threads, stop),
                         &boundary_.rows(state.conductivity),
                         {}};
  if (stop.stop_requested()) return result; // without the rows that are not of the boundary
  SourceRows& right = result.boundary.right;
  if (state.conductivity.heterogeneous()) {
    Eigen::MatrixXd& products = result.boundary.products;
    HeterogeneousConductivity(mesh_, state.nodes_mm, system.functions, threads)
        .addIntegrals(system.sources, system.electrodes, system.cutoffs_mm, threads, stop, right, products);
    const Eigen::Index count = right.cols();
    Eigen::VectorXd inverse(count);
    for (int p = 0; p < count; ++p) inverse(p) = std::exp(-system.electrodes[std::size_t(p)].value);
    right *= inverse.asDiagonal();
    products = (inverse.asDiagonal() * products * inverse.asDiagonal()).eval();
  }
  const Eigen::Index nodes = std::min<Eigen::Index>(right.rows(), mesh_.nodes()); // whose functions' sum is 1
  result.netCurrent = right.topRows(nodes).colwise().sum() / system.volumes.head(mesh_.nodes()).sum();
  return result;
}

/// What gives a field's gradient at each electrode from its values at nodes: the mean of the elements that hold it.
std::vector<std::vector<DeformedGreen::Slope>> DeformedGreen::slopes(const FieldState& state,
                                                                     const FieldFunctions& functions) const {
  const std::vector<std::vector<Place>> where = places(state);
  std::vector<std::vector<Slope>> all(where.size());
  for (std::size_t p = 0; p < where.size(); ++p) {
    std::vector<Slope>& own = all[p];
    for (const Place& place : where[p]) {
      const Eigen::Matrix<double, 3, FieldFunctions::most> gradients =
          gradientsIn(functions, state, place) / double(where[p].size());
      for (int k = 0; k < functions.count(place.element); ++k)
        own.push_back({functions.row(k, place.element), gradients.col(k)});
    }
    std::stable_sort(own.begin(), own.end(), [](const Slope& a, const Slope& b) { return a.row < b.row; });
    std::size_t last = 0;
    for (std::size_t k = 1; k < own.size(); ++k)
      if (own[k].row == own[last].row)
        own[last].weight += own[k].weight;
      else
        own[++last] = own[k];
    own.resize(last + 1);
  }
  return all;
}

std::optional<BoxGreen> DeformedGreen::at(const FieldState& state, int threads, const std::stop_token& stop) const {
  const std::unique_ptr<System> system = systemAt(state, threads, stop);
  if (!system) return {};
  const auto count = static_cast<int>(state.electrodes_mm.cols());
  const int batches = (count + batchColumns - 1) / batchColumns;
  SourceIntegrals integral = integrals(state, *system, threads, stop);
  const SourceRows& right = integral.boundary.right;
  const std::vector<int>& rows = *integral.functions;
  const auto functions = static_cast<int>(system->volumes.size());
  if (stop.stop_requested()) return {};

  BoxGreen green;
  for (Eigen::MatrixXd& slope : green.slope) slope.setZero(count, count);
  const std::vector<std::vector<Slope>> slopes = this->slopes(state, system->functions);
  // w = w1 + K^-1 r with r = b - K w1, so that w_p . b_q = w1_p . b_q + r_p . (w1_q + K^-1 r_q): what w1 lacks is of
  // the order of 1e-4, and the products with r may be of single precision.
  SourceRows first = std::move(integral.boundary.potentials); // w1 + s: - oint I s_p s_q,n is of the same kind
  if (first.size() == 0) first = SourceRows::Zero(right.rows(), count);
  const std::size_t numbers = std::size_t(functions) * std::size_t(count);
  UnsetArray<float> residual(numbers), field(numbers); // r, w
  Eigen::VectorXd overVolume(count);                   // of w1
  forChunks(batches, 1, threads, [&](int b, int) {
    if (stop.stop_requested()) return;
    const int from = b * batchColumns, some = std::min(batchColumns, count - from);
    LaneSides sides(functions - 1, 1); // node 0's equation follows from the others
    LaneSides::Lanes b32 = sides.lanes(sides.right), w1 = sides.lanes(sides.first), w = sides.lanes(sides.x);
    Eigen::Matrix<double, 1, batchColumns> netCurrent = Eigen::Matrix<double, 1, batchColumns>::Zero();
    netCurrent.head(some) = integral.netCurrent.segment(from, some);
    b32.noalias() = -system->volumes * netCurrent;
    for (std::size_t i = 0; i < rows.size(); ++i)
      b32.row(rows[i]).head(some) += right.row(Eigen::Index(i)).segment(from, some);
    system->factor.solve(sides, stop);
    for (std::size_t i = 0; i < rows.size(); ++i)
      first.row(Eigen::Index(i)).segment(from, some) += w1.row(rows[i]).head(some);
    overVolume.segment(from, some) = (w1.transpose() * system->volumes).head(some);
    for (int n = 0; n < functions; ++n)
      for (int k = 0; k < some; ++k) {
        residual.data()[std::size_t(n) * count + from + k] = static_cast<float>(b32(n, k));
        field.data()[std::size_t(n) * count + from + k] = static_cast<float>(w(n, k));
      }
    for (std::size_t p = 0; p < slopes.size(); ++p)
      for (const Slope& each : slopes[p])
        for (std::size_t i = 0; i < 3; ++i)
          green.slope[i].row(Eigen::Index(p)).segment(from, some) +=
              each.weight(Eigen::Index(i)) * w.row(each.row).head(some);
  });
  if (stop.stop_requested()) return {};

  // Rows p <= q, by complete batches.
  green.value = std::move(integral.boundary.products);
  Eigen::MatrixXf correction(count, count); // r . w
  forChunks(batches, 1, threads, [&](int task, int) {
    if (stop.stop_requested()) return;
    const int from = (batches - 1 - task) * batchColumns, some = std::min(batchColumns, count - from);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, from + some, some, static_cast<int>(right.rows()), 1,
                first.data(), count, right.data() + from, count, 1, green.value.col(from).data(), count);
    cblas_sgemm(CblasColMajor, CblasNoTrans, CblasTrans, from + some, some, functions, 1, residual.data(), count,
                field.data() + from, count, 0, correction.col(from).data(), count);
    for (int q = from; q < from + some; ++q)
      green.value.col(q).head(from + some) +=
          correction.col(q).head(from + some).cast<double>() - integral.netCurrent(q) * overVolume.head(from + some);
  });
  if (stop.stop_requested()) return {};

  const std::vector<AtElectrode>& atElectrode = system->electrodes;
  const bool heterogeneous = state.conductivity.heterogeneous();
  forChunks(count, 8, threads, [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      for (int q = 0; q < count; ++q) {
        const Eigen::Matrix3Xd& of = system->sources[std::size_t(q)];
        const double scale =
            heterogeneous ? kFourPi * std::exp(atElectrode[std::size_t(p)].value + atElectrode[std::size_t(q)].value)
                          : kFourPi;
        for (Eigen::Index m = p == q ? 1 : 0; m < of.cols(); ++m) {
          const Eigen::Vector3d d = state.electrodes_mm.col(p) - of.col(m);
          const double inverse = 1 / d.norm();
          if (p <= q) green.value(p, q) += inverse / scale;
          for (std::size_t i = 0; i < 3; ++i) {
            const auto axis = static_cast<Eigen::Index>(i);
            green.slope[i](p, q) -= d(axis) * inverse * inverse * inverse / scale;
            if (heterogeneous) green.slope[i](p, q) -= atElectrode[std::size_t(p)].slope(axis) * inverse / scale;
          }
        }
      }
    }
  });
  green.value.triangularView<Eigen::StrictlyLower>() = green.value.transpose();
  return green;
}

std::optional<NodalPotential> DeformedGreen::potential(const FieldState& state, const Eigen::VectorXd& currents,
                                                       int threads, const std::stop_token& stop) const {
  const std::unique_ptr<System> system = systemAt(state, threads, stop);
  if (!system) return {};
  const SourceIntegrals integral = integrals(state, *system, threads, stop);
  if (stop.stop_requested()) return {};
  const FieldFunctions& functions = system->functions;
  LaneSides sides(static_cast<int>(system->volumes.size()) - 1, 1);
  LaneSides::Lanes right = sides.lanes(sides.right);
  right.setZero();
  right.col(0) = -integral.netCurrent.dot(currents) * system->volumes;
  right(*integral.functions, 0) += integral.boundary.right * currents;
  system->factor.solve(sides, stop);
  if (stop.stop_requested()) return {};
  const Eigen::VectorXd field = sides.lanes(sides.x).col(0);

  NodalPotential result{field.head(mesh_.nodes()), Eigen::Matrix3Xd::Zero(3, mesh_.nodes()),
                        Eigen::VectorXd::Zero(currents.size())};
  Eigen::VectorXd elementsAround = Eigen::VectorXd::Zero(mesh_.nodes());
  const FieldConductivity& k = state.conductivity;
  for (int e = 0; e < mesh_.elements(); ++e) {
    const auto nodes = mesh_.tets().elements.col(e);
    Eigen::Matrix<double, FieldFunctions::most, 1> values = Eigen::Matrix<double, FieldFunctions::most, 1>::Zero();
    for (int f = 0; f < functions.count(e); ++f) values(f) = field(functions.row(f, e));
    for (int n = 0; n < 10; ++n) {
      result.gradient.col(nodes(n)) += gradientsIn(functions, state, {e, tetNode(n)}) * values;
      elementsAround(nodes(n)) += 1;
    }
  }
  result.gradient.array().rowwise() /= elementsAround.transpose().array();

  // The sources' part s_q / (m m_q); within a sphere its own is that on its surface. `l` and its `slope` at the point.
  const std::vector<AtElectrode>& atElectrode = system->electrodes;
  const auto addSources = [&](const Eigen::Vector3d& point, double l, const Eigen::Vector3d& slope, double& value,
                              Eigen::Vector3d* gradient) {
    const double root = std::exp(-l);
    for (Eigen::Index q = 0; q < currents.size(); ++q) {
      const Eigen::Matrix3Xd& of = system->sources[std::size_t(q)];
      for (Eigen::Index m = 0; m < of.cols(); ++m) {
        const Eigen::Vector3d d = point - of.col(m);
        const double r = d.norm();
        const bool inside = r < state.radius_mm;
        const double atSource = std::exp(-atElectrode[std::size_t(q)].value);
        const double own = (inside ? atSource : root) * atSource * currents(q) / kFourPi;
        value += own / (inside ? state.radius_mm : r);
        if (gradient && !inside) *gradient -= own / r * (d / (r * r) + slope);
      }
    }
  };
  const Eigen::Matrix3Xd pressureSlopes = this->pressureSlopes(state, functions);
  forChunks(mesh_.nodes(), 256, threads, [&](int begin, int end) {
    if (stop.stop_requested()) return;
    for (int n = begin; n < end; ++n) {
      Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
      const double pressure = k.heterogeneous() ? k.pressures_MPa(n) : 0;
      addSources(state.nodes_mm.col(n), k.halfLogConductivity(pressure),
                 k.halfLogConductivitySlope(pressure) * pressureSlopes.col(n), result.value(n), &gradient);
      result.gradient.col(n) += gradient;
    }
  });
  if (stop.stop_requested()) return {};
  const std::vector<std::vector<Place>> where = places(state);
  for (Eigen::Index p = 0; p < currents.size(); ++p) {
    const Place& place = where[std::size_t(p)].front();
    const FieldFunctions::Point there = functions.at(place.element, place.barycentric);
    for (int f = 0; f < functions.count(place.element); ++f)
      result.electrodes(p) += there.values(f) * field(functions.row(f, place.element));
    addSources(state.electrodes_mm.col(p), atElectrode[std::size_t(p)].value, atElectrode[std::size_t(p)].slope,
               result.electrodes(p), nullptr);
  }
  return result;
}

} // namespace palp
