#pragma once

#include "model/base/NamedEnum.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace palp {

/// What a decoder reads.
enum class InputKind { Displacement, Resistance };
inline constexpr NamedEnum kInputKinds("input", std::array{std::pair{InputKind::Displacement, "displacement"},
                                                           std::pair{InputKind::Resistance, "resistance"}});
inline std::string name(InputKind kind) {
  return kInputKinds.name(kind);
}

/// Methods that predict the force from the readings.
enum class DecoderKind {
  Rbf,
  Linear,
  Polynomial2,
  Polynomial3,
  GaussianProcess,
  BackPropagation,
  TwoStepBackPropagation, ///< the paper's step 1 by a back-propagation network (its reference [12]), then step 2
  TwoStepGaussNewton,     ///< step 1 by inverting Eq. (1), or the field, then step 2
  MaximumLikelihood,      ///< inverts a polynomial forward model: area and force together
  TouchInversion,         ///< inverts a forward model of touches by Gaussians: force and position together
};

/// Properties of a kind of decoder. Refusals, disabled fields, comparisons, calibration and the sentences that list
/// decoders follow from this table; which options of training apply is in app/study/decoding/TrainOptionTable.cpp.
struct DecoderTraits {
  DecoderKind kind;
  const char* name;              ///< on the command line and in files
  const char* description;       ///< in the window
  bool ofAreas = true;           ///< learns forces on load areas; otherwise only of touches, with their position
  bool givesPosition = false;    ///< can predict the position of a touch together with its force
  bool hasRbf = false;           ///< is, or ends in, a radial basis function network: spread, centres, solver, tail
  bool hasRidge = false;         ///< solves a linear system whose ridge can be chosen
  bool needsResistances = false; ///< cannot be trained on displacements
  bool usesDesign = false;       ///< trains with the design's file
  bool canBeCalibrated = false;  ///< palp calibrate refines it by labelled frames of a board
};
inline constexpr std::array kDecoderTraits{
    DecoderTraits{.kind = DecoderKind::Rbf,
                  .name = "rbf",
                  .description = "radial basis functions (the paper's network)",
                  .givesPosition = true,
                  .hasRbf = true,
                  .hasRidge = true,
                  .canBeCalibrated = true},
    DecoderTraits{.kind = DecoderKind::Linear,
                  .name = "linear",
                  .description = "linear regression",
                  .givesPosition = true,
                  .hasRidge = true},
    DecoderTraits{.kind = DecoderKind::Polynomial2,
                  .name = "poly2",
                  .description = "polynomial of degree 2",
                  .givesPosition = true,
                  .hasRidge = true},
    DecoderTraits{.kind = DecoderKind::Polynomial3,
                  .name = "poly3",
                  .description = "polynomial of degree 3",
                  .givesPosition = true,
                  .hasRidge = true},
    DecoderTraits{
        .kind = DecoderKind::GaussianProcess, .name = "gp", .description = "Gaussian process", .givesPosition = true},
    DecoderTraits{.kind = DecoderKind::BackPropagation,
                  .name = "bp",
                  .description = "back-propagation network",
                  .givesPosition = true},
    DecoderTraits{.kind = DecoderKind::TwoStepBackPropagation,
                  .name = "two-step-bp",
                  .description = "displacements by back-propagation, then force",
                  .hasRbf = true,
                  .hasRidge = true,
                  .needsResistances = true},
    DecoderTraits{.kind = DecoderKind::TwoStepGaussNewton,
                  .name = "two-step-gn",
                  .description = "displacements by inverting the resistance law, Gauss-Newton, then force",
                  .hasRbf = true,
                  .hasRidge = true,
                  .needsResistances = true,
                  .usesDesign = true},
    DecoderTraits{.kind = DecoderKind::MaximumLikelihood,
                  .name = "ml",
                  .description = "maximum likelihood with a forward model",
                  .canBeCalibrated = true},
    DecoderTraits{.kind = DecoderKind::TouchInversion,
                  .name = "touch",
                  .description = "force and position of a touch, by inverting a forward model",
                  .ofAreas = false,
                  .givesPosition = true,
                  .usesDesign = true,
                  .canBeCalibrated = true}};

constexpr const DecoderTraits& traits(DecoderKind kind) {
  for (const DecoderTraits& known : kDecoderTraits)
    if (known.kind == kind) return known;
  return kDecoderTraits.front(); // not reached: the table above has one row for each kind
}

inline constexpr NamedEnum kDecoderKinds("decoder", [] {
  std::array<std::pair<DecoderKind, const char*>, kDecoderTraits.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = {kDecoderTraits[i].kind, kDecoderTraits[i].name};
  return names;
}());
inline std::string name(DecoderKind kind) {
  return kDecoderKinds.name(kind);
}
/// Kinds that have a property: decodersWith(&DecoderTraits::ofAreas).
std::vector<DecoderKind> decodersWith(bool DecoderTraits::*property);
/// Their names as a list in a sentence: "rbf, ml or touch".
std::string namesOfDecodersWith(bool DecoderTraits::*property);

/// The two modes of a network; any other option overrides the mode.
enum class DecoderMode { Default, Paper };
inline constexpr NamedEnum kDecoderModes("mode", std::array{std::pair{DecoderMode::Default, "default"},
                                                            std::pair{DecoderMode::Paper, "paper"}});
inline std::string name(DecoderMode mode) {
  return kDecoderModes.name(mode);
}

/// What a decoder predicts.
enum class DecoderTarget {
  Force,
  ForceAndPlace ///< of one touch: after the force its position on the top face
};
inline constexpr NamedEnum kDecoderTargets("target",
                                           std::array{std::pair{DecoderTarget::Force, "force"},
                                                      std::pair{DecoderTarget::ForceAndPlace, "force+place"}});

} // namespace palp
