#include "tests/board/MockUsb.h"

#include "io/board/ReportSource.h"

#include <fcntl.h>
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace palp {

namespace {

constexpr int kPipePackets = 64; // the kernel's queue of a hidraw device holds 63

void require(bool works, const std::string& what, GError* error = nullptr) {
  if (works) return;
  throw std::runtime_error(what + (error ? std::string(": ") + error->message : ""));
}

std::string hexadecimal(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02X", byte);
    text += digits;
  }
  return text;
}

} // namespace

MockUsb::MockUsb() : testbed_(umockdev_testbed_new()) {
  require(umockdev_in_mock_environment(), "this test runs under umockdev-wrapper"); // it caches: only after the testbed
}

MockUsb::~MockUsb() {
  g_object_unref(testbed_);
}

std::string MockUsb::root() const {
  char* const folder = umockdev_testbed_get_root_dir(testbed_);
  std::string text = folder;
  g_free(folder);
  return text;
}

MockBoard::MockBoard(MockUsb& usb, VirtualBoard board, int port, int node)
    : usb_(usb), board_(std::move(board)), port_(port), node_(node) {
  GError* error = nullptr;
  require(umockdev_testbed_add_from_string(usb_.testbed(), description().c_str(), &error), "add", error);
  makePipe();
  io_ = umockdev_ioctl_base_new();
  g_signal_connect(io_, "handle-ioctl", G_CALLBACK(onIoctl), this);
  g_signal_connect(io_, "handle-read", G_CALLBACK(onRead), this);
  g_signal_connect(io_, "handle-write", G_CALLBACK(onWrite), this);
  require(umockdev_testbed_attach_ioctl(usb_.testbed(), path().c_str(), io_, &error), "attach", error);
}

MockBoard::~MockBoard() {
  stopStreaming();
  umockdev_testbed_detach_ioctl(usb_.testbed(), path().c_str(), nullptr);
  g_object_unref(io_);
  ::close(pipe_);
}

std::string MockBoard::usbPath() const {
  return "/devices/pci0000:00/0000:00:14.0/usb1/1-" + std::to_string(port_);
}

std::string MockBoard::file() const {
  return usb_.root() + path();
}

/// What umockdev needs to know of the USB device, its interface, the HID device and the hidraw node.
std::string MockBoard::description() const {
  const std::string hid = "0003:1209:0001.000" + std::to_string(port_);
  const std::string interface = usbPath() + "/1-" + std::to_string(port_) + ":1.0";
  const std::string node = std::to_string(node_);
  const std::string serial = board_.info().serial;
  std::string text = "P: " + usbPath() +
                     "\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nE: DRIVER=usb\nE: PRODUCT=1209/1/103\nE: BUSNUM=001\n"
                     "E: DEVNUM=00" +
                     std::to_string(port_) + "\nE: DEVNAME=/dev/bus/usb/001/00" + std::to_string(port_) +
                     "\nE: MAJOR=189\nE: MINOR=" + std::to_string(port_) +
                     "\nA: idVendor=1209\\n\nA: idProduct=0001\\n\nA: bcdDevice=0103\\n\nA: manufacturer=Palp\\n\n"
                     "A: product=Tactile board\\n\nA: serial=" +
                     serial + "\\n\nA: busnum=1\\n\nA: devnum=" + std::to_string(port_) + "\\n\nA: speed=12\\n\n\n";
  text += "P: " + interface +
          "\nE: DEVTYPE=usb_interface\nE: SUBSYSTEM=usb\nE: DRIVER=usbhid\nA: bInterfaceNumber=00\\n\n"
          "A: bInterfaceClass=03\\n\n\n";
  text += "P: " + interface + "/" + hid +
          "\nE: SUBSYSTEM=hid\nE: DRIVER=hid-generic\nE: HID_ID=0003:00001209:00000001\nE: HID_NAME=Tactile board\n"
          "E: HID_PHYS=usb-0000:00:14.0-" +
          std::to_string(port_) + "/input0\nE: HID_UNIQ=" + serial +
          "\nH: report_descriptor=" + hexadecimal(reportDescriptor()) + "\n\n";
  text += "P: " + interface + "/" + hid + "/hidraw/hidraw" + node + "\nN: hidraw" + node +
          "=00\nE: DEVNAME=/dev/hidraw" + node + "\nE: SUBSYSTEM=hidraw\nE: MAJOR=246\nE: MINOR=" + node +
          "\nL: device=../../../" + hid + "\nA: dev=246:" + node + "\\n\n\n";
  return text;
}

