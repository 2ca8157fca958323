#include "io/AtomicFile.h"
#include "io/files/SystemError.h"
#include "io/send/Outlets.h"
#include "model/base/Error.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <csignal>

namespace palp {

namespace {

/// Lines of CSV into a file, a FIFO or standard output. A line goes completely or not at all: what a full pipe did not
/// take of it goes before the next one, and a file on a full disk ends with its last complete line. The names of the
/// columns come first, again for each reader of a FIFO.
class LineOutlet : public ForceOutlet {
public:
  LineOutlet(std::string where, std::string file, bool force) : where_(std::move(where)), file_(std::move(file)) {
    if (file_ == "-") {
      descriptor_ = STDOUT_FILENO;
      return;
    }
    struct stat about {};
    fifo_ = ::stat(file_.c_str(), &about) == 0 && S_ISFIFO(about.st_mode);
    if (fifo_) return; // opened as soon as it is read
    requireFree(file_, force);
    descriptor_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NONBLOCK, 0666);
    if (descriptor_ < 0) throw Error(where_ + ": cannot be written: " + systemMessage());
  }
  ~LineOutlet() override {
    if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
  }
  LineOutlet(const LineOutlet&) = delete;
  LineOutlet& operator=(const LineOutlet&) = delete;

  [[nodiscard]] std::string failure() const override { return failure_; }

  bool send(const OutgoingFrame& frame, std::chrono::milliseconds patience) override {
    if (!signalsBlocked_ && fifo_) blockBrokenPipe(); // of standard output it ends the program, as of any other
    if (fifo_ && descriptor_ < 0) descriptor_ = ::open(file_.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0) return false; // nobody reads
    if (!begun_) {
      forces_ = std::max<Eigen::Index>(forces_, std::max<Eigen::Index>(1, frame.forces_N.cols()));
      rest_ = frameCsvHead(forces_);
      begun_ = true;
    }
    if (!write(patience) || !rest_.empty()) return false;
    rest_ = frameAsCsv(frame, forces_);
    const std::size_t whole = rest_.size();
    if (!write(patience)) return false;
    if (rest_.size() < whole) return true; // begun: its end goes before the next line
    rest_.clear();
    return false;
  }

private:
  /// In the one thread that sends: a reader that went away is an error there, not the end of the program.
  void blockBrokenPipe() {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    signalsBlocked_ = true;
  }

  /// As much of `rest_` as is taken in time; false where the reader has gone.
  bool write(std::chrono::milliseconds patience) {
    while (!rest_.empty()) {
      pollfd wait{descriptor_, POLLOUT, 0};
      if (::poll(&wait, 1, static_cast<int>(patience.count())) <= 0) return true;
      // What a pipe surely takes without making us wait, where it is not ours to be set so.
      const ssize_t count = ::write(descriptor_, rest_.data(), std::min<std::size_t>(rest_.size(), PIPE_BUF));
      if (count < 0 && (errno == EAGAIN || errno == EINTR)) return true;
      if (count < 0) {
        if (errno != EPIPE) fail(errno);
        gone();
        return false;
      }
      written_ += count;
      rest_.erase(0, static_cast<std::size_t>(count));
      if (rest_.empty()) whole_ = written_;
    }
    return true;
  }

  /// The part of the last line that a full disk took is removed again.
  void fail(int reason) {
    failure_ = where_ + ": can no longer be written: " + systemMessage(reason);
    struct stat about {};
    if (whole_ < written_ && ::fstat(descriptor_, &about) == 0 && S_ISREG(about.st_mode) &&
        ::ftruncate(descriptor_, about.st_size - (written_ - whole_)) != 0)
      failure_ += "; its last line is cut off";
  }

  void gone() {
    if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
    descriptor_ = -1;
    rest_.clear();
    whole_ = written_ = 0;
    begun_ = false; // the next reader of a FIFO gets the names again
  }

  std::string where_, file_;
  std::string failure_;
  off_t written_ = 0, whole_ = 0; ///< bytes so far, and of them those of complete lines
  int descriptor_ = -1;
  bool fifo_ = false, begun_ = false, signalsBlocked_ = false;
  Eigen::Index forces_ = 0; ///< of the columns
  std::string rest_;        ///< of a line that is begun
};

} // namespace

std::unique_ptr<ForceOutlet> openLines(const std::string& where, const std::string& file, bool force) {
  return std::make_unique<LineOutlet>(where, file, force);
}

} // namespace palp
