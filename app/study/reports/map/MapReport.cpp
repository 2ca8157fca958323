#include "app/study/reports/map/MapReport.h"

#include "app/study/Median.h"
#include "app/study/reports/Csv.h"
#include "app/study/reports/ReportPage.h"
#include "app/study/reports/map/MapQuantities.h"
#include "app/study/reports/networks/NoiseAxis.h"
#include "model/DesignError.h"
#include "model/FieldAtRest.h"
#include "model/RowColumnResistance.h"
#include "model/TouchRange.h"
#include "model/base/Text.h"
#include "solver/ConductionBatch.h"
#include "solver/SensorMesh.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace palp {

namespace {

constexpr double kStepsAcross = 30;               // of the face's shorter side: 1 mm on the paper's block
constexpr std::size_t kCheckedTouches = 8;        // one batch of lanes
constexpr double kMapsFrom = 0.6, kMapsTo = 0.75; // of the progress

/// Finite values, or none where there is none.
std::vector<double> finite(const Eigen::MatrixXd& values) {
  std::vector<double> result;
  for (const double value : values.reshaped())
    if (std::isfinite(value)) result.push_back(value);
  return result;
}

/// "median / worst", of the places where there is a number.
std::string medianAndWorst(const Eigen::MatrixXd& values) {
  const std::vector<double> all = finite(values);
  if (all.empty()) return "nowhere";
  return shortNumber(median(all)) + " / " + shortNumber(*std::max_element(all.begin(), all.end()));
}

std::string sentence(std::string words) {
  words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
  return words;
}

struct MapOfSize {
  double size_mm = 0;
  TouchMap map;
};

class MapWriter {
public:
  MapWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : request_(request), design_(request.design), progress_(std::move(progress)), stop_(std::move(stop)),
        range_(request.touches.value_or(touchesOf(request.design))) {}

  std::optional<ReportContent> run() {
    ask();
    content_.title = "Resolution over the surface";
    content_.warnings = designWarnings(design_);
    progress(0, "the readings at rest");
    const LinearReadings readings =
        content_.stages.measure("readings", [&] { return readingsAtRest(design_, request_.threads, stop_); });
    progress(0.1, "mesh and factorisation");
    Mesh mesh = content_.stages.measure(
        "mesh", [&] { return sensorMesh(design_, meshForTouches(design_, range_, request_.mesh), stop_); });
    const HyperelasticProblem problem(design_, std::move(mesh));
    if (content_.stages.measure("factorise", [&] { return problem.findFactor(request_.threads, stop_); }) == 0)
      return {};
    progress(0.3, "influence surfaces");
    const auto surfaces = content_.stages.measure(
        "influence", [&] { return InfluenceSurfaces::find(problem, readings, request_.threads, stop_); });
    if (!surfaces) return {};
    content_.stages.measure("map", [&] { makeMaps(*surfaces); });
    introduce(readings);
    tables();
    pictures();
    progress(kMapsTo, "touches solved as they are");
    if (!content_.stages.measure("solve", [&] { return compareWithSolves(problem, *surfaces); })) return {};
    assumed();
    summarise();
    content_.csv = csv_.text();
    return std::move(content_);
  }

private:
  void progress(double share, const std::string& what) const {
    if (progress_) progress_(share, what);
  }

  /// What is asked, but for the size.
  void ask() {
    const double step_mm = design_.block_mm.head<2>().minCoeff() / kStepsAcross;
    std::array<int, 2> places{};
    for (Eigen::Index axis = 0; axis < 2; ++axis)
      places[static_cast<std::size_t>(axis)] =
          static_cast<int>(std::round((range_.high_mm - range_.low_mm)(axis) / step_mm)) + 1;
    base_ = mapRequest(range_, design_, kShownNoise, places, "report map");
  }

  void makeMaps(const InfluenceSurfaces& surfaces) {
    std::vector<double> sizes{range_.smallest_mm, (range_.smallest_mm + range_.largest_mm) / 2, range_.largest_mm};
    sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      progress(kMapsFrom + (kMapsTo - kMapsFrom) * static_cast<double>(i) / static_cast<double>(sizes.size()),
               "map for " + text(sizes[i]) + " mm");
      TouchMapRequest request = base_;
      request.touch.radius_mm = sizes[i];
      maps_.push_back({sizes[i], touchMap(surfaces, request, request_.threads, stop_)});
    }
  }

