#pragma once

#include "app/study/live/ForceDecoder.h"
#include "model/LoadCase.h"

namespace palp {

/// What was decoded as a load of the model: forces on areas, or the touch at its place. A touch is the indenter of the
/// decoder's training, as large as it was found to be, or a disc of 1 mm where that is not known or where it pulls.
/// Forces within the noise are left out.
LoadCase loadOf(const DecodedForces& forces, const Decoder& decoder, const SensorDesign& design);

} // namespace palp
