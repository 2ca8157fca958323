#pragma once

#include "app/gui/project/Project.h"

#include <QString>

namespace palp {

/// What an edit did, with its values: "block size along x 30 -> 45.5 mm", "area 0: Fz -6 -> -7 N",
/// "Change the spread (spread 1 -> 0.5)". `what` alone where it did more than one such thing.
QString changeWords(const QString& what, const Project& before, const Project& after);

/// How design, load and mesh have changed since results were computed, for the notes over them: "block size along x
/// 30 -> 31 mm since"; at most two such changes by name. Empty where nothing changed.
QString sinceWords(const Project& then, const Project& now);

} // namespace palp
