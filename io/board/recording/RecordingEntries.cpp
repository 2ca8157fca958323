#include "io/board/recording/RecordingEntries.h"

#include "io/board/ByteOrder.h"
#include "io/board/Tare.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace palp {

namespace {

using Kind = RecordingEntry::Kind;

constexpr std::size_t kTareHead = 16;
constexpr std::size_t kLongestReport = 256; // a board may send more than it should
static_assert(std::endian::native == std::endian::little, "host times are copied byte by byte");

bool isLength(Kind kind, std::size_t length) {
  switch (kind) {
  case Kind::Raw:
    return length >= 1 && length <= kLongestReport;
  case Kind::Mark:
    return true;
  case Kind::Configuration:
  case Kind::Connected:
    return length == kReportBytes;
  case Kind::Tare:
    return length == 0 || (length > kTareHead && (length - kTareHead) % sizeof(double) == 0);
  }
  return false;
}

/// By its ID and its checksum.
bool isReport(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != kReportBytes) return false;
  const auto id = static_cast<ReportId>(bytes[0]);
  return (id == ReportId::Readings || id == ReportId::Event) &&
         littleEndian<2>(bytes, kReportBytes - 2) == crc16(bytes.first(kReportBytes - 2));
}

} // namespace

std::optional<EntryHead> entryHead(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kEntryHead || bytes[0] > static_cast<std::uint8_t>(Kind::Tare) || bytes[1] != 0) return {};
  EntryHead head{static_cast<Kind>(bytes[0]), littleEndian<2>(bytes, 2), 0};
  std::memcpy(&head.hostTime_s, bytes.data() + 4, sizeof head.hostTime_s);
  if (!std::isfinite(head.hostTime_s) || !isLength(head.kind, head.length)) return {};
  return head;
}

bool isGood(Kind kind, std::span<const std::uint8_t> bytes) {
  switch (kind) {
  case Kind::Raw:
    return isReport(bytes);
  case Kind::Mark: // a text: binary would be reports behind a spoilt length
    return std::none_of(bytes.begin(), bytes.end(), [](std::uint8_t c) { return c < ' ' && c != '\t' && c != '\n'; });
  case Kind::Configuration:
    return std::holds_alternative<BoardConfiguration>(decodeConfiguration(bytes));
  case Kind::Connected:
    return std::holds_alternative<BoardInfo>(decodeInfo(bytes));
  case Kind::Tare:
    return bytes.empty() ||
           decodeTare(bytes, static_cast<int>(littleEndian<2>(bytes, 0)), static_cast<int>(littleEndian<2>(bytes, 2)));
  }
  return false;
}

bool isSurelyEntry(std::span<const std::uint8_t> bytes) {
  for (auto head = entryHead(bytes); head && bytes.size() >= kEntryHead + head->length; head = entryHead(bytes)) {
    if (!isGood(head->kind, bytes.subspan(kEntryHead, head->length))) return false;
    if (head->kind != Kind::Mark && head->length > 0) return true;
    bytes = bytes.subspan(kEntryHead + head->length);
  }
  return false;
}

} // namespace palp
