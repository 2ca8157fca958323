#include "app/gui/project/SampleSettings.h"

#include "model/SensorDesign.h"

#include <QObject>

namespace palp {

TouchSampling usualTouches(const SensorDesign& design) {
  const TouchRange usual = touchesOf(design);
  TouchSampling touches;
  touches.leastPress_N = usual.leastPress_N;
  touches.mostPress_N = usual.mostPress_N;
  touches.margin_mm = usual.low_mm.x();
  return touches;
}

TouchRange rangeOf(const TouchSampling& touches, const SensorDesign& design) {
  const bool plane = touches.shape == IndenterShape::Plane;
  TouchRange range = touchesOf(design);
  range.shape = touches.shape;
  range.smallest_mm = plane ? 0 : touches.smallest_mm;
  range.largest_mm = plane ? 0 : touches.largest_mm;
  range.rim_mm = touches.shape == IndenterShape::Flat ? touches.rim_mm : 0;
  range.leastPress_N = touches.leastPress_N;
  range.mostPress_N = touches.mostPress_N;
  range.leastFriction = touches.leastFriction;
  range.mostFriction = touches.mostFriction;
  range.low_mm.setConstant(touches.margin_mm);
  range.high_mm = design.block_mm.head<2>().array() - touches.margin_mm;
  return range;
}

QString countWords(const SampleSettings& samples) {
  return samples.touches ? QObject::tr("%1 touches").arg(samples.touches->count)
                         : QObject::tr("%1 per area").arg(samples.perArea);
}

} // namespace palp
