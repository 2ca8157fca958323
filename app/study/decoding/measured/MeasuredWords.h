#pragma once

#include "io/Decoder.h"

#include <string>
#include <vector>

namespace palp {

/// What a validation with measured rows found, as sentences for the command line and the window: how rows depend on
/// each other, what was left out together, the errors, what was taken. None for a decoder that was trained otherwise.
std::vector<std::string> measuredSentences(const Decoder& decoder, std::size_t samples, bool hasClock);

/// What a user must know before relying on it: no better than the mean, another recording errs more.
std::vector<std::string> measuredWarnings(const Decoder& decoder);

/// "12 of 100 samples are outside what was trained"; empty where they are as few as among later rows.
std::string outsideWarning(const std::vector<bool>& outside);

} // namespace palp
