#pragma once

#include "app/gui/project/Project.h"

#include <QString>

namespace palp {

/// What an edit did, with its values: "block size along x 30 -> 45.5 mm", "area 0: Fz -6 -> -7 N",
/// "Change the spread (spread 1 -> 0.5)". `what` alone where it did more than one such thing.
QString changeWords(const QString& what, const Project& before, const Project& after);

/// What design, load and mesh have become since results were computed, for the notes beside them: "block size along x
/// 30 -> 31 mm since"; at most two such things by name. Empty where nothing changed that can be said.
QString sinceWords(const Project& then, const Project& now);

} // namespace palp
