#include "app/study/reports/map/TouchMap.h"

#include "model/DesignError.h"
#include "model/FieldAtRest.h"
#include "model/FieldSensitivity.h"
#include "model/RowColumnResistance.h"
#include "model/base/GotExpected.h"
#include "model/base/InverseDiagonal.h"

#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace palp {

namespace {

constexpr double kSeenDeviations = 3; // deviations of the noise
constexpr double kMostPlaces = 1e5;

void requireNoPressureLaw(const SensorDesign& design) {
  if (design.pressureLaw)
    throw DesignError("resistance.pressure_law: " +
                      gotExpected("a law with a kink at rest, where maps are computed", "null"));
}

LinearReadings byPairs(const SensorDesign& design) {
  const Eigen::Index rows = design.rowWires(), columns = design.columnWires();
  const Eigen::Index perRow = design.electrodesPerRowWire(), perColumn = design.electrodesPerColumnWire();
  const Eigen::Matrix3Xd upper = design.upperElectrodes_mm(), lower = design.lowerElectrodes_mm();
  LinearReadings readings;
  readings.points_mm.resize(3, upper.cols() + lower.cols());
  readings.points_mm << upper, lower;
  readings.gradient_per_mm = Eigen::MatrixXd::Zero(rows * columns, 3 * readings.points_mm.cols());
  const ElectrodeDisplacements rest = ElectrodeDisplacements::atRest(design);
  for (Eigen::Index row = 0; row < rows; ++row) {
    RowResistanceJacobian jacobian;
    const Eigen::VectorXd resistances = rowResistances(design, rest, static_cast<int>(row), &jacobian);
    for (Eigen::Index column = 0; column < columns; ++column) {
      auto gradient = readings.gradient_per_mm.row(row + rows * column);
      gradient.segment(3 * row * perRow, 3 * perRow) = jacobian.upper.row(column) / resistances(column);
      gradient.segment(3 * (upper.cols() + column * perColumn), 3 * perColumn) =
          jacobian.lower.row(column) / resistances(column);
    }
  }
  return readings;
}

LinearReadings byField(const SensorDesign& design, const FieldLaw& law, int threads, const std::stop_token& stop,
                       double fineness) {
  const FieldSensitivity field(design, law, SphereModel::Dipoles, fineness, threads);
  const ReadingGradient gradient = field.readingGradient(law.readout, threads, stop);
  const Eigen::Matrix3Xd electrodes = electrodes_mm(design);
  const Eigen::Index count = electrodes.cols(), faces = field.facePoints_mm().cols();
  LinearReadings readings;
  readings.points_mm.resize(3, count + faces);
  readings.points_mm << electrodes, field.facePoints_mm();
  readings.gradient_per_mm.resize(gradient.faces_per_mm.rows(), 3 * (count + faces));
  readings.gradient_per_mm.leftCols(3 * count) = gradient.electrodes_per_mm;
  if (!design.lowerFollowsRubber) {
    const Eigen::Index held = design.lowerElectrodes_mm().cols();
    readings.gradient_per_mm.middleCols(3 * (count - held), 3 * held).setZero();
  }
  for (Eigen::Index p = 0; p < faces; ++p)
    readings.gradient_per_mm.middleCols<3>(3 * (count + p)) =
        gradient.faces_per_mm.col(p) * field.faceNormals().col(p).transpose();
  return readings;
}

/// d ln R by Fz, x and y over the noise.
Eigen::MatrixXd unknowns(const TouchInfluence& of, double Fz_N, double relativeNoise) {
  Eigen::MatrixXd j(of.perNewton.rows(), 3);
  j << of.perNewton.col(2), Fz_N * of.byPlace_per_Nmm;
  return j / relativeNoise;
}

/// Works out the maps from the influences of the touches at all places.
class MapWork {
public:
  MapWork(const TouchMapRequest& request, std::vector<TouchInfluence> influences)
      : request_(request), influences_(std::move(influences)),
        step_mm_((request.high_mm - request.low_mm)
                     .cwiseQuotient(Eigen::Vector2d(request.places[0] - 1, request.places[1] - 1))),
        force_N_(request.touch.press()->force_N.z()) {}

