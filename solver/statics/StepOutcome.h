#pragma once

#include <string>

namespace palp {

/// How a load step of Newton's iteration ends, with contact or without.
enum class StepOutcome { Converged, Inverted, Indefinite, NoContact, TooManyIterations, Diverged, Cancelled };

/// Why a solve ended between the load fraction that was reached and the one that was tried; empty if it converged.
std::string stopReason(StepOutcome outcome, int iterationsAStep, double reached, double tried);

} // namespace palp
