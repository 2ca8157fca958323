#pragma once

namespace palp {

/// Name of the instruction set that the element kernels use here: baseline, avx2 or avx512. Results of two of them
/// differ in their last digits.
const char* instructionSetName();

} // namespace palp
