#pragma once

#include "app/study/decoding/TrainOptions.h"
#include "io/Decoder.h"
#include "model/SampleSet.h"
#include "model/SensorDesign.h"

#include <functional>
#include <stop_token>
#include <string>

namespace palp {

/// Fits a decoder. `design` is needed by two-step-gn (Eq. (1)) and of use to touch; without it the first throws Error,
/// as everything does from which no decoder can be made, and Cancelled where it was stopped. `progress` gets a share
/// 0..1 and what is being done.
Decoder trainDecoder(const SampleSet& samples, const SensorDesign* design, const TrainOptions& options,
                     const std::stop_token& stop = {},
                     const std::function<void(double, const std::string&)>& progress = {});

} // namespace palp