/// umockdev's own pty would merge reports; a pipe in packet mode keeps them apart.
void MockBoard::makePipe() {
  ::unlink(file().c_str());
  require(::mkfifo(file().c_str(), 0600) == 0, "mkfifo " + file());
  pipe_ = ::open(file().c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
  require(pipe_ >= 0 && ::fcntl(pipe_, F_SETFL, O_NONBLOCK | O_DIRECT) == 0 &&
              ::fcntl(pipe_, F_SETPIPE_SZ, kPipePackets * 4096) >= 0,
          "pipe of " + file());
}

void MockBoard::startStreaming() {
  streaming_ = true;
  pump_ = std::thread([this] { pump(); });
}

void MockBoard::stopStreaming() {
  streaming_ = false;
  if (pump_.joinable()) pump_.join();
}

void MockBoard::pump() {
  while (streaming_) {
    {
      const std::lock_guard lock(mutex_);
      board_.advance(static_cast<std::uint64_t>(1e6 * hostClock_s()), [this](std::span<const std::uint8_t> report) {
        while (streaming_ && ::write(pipe_, report.data(), report.size()) < 0)
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
      });
    }
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }
}

void MockBoard::unplug() {
  stopStreaming();
  gone_ = true;
  require(::write(pipe_, "x", 1) == 1, "wake the reader");
  const std::string hid = usbPath() + "/1-" + std::to_string(port_) + ":1.0/0003:1209:0001.000" + std::to_string(port_);
  const std::string node = hid + "/hidraw/hidraw" + std::to_string(node_);
  umockdev_testbed_uevent(usb_.testbed(), ("/sys" + node).c_str(), "remove");
  std::this_thread::sleep_for(std::chrono::milliseconds(100)); // the event must find its device
  for (const std::string& device : {node, hid, usbPath() + "/1-" + std::to_string(port_) + ":1.0", usbPath()})
    umockdev_testbed_remove_device(usb_.testbed(), ("/sys" + device).c_str());
}

gboolean MockBoard::onIoctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  return static_cast<MockBoard*>(self)->answerIoctl(client);
}

gboolean MockBoard::answerIoctl(UMockdevIoctlClient* client) {
  const unsigned request = static_cast<unsigned>(umockdev_ioctl_client_get_request(client));
  const unsigned size = _IOC_SIZE(request);
  if (_IOC_TYPE(request) != 'H') return FALSE;
  UMockdevIoctlData* const data = umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, size, nullptr);
  const auto answer = [&](long result, int error = 0) {
    umockdev_ioctl_client_complete(client, result, error);
    if (data) umockdev_ioctl_data_unref(data);
    return TRUE;
  };
  if (!data) return answer(-1, EFAULT);
  const std::lock_guard lock(mutex_);
  auto descriptor = std::vector<std::uint8_t>(reportDescriptor().begin(), reportDescriptor().end());
  if (request == static_cast<unsigned>(HIDIOCGRDESCSIZE)) {
    int count = static_cast<int>(descriptor.size());
    umockdev_ioctl_data_update(data, 0, reinterpret_cast<guint8*>(&count), sizeof count);
    return answer(0);
  }
  if (request == static_cast<unsigned>(HIDIOCGRDESC)) {
    umockdev_ioctl_data_update(data, 4, descriptor.data(), static_cast<gsize>(descriptor.size()));
    return answer(0);
  }
  if (_IOC_NR(request) == 0x06) // HIDIOCSFEATURE
    return board_.setFeature({data->data, size}) ? answer(size) : answer(-1, EIO);
  if (_IOC_NR(request) == 0x07) { // HIDIOCGFEATURE
    std::optional<Report> report = board_.feature(data->data[0]);
    if (!report) return answer(-1, EIO);
    umockdev_ioctl_data_update(data, 0, report->data(), std::min<gsize>(report->size(), size));
    return answer(static_cast<long>(report->size()));
  }
  return answer(-1, ENOTTY);
}

gboolean MockBoard::onRead(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  if (!static_cast<MockBoard*>(self)->gone_) return FALSE;
  umockdev_ioctl_client_complete(client, -1, EIO);
  return TRUE;
}

gboolean MockBoard::onWrite(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  auto& board = *static_cast<MockBoard*>(self);
  const UMockdevIoctlData* const data = umockdev_ioctl_client_get_arg(client);
  const std::lock_guard lock(board.mutex_);
  const bool taken = !board.gone_ && board.board_.output({data->data, static_cast<std::size_t>(data->data_len)});
  if (taken) ++board.commands_;
  umockdev_ioctl_client_complete(client, taken ? static_cast<long>(data->data_len) : -1, taken ? 0 : EIO);
  return TRUE;
}

} // namespace palp
