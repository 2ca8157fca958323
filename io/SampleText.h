#pragma once

#include "model/SampleSet.h"

#include <string>

namespace palp {

/// The text of a CSV file of samples (SampleFile.h).
std::string samplesText(const SampleSet& set);

/// Reads it back as strictly as the file; `name` is for refusals. Throws Error.
SampleSet parseSamples(const std::string& text, const std::string& name);

} // namespace palp
