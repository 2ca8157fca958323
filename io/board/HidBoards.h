#pragma once

#include "io/board/ReportSource.h"

#include <memory>
#include <string>
#include <vector>

namespace palp {

/// A board that the system lists.
struct HidBoard {
  std::string path;   ///< /dev/hidrawN; changes from plug to plug
  std::string serial; ///< two boards may have the same: then they differ by their path
  std::string product;
  bool permission = true; ///< this user may open it
};

/// The boards that are plugged in. May be called from any thread.
std::vector<HidBoard> hidBoards(const UsbId& id = {});

/// Names of the HID devices that the system has, of whatever kind: asks no device anything.
std::vector<std::string> hidNodes();

/// Opens the board, reads its info and configuration and drops old reports. Throws BoardPermissionError with the
/// remedy, or BoardError (gone, another protocol, no answer).
std::unique_ptr<ReportSource> openHidBoard(const HidBoard& board);

/// Report descriptor of the board as the kernel has it; empty if the kernel does not say.
std::vector<std::uint8_t> reportDescriptorOf(const HidBoard& board);

/// The udev rule's place and how to install it, in one sentence.
std::string permissionRemedy();

} // namespace palp
