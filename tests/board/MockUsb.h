#pragma once

#include "io/board/VirtualBoard.h"

#include <umockdev.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace palp {

/// A mocked /sys and /dev, seen by hidapi and libudev of this process while it runs under umockdev-wrapper.
class MockUsb {
public:
  MockUsb();
  ~MockUsb();
  MockUsb(const MockUsb&) = delete;
  MockUsb& operator=(const MockUsb&) = delete;

  [[nodiscard]] UMockdevTestbed* testbed() const { return testbed_; }
  [[nodiscard]] std::string root() const;

private:
  UMockdevTestbed* testbed_;
};

/// The virtual board behind a mocked hidraw node: features and commands by ioctl and write, reports through a pipe in
/// packet mode. The board waits where the reader does not keep up.
class MockBoard {
public:
  /// USB port 1-`port`, node /dev/hidraw`node`.
  MockBoard(MockUsb& usb, VirtualBoard board, int port, int node);
  ~MockBoard();
  MockBoard(const MockBoard&) = delete;
  MockBoard& operator=(const MockBoard&) = delete;

  void startStreaming();
  void stopStreaming();
  /// Reads fail from now on, the kernel says so, the device goes.
  void unplug();
  [[nodiscard]] std::string path() const { return "/dev/hidraw" + std::to_string(node_); }
  /// The real file behind the node.
  [[nodiscard]] std::string file() const;
  [[nodiscard]] int commands() const { return commands_; }

private:
  static gboolean onIoctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
  static gboolean onRead(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
  static gboolean onWrite(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
  gboolean answerIoctl(UMockdevIoctlClient* client);
  void makePipe();
  void pump();
  [[nodiscard]] std::string usbPath() const;
  [[nodiscard]] std::string description() const;

  MockUsb& usb_;
  std::mutex mutex_; ///< of the board: its ioctls come from another thread than its reports
  VirtualBoard board_;
  int port_;
  int node_;
  int pipe_ = -1;
  UMockdevIoctlBase* io_ = nullptr;
  std::atomic<bool> gone_{false};
  std::atomic<bool> streaming_{false};
  std::atomic<int> commands_{0};
  std::thread pump_;
};

} // namespace palp