  void introduce(const LinearReadings& readings) {
    const FieldLaw* law = design_.field();
    content_.parts.push_back(ReportHeading{"Scope"});
    content_.parts.push_back(ReportWords{
        "A " + shapeName(range_.shape) + " presses with " + text(force_N()) + " N at each of " +
        std::to_string(base_.places[0]) + " x " + std::to_string(base_.places[1]) + " positions from (" +
        text(base_.low_mm.x()) + ", " + text(base_.low_mm.y()) + ") to (" + text(base_.high_mm.x()) + ", " +
        text(base_.high_mm.y()) + ") mm. All " + std::to_string(readings.gradient_per_mm.rows()) + " resistances by " +
        (law ? "the field, read-out " + kReadouts.name(law->readout) : std::string("Eq. (1)")) +
        " are read, each with independent normal noise of " + text(base_.relativeNoise) +
        " of its value. The numbers are Cramer-Rao bounds: no estimate without a bias has smaller deviations; all are "
        "proportional to the noise, except the two-point distance, which grows with its root at most."});
    content_.parts.push_back(ReportWords{
        "Smallest detectable force: a normal force at a known position whose signal is three deviations. Without "
        "friction the normal force and the position are unknown; with sticking friction all three forces and the "
        "position. The "
        "deviation of a position is the root of the sum of the squares of those along x and y; it goes with one over "
        "the "
        "force. Two-point distance: two touches of half the force each that no single touch explains to within three "
        "deviations, along x or y, whichever is worse."});
  }

  void tables() {
    ReportTable table{"Deviations at noise " + text(base_.relativeNoise) + " and " + text(force_N()) +
                          " N, median / worst place",
                      {"radius [mm]", "contact radius [mm]"},
                      {},
                      {}};
    for (const MapQuantity& quantity : mapQuantities())
      table.heads.push_back(quantity.name + " [" + quantity.unit + "]");
    for (const MapOfSize& of : maps_) {
      std::vector<std::string> row{text(of.size_mm), shortNumber(of.map.contactRadius_mm)};
      for (const MapQuantity& quantity : mapQuantities()) row.push_back(medianAndWorst(quantity.of(of.map)));
      table.rows.push_back(std::move(row));
      const Eigen::Matrix2Xd places = placesOf(base_);
      for (const MapQuantity& quantity : mapQuantities()) {
        const Eigen::MatrixXd& values = quantity.of(of.map);
        for (Eigen::Index i = 0; i < places.cols(); ++i)
          if (const double value = values.reshaped()(i); std::isfinite(value))
            csv_.add({quantity.name + " [" + quantity.unit + "]", of.size_mm, places(0, i), places(1, i), value});
      }
    }
    content_.parts.push_back(ReportHeading{"What is resolved"});
    content_.parts.emplace_back(std::move(table));
  }

  void pictures() {
    for (const MapQuantity& quantity : mapQuantities()) {
      if (!quantity.drawn) continue;
      for (const MapOfSize& of : maps_) {
        ReportMap picture;
        picture.file = quantity.file + "-" + text(of.size_mm) + "mm";
        picture.caption = sentence(quantity.name) + " over the face, " + shapeName(range_.shape) + " of " +
                          text(of.size_mm) + " mm, noise " + text(base_.relativeNoise) + ".";
        picture.title = quantity.name + ", " + shapeName(range_.shape) + " of " + text(of.size_mm) + " mm";
        picture.quantity = quantity.name;
        picture.unit = quantity.unit;
        picture.values = quantity.of(of.map).transpose();
        picture.low_mm = base_.low_mm;
        picture.high_mm = base_.high_mm;
        if (finite(picture.values).empty()) {
          content_.parts.push_back(ReportWords{picture.title + ": nowhere on these places."});
          continue;
        }
        content_.parts.emplace_back(std::move(picture));
      }
    }
  }

