#pragma once

#include "model/Indenter.h"

#include <QString>

namespace palp {

/// A shape as people call it: "flat punch".
QString inWords(IndenterShape shape);

} // namespace palp
