#include "app/gui/design/RestFloor.h"

namespace palp {

namespace {

/// A design whose read-out is one for all: the field at rest does not depend on it.
SensorDesign withoutReadout(SensorDesign design) {
  if (auto* field = std::get_if<FieldLaw>(&design.resistance)) field->readout = Readout::Floating;
  return design;
}

/// The block's answer does not know the law, nor the lower electrodes.
bool sameBlock(const SensorDesign& a, const SensorDesign& b) {
  return a.block_mm == b.block_mm && a.material == b.material && a.areas == b.areas && a.upper == b.upper;
}

DesignBounds fieldBounds(const RestFloor& floor, Readout readout, double relativeNoise) {
  return {floor.field->bound(readout, centreRowWire(floor.design.rowWires()), relativeNoise),
          floor.field->bound(readout, -1, relativeNoise)};
}

} // namespace

bool RestFloor::isOf(const SensorDesign& other, const MeshOptions& otherMesh) const {
  return mesh == otherMesh && withoutReadout(design) == withoutReadout(other);
}

std::shared_ptr<const RestFloor> restFloor(const SensorDesign& design, const MeshOptions& mesh,
                                           const std::shared_ptr<const RestFloor>& before,
                                           const ReportProgress& progress, const std::stop_token& stop) {
  RestFloor floor{design, mesh, {}, {}};
  if (before && before->isOf(design, mesh)) {
    floor.block = before->block;
    floor.field = before->field;
    return std::make_shared<const RestFloor>(std::move(floor));
  }
  if (before && before->mesh == mesh && sameBlock(before->design, design)) {
    floor.block = before->block;
  } else {
    StageLog stages;
    const auto share = [&](double done, const std::string& what) { progress(0.7 * done, what); };
    auto block = AreaResponse::atRest(design, mesh, 0, stages, share, stop);
    if (!block) return nullptr;
    floor.block = std::make_shared<const AreaResponse>(std::move(*block));
  }
  progress(0.7, "Field at rest");
  if (design.field() != nullptr)
    floor.field = std::make_shared<const FieldResponse>(design, *design.field(), *floor.block, 0, 1, stop);
  if (stop.stop_requested()) return nullptr;
  return std::make_shared<const RestFloor>(std::move(floor));
}

DesignBounds boundsAtRest(const RestFloor& floor, double relativeNoise) {
  if (!floor.field) return designBounds(floor.design, *floor.block, relativeNoise);
  return fieldBounds(floor, floor.design.field()->readout, relativeNoise);
}

RestBounds restBounds(const RestFloor& floor, double relativeNoise) {
  SensorDesign pairs = floor.design;
  pairs.resistance = PairsLaw{}; // its rate does not matter in ln R
  RestBounds bounds{designBounds(pairs, *floor.block, relativeNoise), {}};
  for (const auto& [readout, name] : kReadouts.all())
    bounds.readouts.push_back(fieldBounds(floor, readout, relativeNoise));
  return bounds;
}

} // namespace palp
