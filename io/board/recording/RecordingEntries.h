#pragma once

// Private to io/board: the bytes of a recording's entries.

#include "io/board/Recording.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace palp {

constexpr std::size_t kEntryHead = 12; ///< bytes before those of the entry itself

/// What precedes the bytes of an entry.
struct EntryHead {
  RecordingEntry::Kind kind = RecordingEntry::Kind::Raw;
  std::size_t length = 0;
  double hostTime_s = 0;
};

/// What could be the head of an entry: a spoilt byte in it mostly shows.
std::optional<EntryHead> entryHead(std::span<const std::uint8_t> bytes);
/// The bytes of an entry between the reports depend on its kind.
bool isGood(RecordingEntry::Kind kind, std::span<const std::uint8_t> bytes);
/// An entry begins here, by its own checksum or structure; a text only where such an entry follows it.
bool isSurelyEntry(std::span<const std::uint8_t> bytes);

} // namespace palp
