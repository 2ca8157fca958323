#include "io/board/Recording.h"

#include "io/AtomicFile.h"
#include "io/StrictJson.h"
#include "io/board/ByteOrder.h"
#include "io/board/Tare.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

namespace palp {

namespace {

constexpr std::string_view kMagic = "PALPREC1";
constexpr int kRecordingVersion = 2; // 1 had no tares
constexpr std::size_t kLongestHead = 1 << 16;
constexpr std::size_t kEntryHead = 12;
constexpr std::size_t kTareHead = 16;
constexpr double kLongestStep_s = 60;       // from a report to one behind which there is no other
constexpr std::size_t kLongestReport = 256; // a board may send more than it should
constexpr std::size_t kSeenAhead = 1 << 17; // holds the longest entry and the next one
constexpr std::size_t kBuffer = 2 * kSeenAhead;
constexpr std::size_t kLongestEntry = 65535;   // a tare of the largest board the protocol knows takes 65,296
constexpr std::size_t kMostPending = 64 << 20; // a minute and more at 8000 reports/s
constexpr auto kFlushInterval = std::chrono::milliseconds(500);
static_assert(std::endian::native == std::endian::little, "host times are copied byte by byte");

std::string hexadecimal(const Report& report) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : report) {
    text.push_back(digits[byte >> 4]);
    text.push_back(digits[byte & 0xF]);
  }
  return text;
}

Report reportOf(const JsonPlace& place) {
  const std::string text = place.string();
  const bool hex = text.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (text.size() != 2 * kReportBytes || !hex) place.refuse("64 bytes in lower-case hexadecimal");
  Report report{};
  for (std::size_t i = 0; i < kReportBytes; ++i)
    report[i] = static_cast<std::uint8_t>(std::stoi(text.substr(2 * i, 2), nullptr, 16));
  return report;
}

/// Writes as many bytes as the system takes; where not all, errno says why.
std::size_t writtenOf(int file, std::string_view bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t written = ::write(file, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    done += static_cast<std::size_t>(written);
  }
  return done;
}

using Kind = RecordingEntry::Kind;

struct EntryHead {
  Kind kind = Kind::Raw;
  std::size_t length = 0;
  double hostTime_s = 0;
};

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

/// What could be the head of an entry: a spoilt byte in it mostly shows.
std::optional<EntryHead> entryHead(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kEntryHead || bytes[0] > static_cast<std::uint8_t>(Kind::Tare) || bytes[1] != 0) return {};
  EntryHead head{static_cast<Kind>(bytes[0]), littleEndian<2>(bytes, 2), 0};
  std::memcpy(&head.hostTime_s, bytes.data() + 4, sizeof head.hostTime_s);
  if (!std::isfinite(head.hostTime_s) || !isLength(head.kind, head.length)) return {};
  return head;
}

/// By its ID and its checksum.
bool isReport(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != kReportBytes) return false;
  const auto id = static_cast<ReportId>(bytes[0]);
  return (id == ReportId::Readings || id == ReportId::Event) &&
         littleEndian<2>(bytes, kReportBytes - 2) == crc16(bytes.first(kReportBytes - 2));
}

/// The bytes of an entry between the reports are what its kind says.
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

/// By its own checksum or structure; a text only where such an entry follows it.
bool isSurelyEntry(std::span<const std::uint8_t> bytes) {
  for (auto head = entryHead(bytes); head && bytes.size() >= kEntryHead + head->length; head = entryHead(bytes)) {
    if (!isGood(head->kind, bytes.subspan(kEntryHead, head->length))) return false;
    if (head->kind != Kind::Mark && head->length > 0) return true;
    bytes = bytes.subspan(kEntryHead + head->length);
  }
  return false;
}

/// A time that lies before or behind both of its neighbours is spoilt: reports are recorded in their order. A gap in
/// the recording lies between two reports that others follow.
double betweenNeighbours(double before_s, double time_s, const std::optional<double>& after_s) {
  const double latest_s = after_s.value_or(before_s + kLongestStep_s);
  const bool outside = before_s <= latest_s && (time_s < before_s || time_s > latest_s);
  return outside ? before_s : time_s;
}

std::string headText(const RecordingHead& head) {
  const Json json{{"palp_recording", kRecordingVersion},    {"source", head.source},
                  {"info", hexadecimal(encode(head.info))}, {"configuration", hexadecimal(encode(head.configuration))},
                  {"network", head.networkFingerprint},     {"started_unix_s", head.startedUnix_s}};
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

RecordingHead parseHead(std::string_view text, const std::string& file) {
  const Json json = parseJson(text, file);
  const JsonPlace root(json, file);
  root.onlyKeys({"palp_recording", "source", "info", "configuration", "network", "started_unix_s"});
  formatVersion(root, "palp_recording", kRecordingVersion);
  RecordingHead head;
  const auto info = decodeInfo(reportOf(root.at("info")));
  const auto configuration = decodeConfiguration(reportOf(root.at("configuration")));
  if (!std::holds_alternative<BoardInfo>(info)) root.at("info").refuse("the feature report 0x10 of a board");
  if (!std::holds_alternative<BoardConfiguration>(configuration))
    root.at("configuration").refuse("the feature report 0x11 of a board");
  head.info = std::get<BoardInfo>(info);
  head.configuration = std::get<BoardConfiguration>(configuration);
  head.source = root.at("source").string();
  head.networkFingerprint = root.at("network").string();
  const double started = root.at("started_unix_s").number();
  if (!(std::abs(started) < 1e15)) root.at("started_unix_s").refuse("a time in seconds since 1970");
  head.startedUnix_s = static_cast<std::int64_t>(started);
  return head;
}

} // namespace

