#pragma once

#include "solver/SensorMesh.h"

namespace palp {

/// The standard mesh size of a design over that of the paper's: sizes that reports name for the paper's block are the
/// same share of another one.
inline double meshShare(const SensorDesign& design) {
  return standardMeshSize_mm(design) / standardMeshSize_mm(paperDesign());
}

} // namespace palp
