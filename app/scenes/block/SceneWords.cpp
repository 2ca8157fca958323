#include "app/scenes/block/SceneWords.h"

#include <array>
#include <cstdio>

namespace palp {

namespace {

std::string warpText(double factor) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "displacements drawn %g times as large", factor);
  return factor == 1 ? "displacements drawn in true size" : buffer.data();
}

std::string fractionText(double fraction) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.4g %% of the load", 100 * fraction);
  return buffer.data();
}

/// Nothing happened yet: such a field has no colours, unless they are fixed.
bool unloaded(const NodalFields* fields) {
  return fields == nullptr || !(fields->displacement_mm.cwiseAbs().maxCoeff() > 0);
}

std::vector<std::string> differenceLines(const DeformationState& state, const DeformationOptions& options) {
  if (state.kept == nullptr) return {"Difference to the kept design: not computed"};
  std::vector<std::string> lines{"Difference to the kept design: " + quantityName(options.quantity) +
                                 " of this design less that of the kept one"};
  if (state.keptDesign->block_mm != state.design->block_mm)
    lines.emplace_back("blocks of two sizes: compared at the same shares of their sides");
  return lines;
}

} // namespace

bool nothingColoured(const DeformationState& state, const DeformationOptions& options) {
  if (state.fields == nullptr || (options.lessKept && state.kept == nullptr)) return true;
  return unloaded(state.fields) && !options.fixedRange;
}

std::vector<std::string> sceneWords(const DeformationState& state, const DeformationOptions& options, double warp) {
  if (options.lessKept && state.fields != nullptr) {
    std::vector<std::string> lines = differenceLines(state, options);
    lines.push_back(warpText(warp));
    if (state.loadFraction != 1 || options.fullLoad) lines.push_back(fractionText(state.loadFraction));
    return lines;
  }
  if (unloaded(state.fields) && !(state.fields != nullptr && options.fixedRange)) return {"Block at rest"};
  std::vector<std::string> lines{"Deformation, coloured by " + quantityName(options.quantity), warpText(warp)};
  if (state.loadFraction != 1 || options.fullLoad) lines.push_back(fractionText(state.loadFraction));
  return lines;
}

} // namespace palp
