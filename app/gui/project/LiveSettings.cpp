#include "app/gui/project/LiveSettings.h"

#include "model/base/Error.h"

#include <array>

namespace palp {

namespace {

constexpr std::array<const char*, 4> kNames{"automatic", "board", "simulated", "recording"};

} // namespace

std::string name(LiveSourceKind kind) {
  return kNames[static_cast<std::size_t>(kind)];
}

LiveSourceKind liveSourceKindNamed(const std::string& name) {
  for (std::size_t k = 0; k < kNames.size(); ++k)
    if (name == kNames[k]) return static_cast<LiveSourceKind>(k);
  throw Error("source: '" + name + "'; allowed is automatic, board, simulated or recording");
}

} // namespace palp
