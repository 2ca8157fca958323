#include "app/gui/project/ProjectFields.h"

namespace palp {

/// Two numbers of which the first may not be larger.
static void range(JsonFields& fields, const std::string& key, double& low, double& high, double most) {
  std::array<double, 2> ends{low, high};
  fields.field(key, ends, Within{0, most});
  fields.require(key, ends[0] <= ends[1], "two numbers, the smaller one first");
  low = ends[0];
  high = ends[1];
}

static void describe(JsonFields& fields, TouchSampling& touches) {
  constexpr double kMost = 1e6; // [mm], [N]: beyond any block; rangeOf and the design set the exact limits
  fields.field("count", touches.count, Within{kFewestTouches, kMostTouches});
  fields.field("shape", touches.shape, kIndenterShapes);
  range(fields, "radius_mm", touches.smallest_mm, touches.largest_mm, kMost);
  fields.field("rim_mm", touches.rim_mm, Within{0, kMost});
  range(fields, "press_N", touches.leastPress_N, touches.mostPress_N, kMost);
  range(fields, "friction", touches.leastFriction, touches.mostFriction, 2);
  fields.field("margin_mm", touches.margin_mm, Within{0, kMost});
}

void describe(JsonFields& fields, SampleSettings& samples) {
  fields.field("per_area", samples.perArea, Within{5, 100000});
  fields.field("seed", samples.seed, Within{0, 1e9});
  fields.sparse("surrogate", samples.surrogate, false);
  fields.sparse("touches", samples.touches);
}

} // namespace palp
