#include "solver/field/BoundaryIntegrals.h"

#include "model/base/Parallel.h"
#include "solver/element/LaneKernels.h"
#include "solver/element/LaneVector.h"

#include <Eigen/Dense>
#include <cblas.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace palp {

namespace {

constexpr int kParts = 8, kFacesAPiece = 16, kNodesAChunk = 128;
constexpr int kFacePoints = BoundaryQuadrature::pointsAFace;
constexpr int kPiecePoints = kFacesAPiece * kFacePoints;

/// Of a face's longest edge: electrodes further away are smooth between its nodes.
constexpr double kNear = 5;

/// Place on a curve that goes from cell to cell (G. M. Morton, 1966), of 1024 cells along each axis.
std::uint64_t alongCurve(const Eigen::Vector3d& share) {
  std::uint64_t place = 0;
  for (int bit = 9; bit >= 0; --bit)
    for (int axis = 0; axis < 3; ++axis)
      place = place << 1U | (static_cast<std::uint64_t>(1023 * share(axis)) >> static_cast<unsigned>(bit) & 1U);
  return place;
}

/// Order of the faces in which neighbours are close together.
std::vector<int> orderOf(const FieldMesh& mesh) {
  const Eigen::Matrix3Xd& nodes = mesh.tets().nodes_mm;
  const Eigen::Vector3d low = nodes.rowwise().minCoeff();
  const double extent = (nodes.rowwise().maxCoeff() - low).maxCoeff();
  std::vector<std::uint64_t> at;
  for (Eigen::Index f = 0; f < mesh.faces().cols(); ++f)
    at.push_back(alongCurve((nodes(Eigen::all, mesh.faces().col(f).head<3>()).rowwise().mean() - low) / extent));
  std::vector<int> order(at.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return at[std::size_t(a)] < at[std::size_t(b)]; });
  return order;
}

} // namespace

/// What a thread writes on, points x electrodes.
struct BoundaryIntegrals::Room {
  explicit Room(int count) : potential(std::size_t(kPiecePoints) * count), flux(potential.size()) {}
  UnsetArray<double> potential, flux; ///< of the near ones; of all
};

BoundaryIntegrals::BoundaryIntegrals(const FieldMesh& mesh, const Eigen::Matrix3Xd& electrodes_mm)
    : mesh_(&mesh), faces_(mesh.faces()(Eigen::all, orderOf(mesh))), all_(std::size_t(mesh.nodes() + mesh.corners())) {
  std::iota(all_.begin(), all_.end(), 0);
  boundary_.assign(faces_.data(), faces_.data() + faces_.size());
  std::sort(boundary_.begin(), boundary_.end());
  boundary_.erase(std::unique(boundary_.begin(), boundary_.end()), boundary_.end());
  rows_ = faces_.unaryExpr([&](int node) {
    return static_cast<int>(std::lower_bound(boundary_.begin(), boundary_.end(), node) - boundary_.begin());
  });
  findParts(electrodes_mm);
}

void BoundaryIntegrals::findParts(const Eigen::Matrix3Xd& electrodes_mm) {
  const auto faces = static_cast<int>(faces_.cols());
  const Eigen::Matrix3Xd& nodes = mesh_->tets().nodes_mm;
  places_ = rows_;
  std::vector<int> owner(boundary_.size(), -1);
  for (int part = 0; part < kParts; ++part) {
    Part& own = parts_.emplace_back();
    std::vector<int> sharedAt(boundary_.size(), -1);
    const int end = (part + 1) * faces / kParts;
    for (int first = part * faces / kParts; first < end; first += kFacesAPiece) {
      Piece& piece = own.pieces.emplace_back(Piece{first, std::min(kFacesAPiece, end - first)});
      Eigen::Array<bool, Eigen::Dynamic, 1> near = Eigen::Array<bool, Eigen::Dynamic, 1>::Zero(electrodes_mm.cols());
      for (int f = first; f < first + piece.count; ++f) {
        const Eigen::Matrix3d corners = nodes(Eigen::all, faces_.col(f).head<3>());
        double edge = 0;
        for (int k = 0; k < 3; ++k) edge = std::max(edge, (corners.col(k) - corners.col((k + 1) % 3)).norm());
        const Eigen::Vector3d centre = corners.rowwise().mean();
        near = near || (electrodes_mm.colwise() - centre).colwise().norm().transpose().array() < kNear * edge;
        for (int n = 0; n < 6; ++n) {
          const auto row = static_cast<std::size_t>(rows_(n, f));
          if (owner[row] < 0) owner[row] = part;
          if (owner[row] == part) continue;
          if (sharedAt[row] < 0) {
            sharedAt[row] = static_cast<int>(own.shared.size());
            own.shared.push_back(rows_(n, f));
          }
          places_(n, f) = -1 - sharedAt[row];
        }
      }
      for (Eigen::Index p = 0; p < near.size(); ++p)
        if (near(p)) piece.near.push_back(static_cast<int>(p));
    }
  }
}

