#include "io/send/DatagramSocket.h"

#include "io/files/SystemError.h"
#include "io/send/SingleHost.h"
#include "model/base/Error.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

namespace palp {

namespace {

/// A refusal that came back; over loopback it is there when send() returns.
int pendingError(int socket) {
  int error = 0;
  socklen_t size = sizeof error;
  return getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

int connectedTo(const addrinfo& address, bool toMany) {
  const int made = ::socket(address.ai_family, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int yes = 1;
  if (made >= 0 && toMany) setsockopt(made, SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes);
  if (made < 0 || ::connect(made, address.ai_addr, address.ai_addrlen) == 0) return made;
  const int reason = errno;
  ::close(made);
  errno = reason;
  return -1;
}

} // namespace

DatagramSocket::DatagramSocket(const Receiver& receiver, bool toMany) {
  int reason = 0;
  const Addresses all = addressesOf(receiver);
  for (const addrinfo* address : inOrder(all.get())) {
    const int made = connectedTo(*address, toMany);
    if (made >= 0) sockets_.push_back(made);
    if (made < 0) reason = errno;
  }
  if (sockets_.empty()) throw Error(receiver.where + ": cannot be sent to: " + systemMessage(reason));
}

DatagramSocket::~DatagramSocket() {
  for (const int socket : sockets_) ::close(socket);
}

bool DatagramSocket::send(const void* bytes, std::size_t count) {
  for (std::size_t tried = 0; tried < sockets_.size(); ++tried) {
    const int socket = sockets_[used_];
    static_cast<void>(pendingError(socket)); // of a datagram before this one
    const bool taken = ::send(socket, bytes, count, MSG_NOSIGNAL) == static_cast<ssize_t>(count);
    if (taken && pendingError(socket) == 0) return true;
    used_ = (used_ + 1) % sockets_.size();
  }
  return false;
}

} // namespace palp
