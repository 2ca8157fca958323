#pragma once

#include "io/board/Recording.h"

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <thread>

namespace palp {

/// Writes a recording in a thread of its own, so that no disk holds up the reader; hands over to the system at least
/// each second. The head is written as AtomicFile does, so that a recording that is replaced survives a full disk; the
/// entries grow in the file's place, so that a crash loses a second at most. On a full disk it ends with a complete
/// entry.
class RecordingWriter {
public:
  /// Writes as many bytes as the system takes; where not all, errno has the reason. Tests put their own in its place.
  using WriteBytes = std::function<std::size_t(int file, std::string_view bytes)>;
  static std::size_t writtenOf(int file, std::string_view bytes);

  /// Throws Error where the file exists and `force` is not given, or cannot be written.
  RecordingWriter(const std::filesystem::path& path, const RecordingHead& head, bool force,
                  WriteBytes writeBytes = writtenOf);
  ~RecordingWriter() { finish(); }
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  void append(RecordingEntry::Kind kind, double hostTime_s, std::span<const std::uint8_t> bytes);
  /// Writes the remainder, and ends: reports(), dropped() and failure() are final then.
  void finish();

  /// Reports that the system has taken; those of the last half second may still wait.
  [[nodiscard]] std::uint64_t reports() const;
  /// Entries that may be missing in the file: the disk did not keep up, or is full.
  [[nodiscard]] std::uint64_t dropped() const;
  /// Why nothing is written any more (the disk is full); empty while all is well.
  [[nodiscard]] std::string failure() const;

private:
  void run();
  /// What waits, at least each half second; false: it was the last of it.
  bool writeWaiting(std::string& block);
  /// Nothing more is written; the block at hand is dropped.
  void fail(const std::string& why);
  [[nodiscard]] std::string inWords(const std::string& why) const;
  /// Writes complete entries; why not all of them, and how many reports there were among those that were written. What
  /// was written of an entry that was cut off is taken back.
  std::string write(const std::string& block, std::uint64_t& entries, std::uint64_t& reports);

  std::filesystem::path path_;
  WriteBytes writeBytes_;
  int file_ = -1;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::string pending_;
  std::uint64_t pendingEntries_ = 0;
  std::uint64_t writing_ = 0; ///< entries of the block that is being written
  std::string failure_;
  std::uint64_t reports_ = 0;
  std::uint64_t dropped_ = 0;
  bool ending_ = false;
  std::thread thread_;
};

} // namespace palp
