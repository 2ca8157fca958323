#include "app/study/reports/layout/TouchLayoutReport.h"

#include "app/study/Median.h"
#include "app/study/reports/Csv.h"
#include "app/study/reports/ReportPage.h"
#include "app/study/reports/layout/LayoutTables.h"
#include "app/study/reports/map/MapQuantities.h"
#include "app/study/reports/networks/NoiseAxis.h"
#include "io/DesignFile.h"
#include "model/DesignError.h"
#include "model/TouchRange.h"
#include "model/base/Text.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr int kSearchPlaces = 13;                 // along each axis; with 7 a layout is found that is poor between them
constexpr int kMapPlaces = 25;                    // of the maps afterwards
constexpr double kSearchMesh = 1.5;               // times the default size: the search compares, the maps judge
constexpr double kFields = 0.05, kSearched = 0.8; // of the progress: touches solved, search done

/// One writes the report; sections in the order of the page.
class TouchLayoutWriter {
public:
  TouchLayoutWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : request_(request), design_(request.design), progress_(std::move(progress)), stop_(std::move(stop)),
        range_(request.touches.value_or(touchesOf(request.design))) {}

  std::optional<ReportContent> run() {
    map_ = mapRequest(range_, design_, kShownNoise, {kMapPlaces, kMapPlaces}, "report layout");
    content_.title = "Layout for touches: the place that is resolved worst";
    content_.warnings = designWarnings(design_);
    const std::optional<TouchFields> fields = touchFields();
    if (!fields || !findLayouts(*fields) || !makeMaps()) return {};
    introduce();
    table();
    pictures();
    places();
    assumed();
    summarise();
    content_.csv = csv_.text();
    return std::move(content_);
  }

private:
  MeshOptions meshOf(double factor) const {
    MeshOptions mesh = request_.mesh;
    if (!mesh.mapped) mesh.meshSize_mm = factor * mesh.meshSize_mm.value_or(standardMeshSize_mm(design_));
    mesh.electrodesAsNodes = false; // layouts come and go
    return meshForTouches(design_, range_, mesh);
  }

  std::optional<TouchFields> touchFields() {
    if (progress_) progress_(0, "the block's answer to touches");
    TouchMapRequest coarse = map_;
    coarse.places = {std::min(kSearchPlaces, map_.places[0]), std::min(kSearchPlaces, map_.places[1])};
    const Eigen::Matrix2Xd at = placesOf(coarse);
    searched_ = at.cols();
    std::vector<Indenter> touches(static_cast<std::size_t>(at.cols()), map_.touch);
    for (std::size_t i = 0; i < touches.size(); ++i) touches[i].place_mm = at.col(static_cast<Eigen::Index>(i));
    const HyperelasticProblem problem(
        design_, content_.stages.measure("mesh", [&] { return sensorMesh(design_, meshOf(kSearchMesh), stop_); }));
    return content_.stages.measure("touches",
                                   [&] { return TouchFields::find(problem, touches, request_.threads, stop_); });
  }

  bool findLayouts(const TouchFields& fields) {
    const LayoutGoal goal = touchGoal(fields, map_.touch, kShownNoise, request_.threads);
    layouts_.push_back({"before", design_});
    const double half = (kSearched - kFields) / 2;
    struct Kind {
      LayoutFreedom freedom;
      const char* name;
      const char* file;
    };
    for (const Kind& kind : {Kind{LayoutFreedom::SameOnEveryWire, "same on every wire", "better-same.json"},
                             Kind{LayoutFreedom::WireByWire, "wire by wire", "better-wires.json"}}) {
      const double from = kFields + (kind.freedom == LayoutFreedom::WireByWire ? half : 0);
      const auto found = content_.stages.measure("search", [&] {
        return betterLayout(layouts_.back().design, goal, kind.freedom, limits_, request_.seed, stop_,
                            partOf(progress_, from, half));
      });
      if (!found) return false;
      evaluations_ += found->evaluations;
      layouts_.push_back({kind.name, found->layout});
      content_.files.push_back({kind.file, toJson(found->layout)});
    }
    return true;
  }

  /// Of all layouts, at more places and on a finer mesh than the search had.
  bool makeMaps() {
    const HyperelasticProblem problem(
        design_, content_.stages.measure("mesh", [&] { return sensorMesh(design_, meshOf(1), stop_); }));
    for (std::size_t l = 0; l < layouts_.size(); ++l) {
      if (progress_)
        progress_(kSearched + (1 - kSearched) * static_cast<double>(l) / static_cast<double>(layouts_.size()),
                  "map, " + layouts_[l].name);
      const LinearReadings readings = readingsAtRest(layouts_[l].design, request_.threads, stop_);
      const auto surfaces = content_.stages.measure(
          "influence", [&] { return InfluenceSurfaces::find(problem, readings, request_.threads, stop_); });
      if (!surfaces) return false;
      maps_.push_back(
          content_.stages.measure("map", [&] { return touchMap(*surfaces, map_, request_.threads, stop_); }));
    }
    return true;
  }

