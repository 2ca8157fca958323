#include "io/board/Recording.h"

#include "io/AtomicFile.h"
#include "io/StrictJson.h"
#include "io/board/ByteOrder.h"

#include <fcntl.h>
#include <unistd.h>

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

RecordingWriter::~RecordingWriter() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_one();
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

void RecordingReader::readHead() {
  std::array<std::uint8_t, kMagic.size() + 4> start{};
  stream_->read(reinterpret_cast<char*>(start.data()), start.size());
  if (!*stream_ || std::memcmp(start.data(), kMagic.data(), kMagic.size()) != 0)
    throw Error(name_ + ": is no recording of a board; it must begin with " + std::string(kMagic));
  const std::size_t length = littleEndian<4>(start, kMagic.size());
  if (length > kLongestHead)
    throw Error(name_ + ": the head is " + std::to_string(length) + " bytes long; allowed is up to " +
                std::to_string(kLongestHead));
  std::string text(length, '\0');
  stream_->read(text.data(), static_cast<std::streamsize>(length));
  if (!*stream_) throw Error(name_ + ": is cut off within its head");
  head_ = parseHead(text, name_);
}

std::optional<RecordingEntry> RecordingReader::next() {
  std::array<std::uint8_t, kEntryHead> start{};
  stream_->read(reinterpret_cast<char*>(start.data()), start.size());
  if (stream_->gcount() == 0) return {};
  const std::size_t length = littleEndian<2>(start, 2);
  RecordingEntry entry;
  std::memcpy(&entry.hostTime_s, start.data() + 4, sizeof entry.hostTime_s);
  const bool known = start[0] <= static_cast<std::uint8_t>(RecordingEntry::Kind::Tare) && start[1] == 0 &&
                     length <= kLongestEntry && std::isfinite(entry.hostTime_s);
  if (*stream_ && known) {
    entry.kind = static_cast<RecordingEntry::Kind>(start[0]);
    entry.bytes.resize(length);
    stream_->read(reinterpret_cast<char*>(entry.bytes.data()), static_cast<std::streamsize>(length));
    if (*stream_) return entry;
  }
  cutOff_ = true; // what follows a broken entry cannot be found again
  stream_->setstate(std::ios::eofbit | std::ios::failbit);
  return {};
}

} // namespace palp
