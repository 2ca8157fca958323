#include "solver/InstructionSet.h"

#include "solver/element/ElementKernels.h"

namespace palp {

const char* instructionSetName() {
  switch (instructionSet()) {
  case InstructionSet::Avx512:
    return "avx512";
  case InstructionSet::Avx2:
    return "avx2";
  case InstructionSet::Baseline:
    break;
  }
  return "baseline";
}

} // namespace palp
