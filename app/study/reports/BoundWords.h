#pragma once

namespace palp {

/// What bounds without and with prior are, for the reports that print them.
inline constexpr const char* kBoundsMean =
    "Without prior: no unbiased decoder is better. With prior: the error of the best linear estimate of forces with "
    "the variance of their range; a decoder that uses the limits of the range can be up to about 5 % better. Always "
    "predicting the mean has an error of 28.9 %.";

} // namespace palp
