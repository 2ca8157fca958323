#include "app/scenes/block/SceneWords.h"

#include "app/scenes/block/map/FaceMap.h"
#include "model/base/NumberText.h"

#include <cmath>

namespace palp {

namespace {

std::string scaleText(double factor) {
  return factor == 1 ? "displacements drawn in true size"
                     : "displacements drawn " + withDigits(factor, 6) + " times as large";
}

std::string fractionText(double fraction) {
  if (fraction <= 1) return withDigits(100 * fraction, 4) + " % of the load";
  const double step = std::ceil(fraction - 1e-9) - 1; // steps of a path follow the load
  return "step " + withDigits(step, 6) + " of the path, " + withDigits(100 * (fraction - step), 4) + " %";
}

/// Nothing happened yet: such a field has no colours, unless they are fixed.
bool unloaded(const NodalFields* fields) {
  return fields == nullptr || !(fields->displacement_mm.cwiseAbs().maxCoeff() > 0);
}

std::string sizeText(const Eigen::Vector3d& block_mm) {
  return withDigits(block_mm.x(), 4) + " x " + withDigits(block_mm.y(), 4) + " x " + withDigits(block_mm.z(), 4);
}

std::string blockText(const DeformationState& state) {
  return "block " + sizeText(state.design->block_mm) + " mm";
}

std::string placeText(const Eigen::Vector2d& place_mm) {
  return "(" + withDigits(place_mm.x(), 4) + ", " + withDigits(place_mm.y(), 4) + ")";
}

/// Rubber and load areas are the same: so is the deformation, but for the mesh.
bool onlyWiresDiffer(const SensorDesign& now, const SensorDesign& kept) {
  SensorDesign rewired = kept;
  rewired.upper = now.upper;
  rewired.lower = now.lower;
  rewired.lowerFollowsRubber = now.lowerFollowsRubber;
  rewired.resistance = now.resistance;
  rewired.pressureLaw = now.pressureLaw;
  rewired.forceRange = now.forceRange;
  return rewired == now;
}

std::vector<std::string> differenceLines(const DeformationState& state, const DeformationOptions& options) {
  if (state.kept == nullptr)
    return {options.lessUniform ? "Difference from the uniform load: not available yet"
                                : "Difference from the reference design: not available yet"};
  if (options.lessUniform)
    return {"Difference from the same force, uniform on the load area beneath",
            quantityName(options.quantity) + " of the touch minus that of the uniform load"};
  std::vector<std::string> lines{"Difference from the reference design: " + quantityName(options.quantity) +
                                 " of this design minus that of the reference"};
  const Eigen::Vector3d &now = state.design->block_mm, &kept = state.referenceDesign->block_mm;
  if (onlyWiresDiffer(*state.design, *state.referenceDesign))
    lines.emplace_back("the designs differ only in wires and resistances: the rest shown here comes from their meshes");
  if (now == kept) return lines;
  lines.push_back("blocks of two sizes, " + sizeText(now) + " and reference " + sizeText(kept) +
                  " mm: compared and pressed at the same share of their sides");
  const std::vector<PatchLoad>&discs = state.load->patches, &keptDiscs = state.keptLoad->patches;
  for (std::size_t k = 0; k < discs.size() && k < keptDiscs.size(); ++k)
    lines.push_back("pressed at " + placeText(discs[k].centre_mm) + " mm, reference at " +
                    placeText(keptDiscs[k].centre_mm) + " mm");
  const std::vector<Indenter>&bodies = state.load->indenters, &keptBodies = state.keptLoad->indenters;
  for (std::size_t k = 0; k < bodies.size() && k < keptBodies.size(); ++k)
    lines.push_back("indenter at " + placeText(bodies[k].place_mm) + " mm, reference at " +
                    placeText(keptBodies[k].place_mm) + " mm");
  return lines;
}

} // namespace

bool nothingColoured(const DeformationState& state, const DeformationOptions& options) {
  if (state.fields == nullptr || (options.lessReference && state.kept == nullptr)) return true;
  return unloaded(state.fields) && !options.fixedRange;
}

std::vector<std::string> sceneWords(const DeformationState& state, const DeformationOptions& options, double warp) {
  if (state.current != nullptr && state.current->lines.empty()) return {"Computing the current paths..."};
  if (state.current != nullptr) {
    std::vector<std::string> lines{
        "Current of row-wire " + std::to_string(state.current->rowWire) + ", column-wire " +
            std::to_string(state.current->columnWire),
        "each line: " + withDigits(100 * state.current->current_A, 2) + " % of the driven current", scaleText(warp)};
    if (state.loadFraction != 1 || options.fullLoad) lines.push_back(fractionText(state.loadFraction));
    return lines;
  }
  if (options.lessReference && state.fields != nullptr) {
    std::vector<std::string> lines = differenceLines(state, options);
    lines.push_back(scaleText(warp));
    if (state.loadFraction != 1 || options.fullLoad) lines.push_back(fractionText(state.loadFraction));
    return lines;
  }
  if (state.map != nullptr) return {state.map->title, blockText(state)};
  if (unloaded(state.fields) && !(state.fields != nullptr && options.fixedRange))
    return {"Block at rest", blockText(state)};
  std::vector<std::string> lines{"Deformation, coloured by " + quantityName(options.quantity),
                                 blockText(state) + ", " + scaleText(warp)};
  if (state.loadFraction != 1 || options.fullLoad) lines.push_back(fractionText(state.loadFraction));
  return lines;
}

} // namespace palp
