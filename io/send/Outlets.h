#pragma once

// Private to io: the kinds of outlets. Each throws Error with `where`, as the user wrote it.

#include "io/ForceOutlet.h"

#include <cstdint>

namespace palp {

/// A receiver in the network.
struct Receiver {
  std::string where; ///< as the user wrote it
  std::string host;  ///< name or number; IPv6 without its brackets
  std::string port;
};

std::unique_ptr<ForceOutlet> openUdp(const Receiver& receiver, bool toMany);
std::unique_ptr<ForceOutlet> openOsc(const Receiver& receiver, bool toMany);
std::unique_ptr<ForceOutlet> openZmq(const Receiver& receiver);
std::unique_ptr<ForceOutlet> openLsl(const std::string& where, const std::string& stream);
std::unique_ptr<ForceOutlet> openLines(const std::string& where, const std::string& file, bool force);

} // namespace palp
