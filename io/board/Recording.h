#pragma once

#include "io/board/ReportSource.h"

#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace palp {

/// Head of a recording.
struct RecordingHead {
  BoardInfo info;
  BoardConfiguration configuration;
  std::string source;             ///< which board, in words
  std::string networkFingerprint; ///< empty: no network in use
  std::int64_t startedUnix_s = 0;
};

/// One entry of a recording.
struct RecordingEntry {
  enum class Kind : std::uint8_t {
    Raw = 0,           ///< report, as it came
    Mark = 1,          ///< text of the user
    Configuration = 2, ///< feature 0x11, when it changed
    Connected = 3,     ///< feature 0x10 of the board after an interruption
    Tare = 4,          ///< what counts as rest from here on (Tare.h); no bytes: no tare any more
  };
  Kind kind = Kind::Raw;
  double hostTime_s = 0;
  std::vector<std::uint8_t> bytes;
};

// The file: "PALPREC1", u32 length and bytes of the head (JSON), then entries: u8 kind, u8 0, u16 length, f64 host time
// [s], bytes. Little-endian. It may end anywhere; what is whole counts.

/// Writes a recording in a thread of its own, so that no disk holds up the reader; hands over to the system at least
/// each second. The head is written as AtomicFile does, so that a recording that is replaced survives a full disk; the
/// entries grow in the file's place, so that a crash loses a second at most. On a full disk it ends with a whole
/// entry.
class RecordingWriter {
public:
  /// Throws Error where the file exists and `force` is not given, or cannot be written.
  RecordingWriter(const std::filesystem::path& path, const RecordingHead& head, bool force);
  ~RecordingWriter() { finish(); }
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  void append(RecordingEntry::Kind kind, double hostTime_s, std::span<const std::uint8_t> bytes);
  /// Writes what is left, and ends: reports(), dropped() and failure() are then the last word.
  void finish();

  /// Reports that the system has taken; those of the last half second may still wait.
  [[nodiscard]] std::uint64_t reports() const;
  /// Entries that may be missing in the file: the disk did not keep up, or is full.
  [[nodiscard]] std::uint64_t dropped() const;
  /// Why nothing is written any more (the disk is full); empty while all is well.
  [[nodiscard]] std::string failure() const;

private:
  void run();
  /// Writes whole entries; why not all of them, and how many reports there were among those that were written. What was
  /// written of an entry that was cut off is taken back.
  std::string write(const std::string& block, std::uint64_t& entries, std::uint64_t& reports);

  std::filesystem::path path_;
  int file_ = -1;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::string pending_;
  std::uint64_t pendingEntries_ = 0;
  std::string failure_;
  std::uint64_t reports_ = 0;
  std::uint64_t dropped_ = 0;
  bool ending_ = false;
  std::thread thread_;
};

/// Reads a recording entry by entry. Bytes that are no entry are left out, up to the next report whose checksum is
/// right.
class RecordingReader {
public:
  /// Throws Error where the file is no recording.
  explicit RecordingReader(const std::filesystem::path& path);
  /// From any stream of bytes; `name` stands in the refusals.
  RecordingReader(std::unique_ptr<std::istream> stream, std::string name);

  [[nodiscard]] const RecordingHead& head() const { return head_; }
  /// The next whole entry; none at the end.
  std::optional<RecordingEntry> next();
  /// The same into an entry whose memory is used again; false at the end.
  bool next(RecordingEntry& entry);
  /// After the end: bytes of an entry that was cut off.
  [[nodiscard]] bool cutOff() const { return cutOff_; }
  /// Bytes that were left out so far because they are no entry.
  [[nodiscard]] std::uint64_t spoiltBytes() const { return spoilt_; }

  /// Where the next entry begins [bytes], and on from such a place.
  [[nodiscard]] std::uint64_t place() const { return place_; }
  void goTo(std::uint64_t place);
  /// Bytes of the file as it is now.
  [[nodiscard]] std::uint64_t size();

private:
  /// The next bytes: at least so many where the file has them. Valid until the next call.
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