RecordingWriter::RecordingWriter(const std::filesystem::path& path, const RecordingHead& head, bool force)
    : path_(path) {
  AtomicFile target(path, force);
  const std::string text = headText(head);
  std::array<std::uint8_t, 4> length{};
  putLittleEndian<4>(length, 0, static_cast<std::uint32_t>(text.size()));
  const std::string bytes = std::string(kMagic) + std::string(length.begin(), length.end()) + text;
  file_ = ::open(target.beside().c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  if (file_ < 0) throw Error(path.string() + ": cannot be written: " + std::strerror(errno));
  try {
    if (writtenOf(file_, bytes) < bytes.size())
      throw Error(path.string() + ": cannot be written: " + std::strerror(errno));
    target.commit(); // what follows goes into the same file, by its new name
  } catch (...) {    // the destructor does not run for what was never constructed
    ::close(file_);
    throw;
  }
  thread_ = std::thread([this] { run(); });
}

void RecordingWriter::finish() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_one();
  if (!thread_.joinable()) return;
  thread_.join();
  ::close(file_);
}

void RecordingWriter::append(RecordingEntry::Kind kind, double hostTime_s, std::span<const std::uint8_t> bytes) {
  const auto count = static_cast<std::uint32_t>(std::min(bytes.size(), kLongestEntry));
  std::array<std::uint8_t, kEntryHead> head{static_cast<std::uint8_t>(kind), 0};
  putLittleEndian<2>(head, 2, count);
  std::memcpy(head.data() + 4, &hostTime_s, sizeof hostTime_s);
  const std::lock_guard lock(mutex_);
  if (!failure_.empty() || pending_.size() > kMostPending) {
    ++dropped_;
    return;
  }
  pending_.append(reinterpret_cast<const char*>(head.data()), head.size());
  pending_.append(reinterpret_cast<const char*>(bytes.data()), count);
  ++pendingEntries_;
}

std::string RecordingWriter::write(const std::string& block, std::uint64_t& entries, std::uint64_t& reports) {
  const std::size_t written = writtenOf(file_, block);
  const int reason = errno;
  std::size_t whole = 0;
  for (entries = reports = 0; whole < block.size(); ++entries) {
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(block.data()), block.size());
    const std::size_t next = whole + kEntryHead + littleEndian<2>(bytes, whole + 2);
    if (next > written) break;
    if (bytes[whole] == static_cast<std::uint8_t>(RecordingEntry::Kind::Raw)) ++reports;
    whole = next;
  }
  if (written == block.size()) return {};
  const off_t end = ::lseek(file_, 0, SEEK_CUR); // none in a pipe
  if (end >= 0) {
    [[maybe_unused]] const int cut = ::ftruncate(file_, end - static_cast<off_t>(written - whole));
  }
  return path_.string() + ": cannot be written any more: " + std::strerror(reason);
}

void RecordingWriter::run() {
  std::string block;
  for (bool ending = false; !ending;) {
    std::uint64_t taken = 0, entries = 0, reports = 0; // of the block
    {
      std::unique_lock lock(mutex_);
      wake_.wait_for(lock, kFlushInterval, [this] { return ending_; });
      ending = ending_;
      block.swap(pending_);
      pending_.clear();
      taken = std::exchange(pendingEntries_, 0);
      if (!failure_.empty()) { // appended while the last block failed
        dropped_ += taken;
        continue;
      }
    }
    const std::string failure = write(block, entries, reports);
    const std::lock_guard lock(mutex_);
    reports_ += reports;
    dropped_ += taken - entries;
    if (failure_.empty()) failure_ = failure;
  }
}

std::uint64_t RecordingWriter::reports() const {
  const std::lock_guard lock(mutex_);
  return reports_;
}

std::uint64_t RecordingWriter::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

std::string RecordingWriter::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

RecordingReader::RecordingReader(const std::filesystem::path& path)
    : stream_(std::make_unique<std::ifstream>(path, std::ios::binary)), name_(path.string()) {
  std::error_code ignored;
  if (!*stream_ || std::filesystem::is_directory(path, ignored))
    throw Error(name_ +
                ": cannot be read: " + std::strerror(std::filesystem::is_directory(path, ignored) ? EISDIR : errno));
  readHead();
}

