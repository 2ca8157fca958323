#include "app/study/reports/layout/TouchLayoutReport.h"

#include "app/study/Median.h"
#include "app/study/reports/layout/LayoutTables.h"
#include "app/study/reports/map/MapQuantities.h"
#include "app/study/reports/networks/NoiseAxis.h"
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

/// Sections in the order of the page.
class TouchLayoutWriter : LayoutReportWriter {
public:
  TouchLayoutWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : LayoutReportWriter(request, std::move(progress), std::move(stop), "layout-touches",
                           {"what", "layout", "x [mm]", "y [mm]", "value"}),
        design_(request.design), range_(request.touches.value_or(touchesOf(request.design))) {}

  std::optional<ReportContent> run() {
    map_ = mapRequest(range_, design_, kShownNoise, {kMapPlaces, kMapPlaces}, "report layout");
    content_.warnings = designWarnings(design_);
    const std::optional<TouchFields> fields = touchFields();
    if (!fields || !findLayouts(*fields) || !makeMaps()) return {};
    introduce();
    table();
    pictures();
    addLayouts({});
    add(ReportHeading{common_("assumptions heading")});
    paragraph("assumptions", {{"law", common_(design_.field() ? "touches by the field" : "touches by pairs")}});
    summarise();
    return finished();
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
    const double half = (kSearched - kFields) / 2;
    return content_.stages.measure("search", [&] {
      return search(touchGoal(fields, map_.touch, kShownNoise, request_.threads), partOf(progress_, kFields, half),
                    partOf(progress_, kFields + half, half));
    });
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
    heading("scope heading");
    paragraph("scope",
              {{"shape", shapeName(range_.shape)},
               {"size", text(map_.touch.radius_mm)},
               {"force", -map_.touch.press()->force_N.z()},
               {"law", law ? words_("by field", {{"readout", kReadouts.name(law->readout)}}) : words_("by pairs")},
               {"noise", kShownNoise},
               {"searched", searched_},
               {"columns", map_.places[0]},
               {"rows", map_.places[1]}});
  }

  static double worstOf(const Eigen::MatrixXd& values) { return values.maxCoeff(); }
  static double medianOf(const Eigen::MatrixXd& values) {
    return median(std::vector<double>(values.data(), values.data() + values.size()));
  }

  void table() {
    ReportTable table = words_.table("deviations", {{"noise", kShownNoise}});
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
    heading("table heading");
    add(std::move(table));
  }

  void pictures() {
    for (std::size_t l = 0; l < maps_.size(); ++l) {
      ReportMap picture;
      picture.file = "place-" + std::to_string(l);
      picture.title = words_("map title", {{"layout", layouts_[l].name}});
      picture.caption = words_("map caption", {{"layout", layouts_[l].name}});
      picture.quantity = "position";
      picture.unit = "mm";
      picture.values = maps_[l].heldPlace_mm.transpose();
      picture.low_mm = map_.low_mm;
      picture.high_mm = map_.high_mm;
      add(std::move(picture));
    }
  }

  void summarise() {
    std::string layouts;
    for (std::size_t l = 0; l < maps_.size(); ++l) {
      const double worst_mm = worstOf(maps_[l].heldPlace_mm);
      layouts += (l == 0 ? "" : ", ") + shortNumber(worst_mm) + " mm " + layouts_[l].name;
      if (l > 0) layouts += " (" + shortNumber(worstOf(maps_[0].heldPlace_mm) / worst_mm) + " times better)";
      content_.figures.emplace_back("worst_place_mm, " + layouts_[l].name, worst_mm);
      content_.figures.emplace_back("median_place_mm, " + layouts_[l].name, medianOf(maps_[l].heldPlace_mm));
    }
    content_.summary = words_("summary", {{"noise", kShownNoise}, {"layouts", layouts}});
  }

  const SensorDesign& design_;
  TouchRange range_;
  TouchMapRequest map_;
  Eigen::Index searched_ = 0;
  std::vector<TouchMap> maps_; ///< of the layouts
};

} // namespace

std::optional<ReportContent> touchLayoutReport(const ReportRequest& request, const ReportProgress& progress,
                                               std::stop_token stop) {
  return TouchLayoutWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
