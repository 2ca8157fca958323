#pragma once

// Private to io.

#include "io/send/Outlets.h"

#include <cstddef>
#include <vector>

namespace palp {

/// Datagrams to one receiver, by whichever of its addresses takes them: a name such as localhost has several, of which
/// a program listens to one. A datagram goes immediately or is lost.
class DatagramSocket {
public:
  /// Throws Error where the receiver is not known or cannot be reached.
  DatagramSocket(const Receiver& receiver, bool toMany);
  ~DatagramSocket();
  DatagramSocket(const DatagramSocket&) = delete;
  DatagramSocket& operator=(const DatagramSocket&) = delete;

  /// Whether the system took it. A port of this computer that nobody has opened refuses it; of another computer nobody
  /// can know.
  bool send(const void* bytes, std::size_t count);

private:
  std::vector<int> sockets_; ///< one an address, connected
  std::size_t used_ = 0;     ///< that took the last datagram
};

} // namespace palp
