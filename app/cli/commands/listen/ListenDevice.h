#pragma once

#include "io/board/Protocol.h"

#include <string>

namespace palp {

/// --usb VENDOR:PRODUCT in hexadecimal, each with or without 0x. Throws UsageError.
UsbId usbOption(const std::string& text);

/// Throws UsageError where --device names a missing file, a serial port or another HID device.
void requireDevice(const std::string& device, const std::string& usb);

/// Why no board is found, and what shows more.
std::string noBoardInWords(const std::string& device, const std::string& usb);

} // namespace palp
