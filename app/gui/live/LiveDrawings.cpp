#include "app/gui/live/LiveDrawings.h"

#include "model/base/NumberText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace palp {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kPercent = 100;
constexpr std::array<const char*, 3> kCurveNames{"Fx", "Fy", "Fz"};

/// "(0.12, 3.4)", each by `one`.
std::string pair(const Eigen::Vector2d& values, std::string (*one)(double, int), int precision) {
  return "(" + one(values.x(), precision) + ", " + one(values.y(), precision) + ")";
}

/// The first entry that the window shows.
std::size_t firstShown(const LiveHistory& history, double window_s) {
  const auto& entries = history.entries();
  if (entries.empty()) return 0;
  const double from_s = entries.back().t_s - window_s;
  const auto first = std::lower_bound(entries.begin(), entries.end(), from_s,
                                      [](const LiveHistory::Entry& entry, double t_s) { return entry.t_s < t_s; });
  const auto place = static_cast<std::size_t>(first - entries.begin());
  return place > 0 ? place - 1 : 0; // one before, so that the curve reaches the left edge
}

/// What all curves share: time, marks, and the times of an alarm.
StripSpec timeAxis(const LiveHistory& history, const LiveSettings& settings) {
  StripSpec spec;
  spec.window_s = settings.window_s;
  const auto& entries = history.entries();
  if (entries.empty()) return spec;
  spec.end_s = entries.back().t_s;
  bool alarm = false;
  for (std::size_t k = firstShown(history, settings.window_s); k < entries.size(); ++k) {
    const std::string& mark = entries[k].frame->mark;
    const bool over = mark == kAlarmOver;
    if (entries[k].newMark && !over) spec.marks.emplace_back(entries[k].t_s, QString::fromStdString(mark));
    const bool begins = !alarm && mark.starts_with(kAlarmBegins);
    if (begins) spec.spans.push_back({entries[k].t_s, entries[k].t_s});
    alarm = (alarm || begins) && !over;
    if (alarm || (over && entries[k].newMark && !spec.spans.empty())) spec.spans.back()[1] = entries[k].t_s;
  }
  return spec;
}

/// A range that holds all values and 0, in steps of 1, 2 and 5, so that it rests while they move.
std::array<double, 2> roundRange(const std::vector<StripSeries>& curves) {
  double low = 0, high = 0;
  for (const StripSeries& curve : curves)
    for (const double value : curve.y)
      if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  const double size = std::max(high - low, 0.02);
  double step = std::pow(10, std::floor(std::log10(size)));
  if (size / step < 5) step /= 2;
  if (size / step < 5) step /= 2.5;
  return {step * std::floor(low / step - 0.25), step * std::ceil(high / step + 0.25)};
}

/// The range, wider where a value lies outside of it: a force beyond what the network was trained for is seen too.
std::array<double, 2> holding(const std::array<double, 2>& range, const std::vector<StripSeries>& curves) {
  const std::array<double, 2> needed = roundRange(curves);
  std::array<double, 2> wide = range;
  for (const StripSeries& curve : curves)
    for (const double value : curve.y) {
      if (value < range[0]) wide[0] = std::min(range[0], needed[0]);
      if (value > range[1]) wide[1] = std::max(range[1], needed[1]);
    }
  return wide;
}

/// Nothing is drawn through a time without frames.
void breakAt(const LiveHistory::Entry& entry, StripSeries& curve) {
  if (!entry.gap || curve.t_s.empty()) return;
  curve.t_s.push_back(entry.t_s);
  curve.y.push_back(kNone);
  if (!curve.deviation.empty()) curve.deviation.push_back(kNone);
}

Eigen::Index strongest(const DecodedForces& forces) {
  Eigen::Index column = 0;
  forces.forces_N.colwise().squaredNorm().maxCoeff(&column);
  return column;
}

/// The times in which forces are doubted; each reaches to the next frame.
std::vector<ImplausibleSpan> doubts(const LiveHistory& history, const LiveSettings& settings) {
  std::vector<ImplausibleSpan> all;
  const auto& entries = history.entries();
  bool lasts = false;
  for (std::size_t k = firstShown(history, settings.window_s); k < entries.size(); ++k) {
    const DecodedForces& forces = entries[k].frame->forces;
    if (lasts && !entries[k].gap) all.back().to_s = entries[k].t_s;
    const bool doubted = forces.valid && !forces.doubt.empty();
    if (doubted && (!lasts || entries[k].gap)) all.push_back({entries[k].t_s, entries[k].t_s, {}});
    if (doubted) all.back().why = QString::fromStdString(forces.doubt);
    lasts = doubted;
  }
  return all;
}

