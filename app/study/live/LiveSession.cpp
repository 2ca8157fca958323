#include "app/study/live/LiveSession.h"

#include "app/study/Failure.h"
#include "app/study/live/LiveWorker.h"
#include "io/board/RecordingWriter.h"
#include "model/base/Error.h"

#include <chrono>
#include <iterator>

namespace palp {

namespace {

constexpr double kPublishInterval_s = 0.05;
constexpr auto kReaderInterval = std::chrono::milliseconds(1);

} // namespace

const char* name(LiveState state) {
  switch (state) {
  case LiveState::Searching:
    return "searching";
  case LiveState::Refused:
    return "refused";
  case LiveState::Streaming:
    return "streaming";
  case LiveState::Stalled:
    return "stalled";
  case LiveState::Paused:
    return "paused";
  case LiveState::Ended:
    return "ended";
  }
  return "";
}

LiveSession::LiveSession(LiveOptions options)
    : options_(std::move(options)), thread_([this](const std::stop_token& stop) {
        try {
          run(stop);
        } catch (...) { // the last resort of this thread: the session ends, not the program
          const std::lock_guard lock(mutex_);
          status_.state = LiveState::Ended;
          status_.reason = failureInWords(std::current_exception());
        }
      }) {}

LiveSession::~LiveSession() = default; // the thread is stopped and joined first

void LiveSession::run(const std::stop_token& stop) {
  const std::size_t most = options_.ringFrames;
  std::uint64_t overflowed = 0;
  const auto alsoTo = options_.alsoTo;
  const bool replays = options_.waitForReader && options_.replay;
  LiveWorker worker(std::move(options_), [&](std::shared_ptr<const LiveFrame> frame) {
    if (alsoTo && !frame->past) alsoTo(frame);
    const std::lock_guard lock(mutex_);
    ring_.push_back(std::move(frame));
    if (ring_.size() <= most) return;
    ring_.pop_front();
    ++overflowed;
  });
  const auto publish = [&] {
    LiveStatus status = worker.status();
    status.overflowed = overflowed;
    const std::lock_guard lock(mutex_);
    status_ = std::move(status);
  };
  const auto full = [this, most, waits = replays] {
    const std::lock_guard lock(mutex_);
    return waits && ring_.size() >= most;
  };
  double published_s = 0;
  LiveState state = LiveState::Searching;
  std::vector<std::function<void(LiveWorker&)>> requests;
  while (!stop.stop_requested()) {
    {
      const std::lock_guard lock(mutex_);
      requests.swap(requests_);
    }
    for (const auto& request : requests) worker.guarded([&] { request(worker); });
    if (full()) { // a recording waits for its reader: each of its frames is seen
      std::this_thread::sleep_for(kReaderInterval);
    } else {
      worker.step();
    }
    const double now_s = hostClock_s();
    if (requests.empty() && worker.state() == state && now_s < published_s + kPublishInterval_s) continue;
    state = worker.state();
    published_s = now_s;
    requests.clear();
    publish();
  }
  worker.setWriter(nullptr); // its report on the recording is final then
  publish();
}

void LiveSession::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

LiveStatus LiveSession::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

std::vector<std::shared_ptr<const LiveFrame>> LiveSession::drain() {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<const LiveFrame>> frames(std::make_move_iterator(ring_.begin()),
                                                       std::make_move_iterator(ring_.end()));
  ring_.clear();
  return frames;
}

void LiveSession::post(std::function<void(LiveWorker&)> request) {
  const std::lock_guard lock(mutex_);
  requests_.push_back(std::move(request));
}

void LiveSession::tare(int frames) {
  post([frames](LiveWorker& worker) { worker.tare(frames); });
}

void LiveSession::clearTare() {
  post([](LiveWorker& worker) { worker.clearTare(); });
}

void LiveSession::setDecoder(std::optional<Decoder> decoder, std::optional<SensorDesign> design) {
  post([decoder = std::move(decoder), design = std::move(design)](LiveWorker& worker) {
    worker.setDecoder(decoder, design);
  });
}

void LiveSession::pause(bool paused) {
  post([paused](LiveWorker& worker) { worker.pause(paused); });
}

void LiveSession::idle(bool idle) {
  post([idle](LiveWorker& worker) { worker.idle(idle); });
}

void LiveSession::configure(const BoardConfiguration& configuration) {
  post([configuration](LiveWorker& worker) { worker.configure(configuration); });
}

void LiveSession::mark(const std::string& text) {
  post([text](LiveWorker& worker) { worker.mark(text); });
}

void LiveSession::setAlarm(std::optional<ForceAlarm> alarm) {
  post([alarm](LiveWorker& worker) { worker.setAlarm(alarm); });
}

void LiveSession::startRecording(const std::filesystem::path& path, const std::string& network, bool force) {
  const LiveStatus now = status();
  if (!now.info || !now.configuration || now.state != LiveState::Streaming)
    throw Error(path.string() + ": nothing to record: " + (now.source.empty() ? "the board" : now.source) + " is " +
                name(now.state) + (now.reason.empty() ? "" : " (" + now.reason + ")"));
  const auto started = std::chrono::system_clock::now().time_since_epoch();
  const RecordingHead head{*now.info, *now.configuration, now.source, network,
                           std::chrono::duration_cast<std::chrono::seconds>(started).count()};
  auto writer = std::make_shared<RecordingWriter>(path, head, force);
  post([writer](LiveWorker& worker) { worker.setWriter(writer); });
}

void LiveSession::stopRecording() {
  post([](LiveWorker& worker) { worker.setWriter(nullptr); });
}

} // namespace palp
