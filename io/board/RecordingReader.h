#pragma once

#include "io/board/Recording.h"

#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace palp {

/// Reads a recording entry by entry. Bytes outside of entries are left out, up to the next report whose checksum is
/// right.
class RecordingReader {
public:
  /// Throws Error where the file is not a recording.
  explicit RecordingReader(const std::filesystem::path& path);
  /// From any stream of bytes; `name` appears in error messages.
  RecordingReader(std::unique_ptr<std::istream> stream, std::string name);

  [[nodiscard]] const RecordingHead& head() const { return head_; }
  /// The next complete entry; none at the end.
  std::optional<RecordingEntry> next();
  /// The same into an entry whose memory is used again; false at the end.
  bool next(RecordingEntry& entry);
  /// After the end: bytes of an entry that was cut off.
  [[nodiscard]] bool cutOff() const { return cutOff_; }
  /// Bytes that were left out so far because they are outside of entries.
  [[nodiscard]] std::uint64_t spoiltBytes() const { return spoilt_; }

  /// Where the next entry begins [bytes], and on from such a place.
  [[nodiscard]] std::uint64_t place() const { return place_; }
  void goTo(std::uint64_t place);
  /// Bytes of the file as it is now.
  [[nodiscard]] std::uint64_t size();

private:
  /// The next bytes: at least `count` where the file has them. Valid until the next call.
  std::span<const std::uint8_t> ahead(std::size_t count);
  void pass(std::size_t bytes);
  void readHead();
  bool take(RecordingEntry& entry);
  bool findNext();
  void end();

  std::unique_ptr<std::istream> stream_;
  std::string name_;
  RecordingHead head_;
  std::vector<std::uint8_t> buffer_;   ///< read from the stream
  std::size_t begin_ = 0, filled_ = 0; ///< of the buffer: what comes next
  std::uint64_t place_ = 0;            ///< of that in the file
  std::uint64_t spoilt_ = 0;
  std::optional<double> reportTime_s_; ///< of the report that was read last
  bool cutOff_ = false;
};

} // namespace palp