/// "(1, 2, 3) N", or of the components that are measured "Fz 3 N"; each by `one`.
std::string components(const DecodedForces& forces, const Eigen::Matrix3Xd& values, Eigen::Index column,
                       std::string (*one)(double, int), int precision) {
  const bool whole = forces.measures(0, column) && forces.measures(1, column) && forces.measures(2, column);
  std::string all;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (!forces.measures(axis, column)) continue;
    const std::string value = one(values(axis, column) + 0.0, precision);
    all += (all.empty() ? "" : ", ") +
           (whole ? value : std::string(kCurveNames[static_cast<std::size_t>(axis)]) + ' ' + value);
  }
  return whole ? "(" + all + ") N" : all + " N";
}

/// "Fx, Fy not measured"; empty where all are.
std::string notMeasured(const DecodedForces& forces, Eigen::Index column) {
  std::string all;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    if (!forces.measures(axis, column))
      all += (all.empty() ? "" : ", ") + std::string(kCurveNames[static_cast<std::size_t>(axis)]);
  return all.empty() ? all : all + " not measured";
}

/// Places of wires at `places_mm`: the one nearest to x.
int nearest(const std::vector<double>& places_mm, double x_mm) {
  const auto found = std::min_element(places_mm.begin(), places_mm.end(),
                                      [&](double a, double b) { return std::abs(a - x_mm) < std::abs(b - x_mm); });
  return static_cast<int>(found - places_mm.begin());
}

} // namespace

HeatmapSpec changeHeatmap(const LiveFrame& frame, const std::string& restName, const LiveSettings& settings,
                          const std::optional<std::array<int, 2>>& selected) {
  HeatmapSpec spec;
  spec.title = "dR/R relative to " + restName;
  spec.values = kPercent * frame.change;
  spec.colors = {ColorMap::Diverging, -settings.change_percent, settings.change_percent, "dR/R", "%"};
  spec.selected = selected;
  return spec;
}

StripSpec forceCurves(const LiveHistory& history, const LiveSettings& settings, const Decoder* decoder) {
  StripSpec spec = timeAxis(history, settings);
  spec.title = QObject::tr("Decoded force");
  spec.yLabel = QObject::tr("force [N]");
  spec.empty = QObject::tr("no forces");
  if (decoder != nullptr) {
    const double low = decoder->low_N.minCoeff(), high = decoder->high_N.maxCoeff();
    const double margin = 0.1 * (high - low);
    spec.yRange = {low - margin, high + margin};
  }
  if (settings.forceScale == ForceScale::Fixed) spec.yRange = {-settings.force_N, settings.force_N};
  if (settings.alarmOn && settings.alarm.quantity != ForceQuantity::Size) spec.limits = {settings.alarm.limit_N};
  spec.doubts = doubts(history, settings);
  const auto& entries = history.entries();
  const LiveFrame* valid = history.lastValid();
  if (valid != nullptr && !notMeasured(valid->forces, 0).empty())
    spec.title += QString::fromStdString("; " + notMeasured(valid->forces, 0));
  for (int axis = 0; axis < 3; ++axis) {
    StripSeries curve;
    curve.name = kCurveNames[static_cast<std::size_t>(axis)];
    curve.color = axis;
    bool any = false;
    for (std::size_t k = firstShown(history, settings.window_s); k < entries.size(); ++k) {
      const DecodedForces& forces = entries[k].frame->forces;
      const bool there = forces.valid && forces.measures(axis, strongest(forces));
      any = any || there;
      breakAt(entries[k], curve);
      curve.t_s.push_back(entries[k].t_s);
      curve.y.push_back(there ? forces.forces_N(axis, strongest(forces)) : kNone);
      // It holds only where the readings are those of a touch like the training's.
      const bool known = there && forces.doubt.empty();
      curve.deviation.push_back(known ? forces.standardDeviation_N(axis, strongest(forces)) : kNone);
    }
    if (any) spec.series.push_back(std::move(curve));
  }
  if (settings.forceScale == ForceScale::Automatic) spec.yRange = roundRange(spec.series);
  if (settings.forceScale == ForceScale::Network) spec.yRange = holding(spec.yRange, spec.series);
  return spec;
}

StripSpec changeCurves(const LiveHistory& history, const LiveSettings& settings,
                       const std::vector<std::array<int, 2>>& cells) {
  StripSpec spec = timeAxis(history, settings);
  spec.title = QObject::tr("dR/R");
  spec.yLabel = QObject::tr("dR/R [%]");
  spec.yRange = {-settings.change_percent, settings.change_percent};
  spec.empty = QObject::tr("no readings yet; click a cell of the heatmap to see its curve");
  const auto& entries = history.entries();
  if (entries.empty()) return spec;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    StripSeries curve;
    curve.name = QString("%1, %2").arg(cells[c][0]).arg(cells[c][1]);
    curve.color = static_cast<int>(c);
    for (std::size_t k = firstShown(history, settings.window_s); k < entries.size(); ++k) {
      breakAt(entries[k], curve);
      const Eigen::MatrixXd& change = entries[k].frame->change;
      const bool there = cells[c][0] < change.rows() && cells[c][1] < change.cols();
      curve.t_s.push_back(entries[k].t_s);
      curve.y.push_back(there ? kPercent * change(cells[c][0], cells[c][1]) : kNone);
    }
    spec.series.push_back(std::move(curve));
  }
  return spec;
}