RecordingReader::RecordingReader(std::unique_ptr<std::istream> stream, std::string name)
    : stream_(std::move(stream)), name_(std::move(name)) {
  readHead();
}

std::span<const std::uint8_t> RecordingReader::ahead(std::size_t count) {
  if (filled_ - begin_ < count && *stream_) {
    buffer_.resize(kBuffer);
    std::memmove(buffer_.data(), buffer_.data() + begin_, filled_ - begin_);
    filled_ -= std::exchange(begin_, 0);
    stream_->read(reinterpret_cast<char*>(buffer_.data() + filled_),
                  static_cast<std::streamsize>(buffer_.size() - filled_));
    filled_ += static_cast<std::size_t>(stream_->gcount());
  }
  return std::span(buffer_).subspan(begin_, filled_ - begin_);
}

void RecordingReader::pass(std::size_t bytes) {
  begin_ += bytes;
  place_ += bytes;
}

void RecordingReader::goTo(std::uint64_t place) {
  stream_->clear();
  stream_->seekg(static_cast<std::streamoff>(place));
  begin_ = filled_ = 0;
  place_ = place;
  reportTime_s_.reset();
  cutOff_ = false;
}

std::uint64_t RecordingReader::size() {
  stream_->clear();
  const std::streamoff end = stream_->seekg(0, std::ios::end).tellg();
  goTo(place_);
  return static_cast<std::uint64_t>(std::max<std::streamoff>(end, 0));
}

void RecordingReader::readHead() {
  constexpr std::size_t kStart = kMagic.size() + 4;
  std::span<const std::uint8_t> start = ahead(kStart);
  if (start.size() < kStart || std::memcmp(start.data(), kMagic.data(), kMagic.size()) != 0)
    throw Error(name_ + ": is no recording of a board; it must begin with " + std::string(kMagic));
  const std::size_t length = littleEndian<4>(start, kMagic.size());
  if (length > kLongestHead)
    throw Error(name_ + ": the head is " + std::to_string(length) + " bytes long; allowed is up to " +
                std::to_string(kLongestHead));
  start = ahead(kStart + length);
  if (start.size() < kStart + length) throw Error(name_ + ": is cut off within its head");
  head_ = parseHead({reinterpret_cast<const char*>(start.data()) + kStart, length}, name_);
  pass(kStart + length);
}

std::optional<RecordingEntry> RecordingReader::next() {
  RecordingEntry entry;
  return next(entry) ? std::optional(std::move(entry)) : std::nullopt;
}

bool RecordingReader::next(RecordingEntry& entry) {
  if (take(entry)) return true;
  if (!findNext()) {
    end();
    return false;
  }
  return take(entry);
}

/// The entry here, where it is one: by its own checksum, or because another one or the end follows it.
bool RecordingReader::take(RecordingEntry& entry) {
  const auto head = entryHead(ahead(kEntryHead));
  if (!head) return false;
  const std::size_t whole = kEntryHead + head->length;
  const std::span<const std::uint8_t> bytes = ahead(whole + kEntryHead);
  if (bytes.size() < whole) return false;
  const std::span<const std::uint8_t> body = bytes.subspan(kEntryHead, head->length), rest = bytes.subspan(whole);
  const auto following = entryHead(rest);
  const bool entryFollows = following || rest.size() < kEntryHead;
  if (!(head->kind == Kind::Raw && entryFollows) && !isGood(head->kind, body)) return false;
  entry.kind = head->kind;
  entry.hostTime_s = head->hostTime_s;
  entry.bytes.assign(body.begin(), body.end());
  if (head->kind == Kind::Raw) {
    std::optional<double> after_s;
    if (following && following->kind == Kind::Raw) after_s = following->hostTime_s;
    if (reportTime_s_) entry.hostTime_s = betweenNeighbours(*reportTime_s_, head->hostTime_s, after_s);
    reportTime_s_ = entry.hostTime_s;
  }
  pass(whole);
  return true;
}

/// On to the next entry that is one beyond doubt; false where there is none: then the place is where it was.
bool RecordingReader::findNext() {
  const std::uint64_t from = place_;
  if (!ahead(1).empty()) pass(1);
  for (auto bytes = ahead(kSeenAhead); bytes.size() >= kEntryHead; pass(1), bytes = ahead(kSeenAhead)) {
    if (!isSurelyEntry(bytes)) continue;
    spoilt_ += place_ - from;
    return true;
  }
  goTo(from);
  return false;
}

/// What is left is the begin of an entry, or nothing that is known.
void RecordingReader::end() {
  const std::span<const std::uint8_t> rest = ahead(kEntryHead);
  if (rest.empty()) return;
  const auto head = entryHead(rest);
  const std::uint64_t all = size(), left = all - place_;
  const bool begun = left < kEntryHead || (head && left < kEntryHead + head->length);
  if (!begun) spoilt_ += all - place_;
  goTo(all);
  cutOff_ = begun;
}

} // namespace palp
