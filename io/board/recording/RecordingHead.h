#pragma once

// Private to io/board: the head of a recording as JSON.

#include "io/board/Recording.h"

#include <string>
#include <string_view>

namespace palp {

constexpr std::string_view kRecordingMagic = "PALPREC1"; ///< a recording begins with it
constexpr std::size_t kLongestRecordingHead = 1 << 16;

std::string recordingHeadText(const RecordingHead& head);
/// Throws Error, with the file's name.
RecordingHead parseRecordingHead(std::string_view text, const std::string& file);

} // namespace palp
