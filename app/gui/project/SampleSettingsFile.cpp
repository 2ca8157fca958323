#include "app/gui/project/SampleSettingsFile.h"

#include <QJsonArray>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace palp {

namespace {

constexpr double kMost = 1e6; ///< [mm], [N]: what no block has; rangeOf and the design say the rest

std::pair<double, double> pairOf(const JsonPlace& place, double least, double most) {
  const std::vector<double> both = place.numbers(2);
  if (!(both[0] >= least && both[1] >= both[0] && both[1] <= most))
    place.refuse(std::to_string(least) + " to " + std::to_string(most) + ", the smaller first");
  return {both[0], both[1]};
}

QJsonObject touchesJson(const TouchSampling& touches) {
  QJsonObject object{{"count", touches.count},
                     {"shape", QString::fromStdString(shapeName(touches.shape))},
                     {"press_N", QJsonArray{touches.leastPress_N, touches.mostPress_N}},
                     {"friction", QJsonArray{touches.leastFriction, touches.mostFriction}},
                     {"margin_mm", touches.margin_mm},
                     {"radius_mm", QJsonArray{touches.smallest_mm, touches.largest_mm}},
                     {"rim_mm", touches.rim_mm}};
  return object;
}

TouchSampling touchesOf(const JsonPlace& place) {
  place.onlyKeys({"count", "shape", "radius_mm", "rim_mm", "press_N", "friction", "margin_mm"}, {});
  TouchSampling touches;
  touches.count = place.at("count").integer(kFewestTouches, kMostTouches);
  touches.shape = place.at("shape").named(kIndenterShapes);
  std::tie(touches.smallest_mm, touches.largest_mm) = pairOf(place.at("radius_mm"), 0, kMost);
  touches.rim_mm = place.at("rim_mm").number(0, kMost);
  std::tie(touches.leastPress_N, touches.mostPress_N) = pairOf(place.at("press_N"), 0, kMost);
  std::tie(touches.leastFriction, touches.mostFriction) = pairOf(place.at("friction"), 0, 2);
  touches.margin_mm = place.at("margin_mm").number(0, kMost);
  return touches;
}

} // namespace

QJsonObject samplesJson(const SampleSettings& samples) {
  QJsonObject object{{"per_area", samples.perArea}, {"seed", static_cast<double>(samples.seed)}};
  if (samples.surrogate) object["surrogate"] = true;
  if (samples.touches) object["touches"] = touchesJson(*samples.touches);
  return object;
}

SampleSettings samplesOf(const JsonPlace& place) {
  place.onlyKeys({"per_area", "seed"}, {"surrogate", "touches"});
  SampleSettings samples;
  samples.perArea = place.at("per_area").integer(5, 100000);
  samples.seed = static_cast<std::uint64_t>(place.at("seed").integer(0, 1000000000));
  if (place.has("surrogate")) samples.surrogate = place.at("surrogate").boolean();
  if (place.has("touches")) samples.touches = touchesOf(place.at("touches"));
  return samples;
}

} // namespace palp
