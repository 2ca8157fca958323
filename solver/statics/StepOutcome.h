#pragma once

#include <string>

namespace palp {

/// How a load step of Newton's iteration ends, with contact or without.
enum class StepOutcome { Converged, Inverted, Locked, Indefinite, NoContact, TooManyIterations, Diverged, Cancelled };

/// Inverted or Locked, by the smallest J that the element kernels report, which is at most 0.
StepOutcome outcomeOfVolume(double smallestJ);

/// Why a solve ended between the load fraction that was reached and the one that was tried; empty if it converged.
std::string stopReason(StepOutcome outcome, int iterationsAStep, double reached, double tried);

} // namespace palp