SourceRows BoundaryIntegrals::potentials(const Eigen::Matrix3Xd& nodes_mm,
                                         const std::vector<Eigen::Matrix3Xd>& sources_mm, int threads) const {
  SourceRows all(Eigen::Index(boundary_.size()), Eigen::Index(sources_mm.size()));
  forChunks(static_cast<int>(boundary_.size()), kNodesAChunk, threads, [&](int begin, int end) {
    const Eigen::Index count = end - begin;
    Eigen::MatrixXd at = Eigen::MatrixXd::Zero(count, 6); // no areas
    for (Eigen::Index i = 0; i < count; ++i)
      at.row(i).head<3>() = nodes_mm.col(boundary_[std::size_t(begin + i)]).transpose();
    const auto part = [&](Eigen::Index k) { return at.col(k).data(); };
    const SurfacePoints points{part(0), part(1), part(2), part(3), part(4), part(5), count};
    Eigen::VectorXd potential(count), flux = Eigen::VectorXd::Zero(count);
    for (std::size_t p = 0; p < sources_mm.size(); ++p) {
      potential.setZero();
      for (Eigen::Index m = 0; m < sources_mm[p].cols(); ++m)
        laneKernels().addPointSource(points, sources_mm[p].col(m).data(), potential.data(), flux.data());
      all.col(Eigen::Index(p)).segment(begin, count) = potential / kFourPi;
    }
  });
  return all;
}

void BoundaryIntegrals::addProducts(const Piece& piece, const SourceRows& potentials, Room& room,
                                    Eigen::MatrixXd& products) const {
  const auto count = static_cast<int>(products.cols()), near = static_cast<int>(piece.near.size());
  const int points = piece.count * kFacePoints;
  for (int i = 0; i < near; ++i)
    for (int f = 0; f < piece.count; ++f) {
      Eigen::Matrix<double, 6, 1> atNodes;
      for (int n = 0; n < 6; ++n) atNodes(n) = potentials(rows_(n, piece.first + f), piece.near[std::size_t(i)]);
      Eigen::Map<Eigen::Matrix<double, kFacePoints, 1>>(room.potential.data() + std::size_t(i) * kPiecePoints +
                                                        std::size_t(f) * kFacePoints) -=
          BoundaryQuadrature::atPoints(atNodes);
    }
  Eigen::MatrixXd some(near, batchColumns);
  for (int q = 0; q < count; q += batchColumns) {
    const int columns = std::min(batchColumns, count - q);
    const auto rows =
        static_cast<int>(std::lower_bound(piece.near.begin(), piece.near.end(), q + columns) - piece.near.begin());
    if (rows == 0) continue;
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, rows, columns, points, -1, room.potential.data(), kPiecePoints,
                room.flux.data() + std::size_t(q) * kPiecePoints, kPiecePoints, 0, some.data(), near);
    for (int c = 0; c < columns; ++c)
      for (int i = 0; i < rows; ++i) products(piece.near[std::size_t(i)], q + c) += some(i, c);
  }
}

