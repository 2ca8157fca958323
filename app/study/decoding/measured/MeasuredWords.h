#pragma once

#include "app/study/decoding/Prediction.h"
#include "io/Decoder.h"

#include <string>
#include <vector>

namespace palp {

/// What a validation with measured rows found, as sentences for the command line and the window: how rows depend on
/// each other, what was left out together, the errors, what was taken. None for a decoder that was trained otherwise.
std::vector<std::string> measuredSentences(const Decoder& decoder, std::size_t samples, bool hasClock);

/// How the rows of a measured table depend on each other, and which rows are left out together.
std::string leftOutInWords(const RowDependence& found, std::size_t samples);

/// The error on samples that were kept back from training, and the share of it within the stated deviations; the
/// prediction is with deviations and of the same samples.
std::string keptBackInWords(const Decoder& decoder, const Prediction& prediction, const SampleSet& kept);

/// What a user must know before relying on it: no better than the mean, another recording errs more.
std::vector<std::string> measuredWarnings(const Decoder& decoder);

/// "12 of 100 samples are outside what was trained"; empty where they are as few as among later rows.
std::string outsideWarning(const std::vector<bool>& outside);

} // namespace palp
