#include "io/Decoder.h"

#include "model/base/Error.h"

#include <array>
#include <utility>

namespace palp {
namespace {

constexpr std::array inputNames{std::pair{InputKind::Displacement, "displacement"},
                                std::pair{InputKind::Resistance, "resistance"}};
constexpr std::array decoderNames{std::pair{DecoderKind::Rbf, "rbf"},
                                  std::pair{DecoderKind::Linear, "linear"},
                                  std::pair{DecoderKind::Polynomial2, "poly2"},
                                  std::pair{DecoderKind::Polynomial3, "poly3"},
                                  std::pair{DecoderKind::GaussianProcess, "gp"},
                                  std::pair{DecoderKind::BackPropagation, "bp"},
                                  std::pair{DecoderKind::TwoStepBackPropagation, "two-step-bp"},
                                  std::pair{DecoderKind::TwoStepGaussNewton, "two-step-gn"},
                                  std::pair{DecoderKind::MaximumLikelihood, "ml"}};
constexpr std::array modeNames{std::pair{DecoderMode::Default, "default"}, std::pair{DecoderMode::Paper, "paper"}};

template <class Names, class Value> std::string nameIn(const Names& names, Value value) {
  for (const auto& [known, text] : names)
    if (known == value) return text;
  return {};
}

template <class Names> auto valueIn(const Names& names, const std::string& text, const std::string& what) {
  std::string allowed;
  for (const auto& [value, known] : names) {
    if (text == known) return value;
    allowed += (allowed.empty() ? "" : ", ") + std::string(known);
  }
  throw Error(what + ": '" + text + "'; allowed is " + allowed);
}

} // namespace

std::string name(InputKind kind) {
  return nameIn(inputNames, kind);
}
InputKind inputKindNamed(const std::string& text) {
  return valueIn(inputNames, text, "input");
}
std::string name(DecoderKind kind) {
  return nameIn(decoderNames, kind);
}
DecoderKind decoderKindNamed(const std::string& text) {
  return valueIn(decoderNames, text, "decoder");
}
std::string name(DecoderMode mode) {
  return nameIn(modeNames, mode);
}
DecoderMode decoderModeNamed(const std::string& text) {
  return valueIn(modeNames, text, "mode");
}

std::vector<DecoderKind> allDecoderKinds() {
  std::vector<DecoderKind> kinds;
  for (const auto& [kind, text] : decoderNames) kinds.push_back(kind);
  return kinds;
}

} // namespace palp
