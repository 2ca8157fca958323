// The virtual board as a HID device of the kernel (uhid), in the machine of the system test.
//   guest-board RATE CORRUPT_EVERY UNPLUG_AFTER_S PLUGS: PLUGS times plugged in, each time for UNPLUG_AFTER_S seconds.

#include "io/board/ReportSource.h"
#include "io/board/VirtualBoard.h"

#include <fcntl.h>
#include <linux/uhid.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>

namespace palp {
namespace {

class KernelBoard {
public:
  explicit KernelBoard(VirtualBoard board) : board_(std::move(board)) {}

  void plugIn() {
    board_.restart();
    file_ = ::open("/dev/uhid", O_RDWR | O_CLOEXEC);
    uhid_event event{};
    event.type = UHID_CREATE2;
    uhid_create2_req& create = event.u.create2;
    std::strcpy(reinterpret_cast<char*>(create.name), "Palp tactile board");
    std::strcpy(reinterpret_cast<char*>(create.uniq), board_.info().serial.c_str());
    const auto descriptor = reportDescriptor();
    std::copy(descriptor.begin(), descriptor.end(), create.rd_data);
    create.rd_size = static_cast<std::uint16_t>(descriptor.size());
    create.bus = 3; // USB
    create.vendor = UsbId{}.vendor;
    create.product = UsbId{}.product;
    put(event);
  }

  void unplug() {
    uhid_event event{};
    event.type = UHID_DESTROY;
    put(event);
    ::close(file_);
  }

  void runFor(double seconds) {
    const double end_s = hostClock_s() + seconds;
    while (hostClock_s() < end_s) {
      board_.advance(static_cast<std::uint64_t>(1e6 * hostClock_s()), [this](std::span<const std::uint8_t> report) {
        uhid_event event{};
        event.type = UHID_INPUT2;
        event.u.input2.size = static_cast<std::uint16_t>(report.size());
        std::copy(report.begin(), report.end(), event.u.input2.data);
        put(event);
      });
      pollfd wait{file_, POLLIN, 0};
      timespec nap{0, 100'000};
      if (::ppoll(&wait, 1, &nap, nullptr) > 0) answer();
    }
  }

private:
  void put(const uhid_event& event) {
    if (::write(file_, &event, sizeof event) >= 0) return;
    std::perror("guest-board: /dev/uhid");
    std::exit(1);
  }

  void answer() {
    uhid_event asked{};
    if (::read(file_, &asked, sizeof asked) < 0) return;
    uhid_event reply{};
    if (asked.type == UHID_GET_REPORT) {
      const auto report = board_.feature(asked.u.get_report.rnum);
      reply.type = UHID_GET_REPORT_REPLY;
      reply.u.get_report_reply.id = asked.u.get_report.id;
      reply.u.get_report_reply.err = report ? 0 : EIO;
      reply.u.get_report_reply.size = report ? kReportBytes : 0;
      if (report) std::copy(report->begin(), report->end(), reply.u.get_report_reply.data);
      put(reply);
    } else if (asked.type == UHID_SET_REPORT) {
      const bool taken = board_.setFeature({asked.u.set_report.data, asked.u.set_report.size});
      reply.type = UHID_SET_REPORT_REPLY;
      reply.u.set_report_reply.id = asked.u.set_report.id;
      reply.u.set_report_reply.err = taken ? 0 : EIO;
      put(reply);
    } else if (asked.type == UHID_OUTPUT) {
      board_.output({asked.u.output.data, asked.u.output.size});
    }
  }

  VirtualBoard board_;
  int file_ = -1;
};

} // namespace
} // namespace palp

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "guest-board: RATE CORRUPT_EVERY UNPLUG_AFTER_S PLUGS\n");
    return 2;
  }
  palp::BoardSettings settings;
  settings.info.serial = "GUEST-1";
  settings.info.model = "GUEST";
  settings.configuration.rate_Hz = std::atoi(argv[1]);
  settings.faults.corruptEvery = std::atoi(argv[2]);
  const Eigen::MatrixXd resistances = Eigen::MatrixXd::Constant(10, 30, 400);
  palp::KernelBoard board(palp::VirtualBoard(settings, [&](double) -> const Eigen::MatrixXd& { return resistances; }));
  for (int plug = 0; plug < std::atoi(argv[4]); ++plug) {
    board.plugIn();
    board.runFor(std::atof(argv[3]));
    board.unplug();
    std::this_thread::sleep_for(std::chrono::seconds(1));
  }
}