  void introduce() {
    const FieldLaw* law = design_.field();
    content_.parts.push_back(ReportHeading{"Scope"});
    content_.parts.push_back(ReportWords{
        "A " + shapeName(range_.shape) + " of " + text(map_.touch.radius_mm) + " mm presses with " +
        text(-map_.touch.press()->force_N.z()) +
        " N and is held by friction: its three forces and its position are unknown. All resistances by " +
        (law ? "the field, read-out " + kReadouts.name(law->readout) : std::string("Eq. (1)")) +
        " are read, each with independent normal noise of " + text(kShownNoise) +
        " of its value. The search lowers the largest Cramer-Rao bound of the position (the root of the sum of the "
        "squares "
        "of the deviations along x and y) among " +
        std::to_string(searched_) + " places over the rectangle; the tables and maps are of " +
        std::to_string(map_.places[0]) + " x " + std::to_string(map_.places[1]) + " places, on a finer mesh."});
  }

  static double worstOf(const Eigen::MatrixXd& values) { return values.maxCoeff(); }
  static double medianOf(const Eigen::MatrixXd& values) {
    return median(std::vector<double>(values.data(), values.data() + values.size()));
  }

  void table() {
    ReportTable table{"Deviations at noise " + text(kShownNoise) + ", median / worst place", {"layout"}, {}, {}};
    for (const MapQuantity& quantity : mapQuantities())
      table.heads.push_back(quantity.name + " [" + quantity.unit + "]");
    const Eigen::Matrix2Xd at = placesOf(map_);
    for (std::size_t l = 0; l < maps_.size(); ++l) {
      std::vector<std::string> row{layouts_[l].name};
      for (const MapQuantity& quantity : mapQuantities()) {
        const Eigen::MatrixXd& values = quantity.of(maps_[l]);
        row.push_back(values.allFinite() ? shortNumber(medianOf(values)) + " / " + shortNumber(worstOf(values))
                                         : "not everywhere");
        for (Eigen::Index i = 0; i < at.cols(); ++i)
          if (const double value = values.reshaped()(i); std::isfinite(value))
            csv_.add({quantity.name + " [" + quantity.unit + "]", layouts_[l].name, at(0, i), at(1, i), value});
      }
      table.rows.push_back(std::move(row));
    }
    content_.parts.push_back(ReportHeading{"What is resolved, before and after"});
    content_.parts.emplace_back(std::move(table));
  }

  void pictures() {
    for (std::size_t l = 0; l < maps_.size(); ++l) {
      ReportMap picture;
      picture.file = "place-" + std::to_string(l);
      picture.title = "place, " + layouts_[l].name;
      picture.caption = "Deviation of the position of a sticking touch, " + layouts_[l].name + ".";
      picture.quantity = "place";
      picture.unit = "mm";
      picture.values = maps_[l].heldPlace_mm.transpose();
      picture.low_mm = map_.low_mm;
      picture.high_mm = map_.high_mm;
      content_.parts.emplace_back(std::move(picture));
    }
  }

  void places() {
    content_.parts.push_back(ReportHeading{"The better layouts"});
    content_.parts.push_back(ReportWords{"Found by pattern search (" + std::to_string(evaluations_) +
                                         " layouts judged, seed " + std::to_string(request_.seed) +
                                         "), within what a maker can keep: " + inWords(limits_) +
                                         ". The designs are better-same.json and better-wires.json."});
    content_.parts.emplace_back(placesTable(layouts_));
  }

  void assumed() {
    content_.parts.push_back(ReportHeading{"Assumptions"});
    content_.parts.push_back(ReportWords{
        std::string("The sensor is taken as linear, at rest; palp report map of a layout shows the error of this "
                    "assumption. ") +
        (design_.field() ? kFieldTouched : kPairsTouched)});
  }

  void summarise() {
    content_.summary = "Worst position error of a sticking touch, noise " + text(kShownNoise) + ":";
    for (std::size_t l = 0; l < maps_.size(); ++l) {
      const double worst_mm = worstOf(maps_[l].heldPlace_mm);
      content_.summary += (l == 0 ? " " : ", ") + shortNumber(worst_mm) + " mm " + layouts_[l].name;
      if (l > 0) content_.summary += " (" + shortNumber(worstOf(maps_[0].heldPlace_mm) / worst_mm) + " times better)";
      content_.figures.emplace_back("worst_place_mm, " + layouts_[l].name, worst_mm);
      content_.figures.emplace_back("median_place_mm, " + layouts_[l].name, medianOf(maps_[l].heldPlace_mm));
    }
    content_.summary += ".";
  }

  const ReportRequest& request_;
  const SensorDesign& design_;
  ReportProgress progress_;
  std::stop_token stop_;
  TouchRange range_;
  TouchMapRequest map_;
  MakerLimits limits_;
  Eigen::Index searched_ = 0;
  int evaluations_ = 0;
  std::vector<NamedLayout> layouts_;
  std::vector<TouchMap> maps_; ///< one a layout
  ReportContent content_;
  Csv csv_{{"what", "layout", "x [mm]", "y [mm]", "value"}};
};

} // namespace

std::optional<ReportContent> touchLayoutReport(const ReportRequest& request, const ReportProgress& progress,
                                               std::stop_token stop) {
  return TouchLayoutWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
