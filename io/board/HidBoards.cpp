#include "io/board/HidBoards.h"

#include <hidapi/hidapi.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <tuple>

namespace palp {

namespace {

constexpr int kLongestHidReport = 256; // a board may send more than it should
constexpr int kMostQueued = 128;       // the kernel holds 63; a fast board adds some while they are dropped

/// hidapi keeps the error of opening in one place for all threads.
std::mutex& openingMutex() {
  static std::mutex mutex;
  return mutex;
}

std::string narrow(const wchar_t* text) {
  std::string result;
  for (; text && *text; ++text) result.push_back(*text >= 0x20 && *text < 0x7F ? static_cast<char>(*text) : '?');
  return result;
}

/// Whether this user may open the device; any other refusal shows when it is opened.
bool mayOpen(const char* path) {
  const int file = ::open(path, O_RDWR | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return errno != EACCES && errno != EPERM;
  ::close(file);
  return true;
}

struct CloseDevice {
  void operator()(hid_device* device) const { hid_close(device); }
};

/// A board on USB, through hidapi's hidraw backend.
class HidSource final : public ReportSource {
public:
  HidSource(HidBoard board, hid_device* device) : board_(std::move(board)), device_(device) {
    const auto info = decodeInfo(readFeature(ReportId::Info));
    if (const auto* fault = std::get_if<ReportFault>(&info)) refuse("info (feature 0x10)", *fault);
    info_ = std::get<BoardInfo>(info);
    readConfiguration();
    dropQueued();
  }

  [[nodiscard]] std::string name() const override { return board_.serial + " at " + board_.path; }
  [[nodiscard]] const BoardInfo& info() const override { return info_; }
  [[nodiscard]] const BoardConfiguration& configuration() const override { return configuration_; }
  [[nodiscard]] std::string reason() const override { return reason_; }

  void readConfiguration() override {
    const auto configuration = decodeConfiguration(readFeature(ReportId::Configuration));
    if (const auto* fault = std::get_if<ReportFault>(&configuration)) refuse("configuration (feature 0x11)", *fault);
    configuration_ = std::get<BoardConfiguration>(configuration);
  }

  Outcome read(RawReport& report, std::chrono::milliseconds timeout) override {
    report.bytes.resize(kLongestHidReport);
    const int count =
        hid_read_timeout(device_.get(), report.bytes.data(), report.bytes.size(), static_cast<int>(timeout.count()));
    report.hostTime_s = hostClock_s();
    report.bytes.resize(static_cast<std::size_t>(std::max(count, 0)));
    if (count > 0) return Outcome::Read;
    if (count == 0) return Outcome::Nothing;
    reason_ = "the board at " + board_.path + " was unplugged";
    return Outcome::Gone;
  }

  bool configure(const BoardConfiguration& configuration) override {
    const Report report = encode(configuration);
    if (hid_send_feature_report(device_.get(), report.data(), report.size()) < 0) return false;
    readConfiguration();
    return true;
  }

  bool send(const BoardCommand& command) override {
    const Report report = encode(command);
    return hid_write(device_.get(), report.data(), report.size()) == static_cast<int>(report.size());
  }

private:
  std::vector<std::uint8_t> readFeature(ReportId id) {
    std::vector<std::uint8_t> bytes(kReportBytes);
    bytes[0] = static_cast<std::uint8_t>(id);
    const int count = hid_get_feature_report(device_.get(), bytes.data(), bytes.size());
    if (count < 0) throw BoardError(name() + ": does not respond: " + narrow(hid_error(device_.get())));
    bytes.resize(static_cast<std::size_t>(count));
    return bytes;
  }

  [[noreturn]] void refuse(const std::string& what, ReportFault fault) const {
    throw BoardError(name() + ": its " + what + " cannot be understood: " + sentence(fault));
  }

  void dropQueued() {
    std::array<std::uint8_t, kLongestHidReport> bytes{};
    for (int i = 0; i < kMostQueued; ++i)
      if (hid_read_timeout(device_.get(), bytes.data(), bytes.size(), 0) <= 0) return;
  }

  HidBoard board_;
  std::unique_ptr<hid_device, CloseDevice> device_;
  BoardInfo info_;
  BoardConfiguration configuration_;
  std::string reason_;
};

} // namespace

std::vector<HidBoard> hidBoards(const UsbId& id) {
  const std::lock_guard lock(openingMutex());
  std::vector<HidBoard> boards;
  hid_device_info* const all = hid_enumerate(id.vendor, id.product);
  for (const hid_device_info* device = all; device; device = device->next)
    boards.push_back(
        {device->path, narrow(device->serial_number), narrow(device->product_string), mayOpen(device->path)});
  hid_free_enumeration(all);
  std::sort(boards.begin(), boards.end(), [](const HidBoard& a, const HidBoard& b) {
    return std::tie(a.serial, a.path) < std::tie(b.serial, b.path);
  });
  return boards;
}

std::vector<std::string> hidNodes() {
  std::vector<std::string> names;
  std::error_code none; // a system without any has no such folder
  for (std::filesystem::directory_iterator node("/sys/class/hidraw", none), end; node != end; node.increment(none))
    names.push_back(node->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::unique_ptr<ReportSource> openHidBoard(const HidBoard& board) {
  hid_device* device = nullptr;
  {
    const std::lock_guard lock(openingMutex());
    if (!mayOpen(board.path.c_str()))
      throw BoardPermissionError(board.serial + " at " + board.path + ": no permission to open it; " +
                                 permissionRemedy());
    device = hid_open_path(board.path.c_str());
    if (!device)
      throw BoardError(board.serial + " at " + board.path + ": cannot be opened: " + narrow(hid_error(nullptr)));
  }
  return std::make_unique<HidSource>(board, device);
}

std::vector<std::uint8_t> reportDescriptorOf(const HidBoard& board) {
  const std::string node = board.path.substr(board.path.rfind('/') + 1);
  std::ifstream file("/sys/class/hidraw/" + node + "/device/report_descriptor", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string permissionRemedy() {
  return "install the udev rule with: sudo cp 70-palp-board.rules /etc/udev/rules.d/ && sudo udevadm control --reload "
         "&& sudo udevadm trigger (the rule is in share/palp/board of an installation, resources/board of the sources)";
}

} // namespace palp
