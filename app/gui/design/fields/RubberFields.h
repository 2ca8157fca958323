#pragma once

#include "app/gui/design/DesignFields.h"

namespace palp {

/// The law of the rubber, then the constants of all laws, in the order of the design file.
std::vector<DesignField> rubberLawFields();

} // namespace palp