BoundaryIntegrals::Result BoundaryIntegrals::at(const Eigen::Matrix3Xd& nodes_mm,
                                                const std::vector<Eigen::Matrix3Xd>& sources_mm,
                                                const FieldFunctions& functions, int threads,
                                                const std::stop_token& stop) const {
  const FieldConductivity& conductivity = functions.conductivity();
  const bool heterogeneous = conductivity.heterogeneous();
  const auto count = static_cast<int>(sources_mm.size());
  const BoundaryQuadrature boundary(faces_, nodes_mm);
  const auto nodes = static_cast<Eigen::Index>(boundary_.size());
  Result result{SourceRows::Zero(nodes, count), potentials(nodes_mm, sources_mm, threads), {}};
  SourceRows weighted = SourceRows::Zero(heterogeneous ? 2 * nodes : 0, count); // by m; then of the corners' functions
  std::vector<Eigen::MatrixXd> products(kParts);
  std::vector<SourceRows> shared(kParts), sharedWeighted(kParts);
  forChunks(kParts, 1, threads, [&](int p, int) {
    const Part& part = parts_[std::size_t(p)];
    products[std::size_t(p)] = Eigen::MatrixXd::Zero(count, count);
    shared[std::size_t(p)] = SourceRows::Zero(Eigen::Index(part.shared.size()), count);
    if (heterogeneous) sharedWeighted[std::size_t(p)] = SourceRows::Zero(2 * Eigen::Index(part.shared.size()), count);
    Room room(count);
    UnsetArray<double> unused(kPiecePoints);
    SourceRows onFaces(6 * kFacesAPiece, count), onFacesWeighted = onFaces, onCorners(3 * kFacesAPiece, count);
    Eigen::Matrix<double, kFacePoints, kFacesAPiece> roots, left; // m, I(1/m) - 1/m
    for (const Piece& piece : part.pieces) {
      if (stop.stop_requested()) return;
      for (int f = 0; f < piece.count && heterogeneous; ++f) {
        const auto root = [&](double pressure) { return std::exp(conductivity.halfLogConductivity(pressure)); };
        const Eigen::Matrix<double, 6, 1> pressures = conductivity.pressures_MPa(faces_.col(piece.first + f));
        roots.col(f) = BoundaryQuadrature::atPoints(pressures).unaryExpr(root);
        left.col(f) =
            BoundaryQuadrature::atPoints(pressures.unaryExpr(root).cwiseInverse()) - roots.col(f).cwiseInverse();
      }
      auto next = piece.near.begin();
      for (int q = 0; q < count; ++q) {
        double* flux = room.flux.data() + std::size_t(q) * kPiecePoints;
        double* potential = unused.data();
        if (next != piece.near.end() && *next == q)
          potential = room.potential.data() + std::size_t(next++ - piece.near.begin()) * kPiecePoints;
        boundary.sources(sources_mm[std::size_t(q)], piece.first, piece.count, potential, flux);
        for (int f = 0; f < piece.count; ++f) {
          const Eigen::Index row = 6 * Eigen::Index(f);
          onFaces.col(q).segment<6>(row) = BoundaryQuadrature::onShapes(flux + f * kFacePoints);
          if (!heterogeneous) continue;
          Eigen::Matrix<double, kFacePoints, 1> own =
              Eigen::Map<const Eigen::Matrix<double, kFacePoints, 1>>(flux + f * kFacePoints)
                  .cwiseProduct(roots.col(f));
          onFacesWeighted.col(q).segment<6>(row) = BoundaryQuadrature::onShapes(own.data());
          own.array() *= left.col(f).array();
          onCorners.col(q).segment<3>(3 * Eigen::Index(f)) = BoundaryQuadrature::onCorners(own.data());
        }
      }
      const auto subtract = [&](const SourceRows& from, SourceRows& rows, SourceRows& apart) {
        for (int f = 0; f < piece.count; ++f)
          for (int n = 0; n < 6; ++n) {
            const int place = places_(n, piece.first + f);
            auto row = place < 0 ? apart.row(-1 - place) : rows.row(place);
            row -= from.row(6 * Eigen::Index(f) + n);
          }
      };
      subtract(onFaces, result.right, shared[std::size_t(p)]);
      if (heterogeneous) subtract(onFacesWeighted, weighted, sharedWeighted[std::size_t(p)]);
      for (int f = 0; f < piece.count && heterogeneous; ++f)
        for (int corner = 0; corner < 3; ++corner) {
          if (!functions.isRough(faces_(corner, piece.first + f))) continue;
          const int place = places_(corner, piece.first + f);
          auto row = place < 0 ? sharedWeighted[std::size_t(p)].row(Eigen::Index(part.shared.size()) - 1 - place)
                               : weighted.row(nodes + place);
          row -= onCorners.row(3 * Eigen::Index(f) + corner);
        }
      addProducts(piece, result.potentials, room, products[std::size_t(p)]);
    }
  });
  result.products = Eigen::MatrixXd::Zero(count, count);
  if (stop.stop_requested()) return result;
  for (std::size_t p = 0; p < kParts; ++p) {
    result.products += products[p];
    for (std::size_t i = 0; i < parts_[p].shared.size(); ++i) {
      result.right.row(parts_[p].shared[i]) += shared[p].row(Eigen::Index(i));
      if (!heterogeneous) continue;
      weighted.row(parts_[p].shared[i]) += sharedWeighted[p].row(Eigen::Index(i));
      weighted.row(nodes + parts_[p].shared[i]) += sharedWeighted[p].row(Eigen::Index(parts_[p].shared.size() + i));
    }
  }
  if (!heterogeneous) return result;
  forChunks((count + batchColumns - 1) / batchColumns, 1, threads, [&](int batch, int) {
    const int first = batch * batchColumns, some = std::min(batchColumns, count - first);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, first + some, some, static_cast<int>(nodes), 1,
                result.potentials.data(), count, result.right.data() + first, count, 1,
                result.products.col(first).data(), count);
  });
  result.potentials.resize(0, 0);
  result.right = SourceRows::Zero(Eigen::Index(all_.size()), count);
  for (Eigen::Index i = 0; i < nodes; ++i) {
    const int node = boundary_[std::size_t(i)];
    result.right.row(node) = weighted.row(i);
    if (node < mesh_->corners()) result.right.row(mesh_->nodes() + node) = weighted.row(nodes + i);
  }
  return result;
}

} // namespace palp
