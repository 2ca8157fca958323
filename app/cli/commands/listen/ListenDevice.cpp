#include "app/cli/commands/listen/ListenDevice.h"

#include "app/cli/Cli.h"
#include "io/board/HidBoards.h"

#include <algorithm>
#include <filesystem>

namespace palp {

namespace {

std::uint16_t usbNumber(std::string part, const std::string& text) {
  if (part.starts_with("0x") || part.starts_with("0X")) part.erase(0, 2);
  if (part.empty() || part.size() > 4 || part.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos)
    throw badValue("--usb", text, "VENDOR:PRODUCT in hexadecimal, for example 1209:0001");
  return static_cast<std::uint16_t>(std::stoul(part, nullptr, 16));
}

/// Without it there is no HID device at all.
bool hasHidraw() {
  std::error_code ignored;
  return std::filesystem::exists("/sys/class/hidraw", ignored);
}

std::string noHidraw() {
  return "/sys/class/hidraw is missing: this system (a container, a kernel without hidraw) shows no HID device";
}

} // namespace

UsbId usbOption(const std::string& text) {
  const std::size_t colon = text.find(':');
  return {usbNumber(text.substr(0, colon), text),
          usbNumber(colon == std::string::npos ? "" : text.substr(colon + 1), text)};
}

void requireDevice(const std::string& device, const std::string& usb) {
  if (device.find('/') == std::string::npos) return; // a serial number: such a board may be plugged in later
  const std::string name = std::filesystem::path(device).filename().string();
  std::error_code ignored;
  if (!std::filesystem::exists(device, ignored))
    throw badValue("--device", device, "an existing device; palp listen --list shows the boards that are plugged in");
  if (name.starts_with("tty")) throw badValue("--device", device, "a USB HID device /dev/hidrawN, not a serial port");
  if (!name.starts_with("hidraw")) throw badValue("--device", device, "a HID device /dev/hidrawN, or a serial number");
  const std::vector<HidBoard> boards = hidBoards(usbOption(usb));
  if (std::none_of(boards.begin(), boards.end(), [&](const HidBoard& board) { return board.path == device; }))
    throw UsageError("--device: " + device + " is not a board with USB ID " + usb +
                     "; give another ID by --usb (lsusb shows it)");
}

std::string noBoardInWords(const std::string& device, const std::string& usb) {
  if (!hasHidraw()) return noHidraw();
  const std::vector<HidBoard> boards = hidBoards(usbOption(usb));
  std::string words =
      "no board with USB ID " + usb + (device.empty() ? "" : " and serial number " + device) + " is plugged in";
  for (const HidBoard& board : boards) words += (&board == &boards.front() ? "; there is " : ", ") + board.serial;
  return words + "; check lsusb, give another ID by --usb, or install the udev rule (palp listen --list)";
}

} // namespace palp