  /// d ln R of touches solved with large strains and their own contact against the linear answer. False: stopped.
  bool compareWithSolves(const HyperelasticProblem& problem, const InfluenceSurfaces& surfaces) {
    TouchRange middle = range_;
    middle.smallest_mm = middle.largest_mm = maps_[maps_.size() / 2].size_mm;
    middle.leastPress_N = middle.mostPress_N = force_N();
    middle.leastFriction = middle.mostFriction = 0;
    middle.grid = {0, 0};
    std::vector<Indenter> touches;
    std::vector<LoadCase> loads;
    for (std::size_t i = 0; i < kCheckedTouches; ++i) {
      touches.push_back(touchAt(middle, request_.seed, i));
      loads.push_back({{}, {}, {touches.back()}});
    }
    const std::vector<TouchInfluence> linear = surfaces.of(touches, request_.threads, stop_);
    BatchOptions options;
    options.threads = request_.threads;
    options.relativeTolerance = 1e-4; // far below what is left out
    BatchSolver batch(problem, options);
    const auto resistances = resistancesOf(problem, batch, options, loads);
    if (resistances.empty()) return false;
    const Eigen::MatrixXd rest = resistancesAtRest();
    double left = 0, whole = 0;
    for (std::size_t i = 0; i < touches.size(); ++i) {
      const Eigen::VectorXd solved = (resistances[i].array() / rest.array()).log().matrix().reshaped();
      left += (solved + force_N() * linear[i].perNewton.col(2)).squaredNorm();
      whole += solved.squaredNorm();
    }
    nonlinear_ = std::sqrt(left / whole);
    csv_.add({"d ln R left out by the linear answer, share", middle.smallest_mm, "", "", nonlinear_});
    return true;
  }

  std::vector<Eigen::MatrixXd> resistancesOf(const HyperelasticProblem& problem, BatchSolver& batch,
                                             const BatchOptions& options, const std::vector<LoadCase>& loads) {
    if (design_.field()) return ConductionBatch(problem, batch, options).solve(loads, {}, stop_).resistances_ohm;
    std::vector<Eigen::MatrixXd> result;
    for (const ElectrodeDisplacements& moved : batch.solve(loads, {}, stop_))
      result.push_back(rowColumnResistances(design_, moved));
    return result;
  }

  Eigen::MatrixXd resistancesAtRest() const {
    if (const FieldLaw* law = design_.field())
      return NetworkReading(networkAtRest(design_, *law), law->readout).resistances_ohm();
    return rowColumnResistances(design_, ElectrodeDisplacements::atRest(design_));
  }

  void assumed() {
    content_.parts.push_back(ReportHeading{"What is assumed"});
    content_.parts.push_back(
        ReportWords{"The sensor is taken as linear, at rest: the block's answer by influence surfaces (one solve a "
                    "resistance), the "
                    "contact's radius and pressure by Hertz and by the layer's integral equation. Of " +
                    std::to_string(kCheckedTouches) +
                    " touches at random places solved with large strains and their own contact, "
                    "this linear answer leaves out " +
                    shortNumber(100 * nonlinear_) + " % of d ln R (root mean square). " +
                    (design_.field() ? kFieldTouched : kPairsTouched)});
  }

  void summarise() {
    const MapOfSize& middle = maps_[maps_.size() / 2];
    const auto add = [&](const char* name, const Eigen::MatrixXd& values) {
      const std::vector<double> all = finite(values);
      if (all.empty()) return;
      content_.figures.emplace_back(std::string(name) + ", median", median(all));
      content_.figures.emplace_back(std::string(name) + ", worst", *std::max_element(all.begin(), all.end()));
    };
    add("smallest_force_N", middle.map.smallestForce_N);
    add("place_mm", middle.map.heldPlace_mm);
    add("place_without_friction_mm", middle.map.slipperyPlace_mm);
    add("two_point_mm", middle.map.twoPoint_mm);
    content_.figures.emplace_back("left_out_percent", 100 * nonlinear_);
    content_.summary = "A " + shapeName(range_.shape) + " of " + text(middle.size_mm) + " mm, noise " +
                       text(base_.relativeNoise) + ", median / worst place: smallest force seen " +
                       medianAndWorst(middle.map.smallestForce_N) + " N; at " + text(force_N()) + " N the place to " +
                       medianAndWorst(middle.map.slipperyPlace_mm) + " mm without friction, " +
                       medianAndWorst(middle.map.heldPlace_mm) + " mm held by it; two touches apart at " +
                       medianAndWorst(middle.map.twoPoint_mm) + " mm.";
  }

  double force_N() const { return -base_.touch.press()->force_N.z(); }

  const ReportRequest& request_;
  const SensorDesign& design_;
  ReportProgress progress_;
  std::stop_token stop_;
  TouchRange range_;
  TouchMapRequest base_; ///< but for the size
  std::vector<MapOfSize> maps_;
  double nonlinear_ = 0;
  ReportContent content_;
  Csv csv_{{"what", "size [mm]", "x [mm]", "y [mm]", "value"}};
};

} // namespace

std::optional<ReportContent> mapReport(const ReportRequest& request, const ReportProgress& progress,
                                       std::stop_token stop) {
  return MapWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