  TouchMap run() const {
    TouchMap map;
    map.contactRadius_mm = influences_.front().radius_mm;
    const int columns = request_.places[0], rows = request_.places[1];
    for (Eigen::MatrixXd* part : {&map.smallestForce_N, &map.slipperyForce_N, &map.slipperyPlace_mm, &map.heldPlace_mm,
                                  &map.twoPoint_mm, &map.heldForce_N[0], &map.heldForce_N[1], &map.heldForce_N[2]})
      part->resize(columns, rows);
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) {
        const TouchInfluence& of = at(x, y);
        map.smallestForce_N(x, y) = kSeenDeviations * request_.relativeNoise / of.perNewton.col(2).norm();
        const TouchDeviations slippery = touchDeviations(of, force_N_, false, request_.relativeNoise);
        map.slipperyForce_N(x, y) = slippery.force_N.z();
        map.slipperyPlace_mm(x, y) = slippery.place_mm.norm();
        const TouchDeviations held = touchDeviations(of, force_N_, true, request_.relativeNoise);
        for (std::size_t axis = 0; axis < 3; ++axis)
          map.heldForce_N[axis](x, y) = held.force_N(static_cast<Eigen::Index>(axis));
        map.heldPlace_mm(x, y) = held.place_mm.norm();
        map.twoPoint_mm(x, y) = twoPoint_mm(x, y, unknowns(of, force_N_, request_.relativeNoise));
      }
    return map;
  }

private:
  [[nodiscard]] const TouchInfluence& at(int x, int y) const {
    return influences_[static_cast<std::size_t>(x + request_.places[0] * y)];
  }

  /// One touch of unknown force and position explains the span of `one`; the remainder of the pair's signal grows
  /// as the square of a small distance, as a power between two of the distances tried.
  [[nodiscard]] double twoPoint_mm(int x, int y, const Eigen::MatrixXd& one) const {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(one);
    const Eigen::MatrixXd span = qr.householderQ() * Eigen::MatrixXd::Identity(one.rows(), one.cols());
    double worst_mm = 0;
    for (int axis = 0; axis < 2; ++axis) {
      const int place = axis == 0 ? x : y, last = request_.places[static_cast<std::size_t>(axis)] - 1;
      double distanceBefore = 0, restBefore = 0, found = std::numeric_limits<double>::quiet_NaN();
      for (int m = 1; place - m >= 0 && place + m <= last; ++m) {
        const int dx = axis == 0 ? m : 0, dy = axis == 1 ? m : 0;
        const Eigen::VectorXd pair = force_N_ / (2 * request_.relativeNoise) *
                                     (at(x - dx, y - dy).perNewton + at(x + dx, y + dy).perNewton).col(2);
        const double distance = 2 * m * step_mm_(axis), rest = (pair - span * (span.transpose() * pair)).norm();
        if (rest >= kSeenDeviations) {
          const double power =
              m == 1 ? 2 : std::max(1., std::log(rest / restBefore) / std::log(distance / distanceBefore));
          found = distance * std::pow(kSeenDeviations / rest, 1 / power);
          break;
        }
        distanceBefore = distance;
        restBefore = rest;
      }
      if (!(found <= worst_mm)) worst_mm = found; // also where it is not a number
      if (std::isnan(worst_mm)) break;
    }
    return worst_mm;
  }

  const TouchMapRequest& request_;
  std::vector<TouchInfluence> influences_;
  Eigen::Vector2d step_mm_;
  double force_N_;
};

} // namespace

