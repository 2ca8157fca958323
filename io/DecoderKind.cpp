#include "io/DecoderKind.h"

namespace palp {

std::vector<DecoderKind> decodersWith(bool DecoderTraits::*property) {
  std::vector<DecoderKind> kinds;
  for (const DecoderTraits& known : kDecoderTraits)
    if (known.*property) kinds.push_back(known.kind);
  return kinds;
}

std::string namesOfDecodersWith(bool DecoderTraits::*property) {
  const std::vector<DecoderKind> kinds = decodersWith(property);
  std::string names;
  for (std::size_t i = 0; i < kinds.size(); ++i)
    names += (i == 0 ? "" : i + 1 == kinds.size() ? " or " : ", ") + name(kinds[i]);
  return names;
}

} // namespace palp
