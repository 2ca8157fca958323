#pragma once

#include "app/gui/project/Project.h"

#include <QString>

namespace palp {

/// What an edit did, with its values: "block size along x 30 -> 45.5 mm", "area 0: Fz -6 -> -7 N". `what` where it did
/// more than one such thing.
QString changeWords(const QString& what, const Project& before, const Project& after);

} // namespace palp