TouchMapRequest mapRequest(const TouchRange& range, const SensorDesign& design, double relativeNoise,
                           std::array<int, 2> places, const std::string& what) {
  if (range.shape != IndenterShape::Sphere && range.shape != IndenterShape::Pin && range.shape != IndenterShape::Flat)
    throw DesignError(what + ": shape: " +
                      gotExpected(shapeName(range.shape), "sphere, pin or flat, which have a position along x and y"));
  if (const auto wrong = whyInvalid(range, design)) throw DesignError(what + ": " + *wrong);
  requireNoPressureLaw(design);
  TouchMapRequest request;
  request.touch.shape = range.shape;
  request.touch.radius_mm = (range.smallest_mm + range.largest_mm) / 2;
  request.touch.rim_mm = range.rim_mm;
  request.touch.place_mm = range.low_mm;
  request.touch.control = Press{{0, 0, -(range.leastPress_N + range.mostPress_N) / 2}};
  request.low_mm = range.low_mm;
  request.high_mm = range.high_mm;
  request.relativeNoise = relativeNoise;
  request.places = range.grid[0] > 0 ? std::array{range.grid[0], range.grid[1]} : places;
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (request.places[axis] < 2)
      throw DesignError(what + ": positions along " + "xy"[axis] + ": " +
                        gotExpected(std::to_string(request.places[axis]), "2 or more, on a rectangle wide enough"));
  if (double(request.places[0]) * request.places[1] > kMostPlaces)
    throw DesignError(
        what + ": grid: " +
        gotExpected(std::to_string(request.places[0]) + " x " + std::to_string(request.places[1]) + " positions",
                    "at most 1e5"));
  return request;
}

LinearReadings readingsAtRest(const SensorDesign& design, int threads, const std::stop_token& stop, double fineness) {
  requireNoPressureLaw(design);
  if (const FieldLaw* law = design.field()) return byField(design, *law, threads, stop, fineness);
  return byPairs(design);
}

Eigen::VectorXd leastDeviations(Eigen::MatrixXd slopes) {
  const Eigen::VectorXd scale = slopes.colwise().norm(); // forces and places are of different units
  slopes *= scale.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd information = slopes.transpose() * slopes;
  return inverseDiagonal(information).cwiseSqrt().cwiseQuotient(scale);
}

TouchDeviations touchDeviations(const TouchInfluence& of, double Fz_N, bool held, double relativeNoise,
                                const Eigen::VectorXd& bySize) {
  const Eigen::MatrixXd slippery = unknowns(of, Fz_N, relativeNoise);
  const Eigen::Index sideways = held ? 2 : 0, sizes = bySize.size() > 0 ? 1 : 0;
  Eigen::MatrixXd j(slippery.rows(), sideways + 3 + sizes);
  j.leftCols(sideways) = of.perNewton.leftCols(sideways) / relativeNoise;
  j.middleCols<3>(sideways) = slippery;
  if (sizes > 0) j.rightCols<1>() = bySize / relativeNoise;
  const Eigen::VectorXd found = leastDeviations(std::move(j));
  TouchDeviations result{{0, 0, found(sideways)}, found.segment<2>(sideways + 1)};
  if (held) result.force_N.head<2>() = found.head<2>();
  return result;
}

Eigen::Matrix2Xd placesOf(const TouchMapRequest& request) {
  const int columns = request.places[0], rows = request.places[1];
  Eigen::Matrix2Xd places(2, Eigen::Index(columns) * rows);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const Eigen::Array2d share(static_cast<double>(x) / (columns - 1), static_cast<double>(y) / (rows - 1));
      places.col(x + Eigen::Index(columns) * y) =
          request.low_mm.array() + share * (request.high_mm - request.low_mm).array();
    }
  return places;
}

TouchMap touchMap(const InfluenceSurfaces& surfaces, const TouchMapRequest& request, int threads,
                  const std::stop_token& stop) {
  const Eigen::Matrix2Xd places = placesOf(request);
  std::vector<Indenter> touches(static_cast<std::size_t>(places.cols()), request.touch);
  for (std::size_t i = 0; i < touches.size(); ++i) touches[i].place_mm = places.col(static_cast<Eigen::Index>(i));
  return MapWork(request, surfaces.of(touches, threads, stop)).run();
}

} // namespace palp
