#pragma once

#include "app/study/decoding/Calibration.h"

#include <QString>

namespace palp {

/// What a calibration came to, as rich text: frames, coverage and errors before and after, and what is wrong with it;
/// `age_days`: of its newest frame.
QString calibrationWords(const Calibration& calibration, double age_days);

} // namespace palp
