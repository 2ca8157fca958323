#pragma once

#include "model/Indenter.h"

#include <string>

namespace palp {

/// SHAPE:SIZES@X,Y:press=FX,FY,FZ[:mu=MU] or ...:depth=D[,SX,SY][:mu=MU] [mm, N], for example
/// sphere:5@15,7.5:press=1,0,-6:mu=0.5 or flat:3,0.3@20,20:depth=0.2. Throws UsageError.
Indenter indenterOption(const std::string& value);

} // namespace palp