std::vector<std::array<int, 2>> areaCells(const SensorDesign& design, Eigen::Index rows, Eigen::Index columns) {
  std::vector<std::array<int, 2>> cells;
  for (int area = 0; area < design.areas.count(); ++area) {
    const Rectangle box = design.areaRectangle(area);
    const Eigen::Vector2d centre = 0.5 * (box.low_mm + box.high_mm);
    const Eigen::Vector2d share = centre.cwiseQuotient(design.block_mm.head<2>());
    const bool same = design.rowWires() == rows && design.columnWires() == columns;
    const int row =
        same ? nearest(design.upper.wire_mm, centre.y()) : static_cast<int>(share.y() * static_cast<double>(rows));
    const int column =
        same ? nearest(design.lower.wire_mm, centre.x()) : static_cast<int>(share.x() * static_cast<double>(columns));
    cells.push_back({row, column});
  }
  return cells;
}

std::vector<LiveArrow> arrowsOf(const DecodedForces& forces) {
  std::vector<LiveArrow> arrows;
  if (!forces.valid) return arrows;
  for (Eigen::Index column = 0; column < forces.forces_N.cols(); ++column) {
    if (!forces.shown[static_cast<std::size_t>(column)]) continue;
    const int area = forces.forces_N.cols() > 1 ? static_cast<int>(column) : forces.area.value_or(0);
    arrows.push_back({area,
                      forces.forces_N.col(column),
                      forces.place_mm,
                      forces.placeDeviation_mm.value_or(Eigen::Vector2d::Zero()),
                      {forces.measures(0, column), forces.measures(1, column), forces.measures(2, column)}});
  }
  return arrows;
}

std::string truthLine(const SimulatedTouch::Truth& truth, const DecodedForces& forces) {
  const Eigen::Vector2d at = truth.place_mm.value_or(Eigen::Vector2d::Zero());
  const std::string line =
      "true touch (cross) at " + pair(at, withDecimals, 2) + " mm, " + withDecimals(truth.force_N.z(), 2) + " N";
  return forces.place_mm ? line + "; decoded " + withDecimals((*forces.place_mm - at).norm(), 2) + " mm off" : line;
}

std::vector<std::string> forceLines(const LiveFrame& frame, const LiveSettings& settings, const std::string& note) {
  std::vector<std::string> lines{"Force vectors, " + withDigits(settings.arrow_mm_per_N, 6) + " mm per N"};
  const DecodedForces& forces = frame.forces;
  if (!forces.valid) {
    if (!forces.reason.empty()) lines.push_back("no forces: " + forces.reason);
    return lines;
  }
  // Deviations and areas hold only where the readings are those of a touch like the training's.
  if (!forces.doubt.empty()) {
    lines.push_back("implausible: " + forces.doubt);
    return lines;
  }
  for (Eigen::Index column = 0; column < forces.forces_N.cols(); ++column) {
    if (!forces.shown[static_cast<std::size_t>(column)]) continue;
    lines.push_back("standard deviation " + components(forces, forces.standardDeviation_N, column, withDigits, 1));
    if (const std::string none = notMeasured(forces, column); !none.empty()) lines.push_back(none);
    if (forces.place_mm) {
      const Eigen::Vector2d at = *forces.place_mm, off = forces.placeDeviation_mm.value_or(Eigen::Vector2d::Zero());
      lines.push_back("touch at " + pair(at, withDecimals, 2) + " mm, deviation " + pair(off, withDigits, 1) + " mm");
    }
    if (forces.area && forces.forces_N.cols() == 1)
      lines.push_back("area " + std::to_string(*forces.area) + ", confidence " +
                      withDecimals(kPercent * forces.areaConfidence, 0) + " %");
  }
  if (lines.size() == 1) {
    const Eigen::Index column = strongest(forces);                                       // the curves draw this one
    const Eigen::Matrix3Xd hundredths_N = (100 * forces.forces_N.array()).round() / 100; // noise moves no digit
    lines.push_back("no touch: " + components(forces, hundredths_N, column, withDecimals, 2) +
                    " is within its deviation, " +
                    components(forces, forces.standardDeviation_N, column, withDigits, 1));
  }
  if (forces.missingReadings > 0)
    lines.push_back("without " + std::to_string(forces.missingReadings) + " of " + std::to_string(forces.readings) +
                    " readings: larger deviations");
  if (!note.empty()) lines.push_back(note);
  return lines;
}

} // namespace palp
