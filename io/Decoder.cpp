#include "io/Decoder.h"

namespace palp {

std::vector<DecoderKind> allDecoderKinds() {
  std::vector<DecoderKind> kinds;
  for (const auto& [kind, text] : kDecoderKinds.all())
    if (kind != DecoderKind::TouchInversion) kinds.push_back(kind);
  return kinds;
}

bool takesPlace(DecoderKind kind) {
  switch (kind) {
  case DecoderKind::Rbf:
  case DecoderKind::Linear:
  case DecoderKind::Polynomial2:
  case DecoderKind::Polynomial3:
  case DecoderKind::GaussianProcess:
  case DecoderKind::BackPropagation:
  case DecoderKind::TouchInversion:
    return true;
  case DecoderKind::TwoStepBackPropagation:
  case DecoderKind::TwoStepGaussNewton:
  case DecoderKind::MaximumLikelihood:
    return false;
  }
  return false;
}

} // namespace palp
