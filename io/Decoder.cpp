#include "io/Decoder.h"

namespace palp {

std::vector<DecoderKind> allDecoderKinds() {
  std::vector<DecoderKind> kinds;
  for (const auto& [kind, text] : kDecoderKinds.all()) kinds.push_back(kind);
  return kinds;
}

} // namespace palp
