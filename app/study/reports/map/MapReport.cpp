#include "app/study/reports/map/MapReport.h"

#include "app/study/Median.h"
#include "app/study/reports/ReportWriter.h"
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

class MapWriter : ReportWriter {
public:
  MapWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : ReportWriter(request, std::move(progress), std::move(stop), "map",
                     {"what", "size [mm]", "x [mm]", "y [mm]", "value"}),
        design_(request.design), range_(request.touches.value_or(touchesOf(request.design))) {}

  std::optional<ReportContent> run() {
    setMap();
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
    return finished();
  }

private:
  /// All but the size.
  void setMap() {
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
    heading("scope heading");
    paragraph("scope",
              {{"shape", shapeName(range_.shape)},
               {"force", force_N()},
               {"columns", base_.places[0]},
               {"rows", base_.places[1]},
               {"x0", text(base_.low_mm.x())},
               {"y0", text(base_.low_mm.y())},
               {"x1", text(base_.high_mm.x())},
               {"y1", text(base_.high_mm.y())},
               {"readings", readings.gradient_per_mm.rows()},
               {"law", law ? words_("by field", {{"readout", kReadouts.name(law->readout)}}) : words_("by pairs")},
               {"noise", base_.relativeNoise}});
    paragraph("quantities");
  }

  void tables() {
    ReportTable table = words_.table("deviations", {{"noise", base_.relativeNoise}, {"force", force_N()}});
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
    heading("table heading");
    add(std::move(table));
  }

  void pictures() {
    for (const MapQuantity& quantity : mapQuantities()) {
      if (!quantity.drawn) continue;
      for (const MapOfSize& of : maps_) {
        ReportMap picture;
        picture.file = quantity.file + "-" + text(of.size_mm) + "mm";
        picture.caption = words_("map caption", {{"quantity", sentence(quantity.name)},
                                                 {"shape", shapeName(range_.shape)},
                                                 {"size", text(of.size_mm)},
                                                 {"noise", base_.relativeNoise}});
        picture.title = words_(
            "map title", {{"quantity", quantity.name}, {"shape", shapeName(range_.shape)}, {"size", text(of.size_mm)}});
        picture.quantity = quantity.name;
        picture.unit = quantity.unit;
        picture.values = quantity.of(of.map).transpose();
        picture.low_mm = base_.low_mm;
        picture.high_mm = base_.high_mm;
        if (finite(picture.values).empty()) {
          paragraph("no map", {{"title", picture.title}});
          continue;
        }
        add(std::move(picture));
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
    options.relativeTolerance = 1e-4; // far below the error of the linear answer
    BatchSolver batch(problem, options);
    const auto resistances = resistancesOf(problem, batch, options, loads);
    if (resistances.empty()) return false;
    const Eigen::MatrixXd rest = resistancesAtRest_ohm(design_);
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

  void assumed() {
    add(ReportHeading{common_("assumptions heading")});
    paragraph("assumptions", {{"touches", kCheckedTouches},
                              {"percent", 100 * nonlinear_},
                              {"law", common_(design_.field() ? "touches by the field" : "touches by pairs")}});
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
    content_.summary = words_("summary", {{"shape", shapeName(range_.shape)},
                                          {"size", text(middle.size_mm)},
                                          {"noise", base_.relativeNoise},
                                          {"smallest", medianAndWorst(middle.map.smallestForce_N)},
                                          {"force", force_N()},
                                          {"free", medianAndWorst(middle.map.slipperyPlace_mm)},
                                          {"sticking", medianAndWorst(middle.map.heldPlace_mm)},
                                          {"apart", medianAndWorst(middle.map.twoPoint_mm)}});
  }

  double force_N() const { return -base_.touch.press()->force_N.z(); }

  const SensorDesign& design_;
  TouchRange range_;
  TouchMapRequest base_; ///< but for the size
  std::vector<MapOfSize> maps_;
  double nonlinear_ = 0;
};

} // namespace

std::optional<ReportContent> mapReport(const ReportRequest& request, const ReportProgress& progress,
                                       std::stop_token stop) {
  return MapWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
