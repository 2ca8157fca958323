#pragma once

#include "app/study/live/ForceAlarm.h"
#include "app/study/live/ForceDecoder.h"
#include "app/study/live/RestReference.h"
#include "io/board/FrameAssembler.h"
#include "io/board/LatencyMeter.h"
#include "io/board/Recording.h"
#include "io/board/ReplaySource.h"

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace palp {

class LiveWorker;

enum class LiveState {
  Searching, ///< no board; continues automatically when one is plugged in
  Refused,   ///< a board that may not or cannot be opened or used; what to do is in `reason`
  Streaming,
  Stalled, ///< the board is there but nothing has come for 250 ms
  Paused,
  Ended ///< the recording, or a board that is not searched again
};
const char* name(LiveState state);

/// How the marks of an alarm (ForceAlarm.h) begin where it goes off, and what they say where it is over.
inline constexpr const char* kAlarmBegins = "alarm: ";
inline constexpr const char* kAlarmOver = "alarm over";

/// One frame with all that was made of it.
struct LiveFrame {
  BoardFrame frame;
  std::vector<std::string> faults; ///< bad wires, as text
  DecodedForces forces;            ///< not valid without a network
  Eigen::MatrixXd change;          ///< R / R at rest - 1, row-wires x column-wires; NaN where a reading is not good
  double latency_s = 0;            ///< from the device's clock to the decoded force
  double decoding_s = 0;           ///< of it, from the report's arrival to the decoded force
  std::uint64_t lostReports = 0;   ///< since the session's start
  std::uint64_t connection = 0;    ///< how many the source had, at this frame
  std::uint64_t jumps = 0;         ///< how often the recording was taken up at another place, at this frame
  std::string mark;                ///< the last event mark of the user or the recording
  bool past = false;               ///< from before the place of the recording that was gone to: for its curves alone
  bool markFollowsJump = false;    ///< it is at or after the place where the recording last continued
};

struct LatencySummary {
  double p50_s = 0, p99_s = 0, longest_s = 0;
};

/// A copy of everything that a window or a line of text shows.
struct LiveStatus {
  LiveState state = LiveState::Searching;
  std::string reason;
  std::string source;
  std::optional<BoardInfo> info;
  std::optional<BoardConfiguration> configuration;
  ReportCounts counts;
  std::uint64_t connections = 0;
  std::uint64_t lateFrames = 0;                     ///< decoded more than 20 ms after the device read them
  std::uint64_t overflowed = 0;                     ///< frames that nobody drained in time
  double reportsPerSecond = 0, framesPerSecond = 0; ///< measured
  LatencySummary latency;                           ///< device clock to force
  LatencySummary decoding;                          ///< arrival of the report to force
  std::optional<double> temperature_degC;
  std::string decoderProblem; ///< why there are no forces; empty where there are
  bool taring = false, tared = false;
  std::shared_ptr<const Tare> tare; ///< that holds; null: none
  bool tareOfRecording = false;     ///< it was made before or while that was recorded
  std::optional<double> drift;      ///< relative, of all readings since rest; none: not seen at rest yet
  double driftForce_N = 0;          ///< what the drift reads as
  bool tareSuggested = false;       ///< it is more than 1 % of the force range
  double driftRate_N_min = 0;       ///< how fast that changes
  bool driftsOn = false;            ///< both: a tare now would be needed again within a minute
  double steadyRate_N_min = 0;      ///< below which a tare holds
  bool blind = false;               ///< the last half second gave no forces: no alarm can go off
  std::string restName;             ///< what LiveFrame::change counts from
  double noise = 0;                 ///< relative, of the readings
  std::string alarm;                ///< the alarm that is on, as text
  std::string lastAlarm;            ///< the last one that went off; `alarms` counts them
  std::uint64_t alarms = 0;
  bool recording = false;
  bool recordingWaits = false; ///< for the board, which is out; continues in the same file when it is back
  std::uint64_t recordedReports = 0, recordingDropped = 0;
  std::string recordingFailure;
  std::string lastEvent; ///< last message of the board, or what failed
};

struct LiveOptions {
  /// Opens the board, recording or virtual board; null where there is none now. What it throws is shown as a refusal,
  /// and it is called again while `reconnect` holds.
  std::function<std::unique_ptr<ReportSource>()> open;
  bool reconnect = true; ///< search again when the board is gone
  std::optional<Decoder> decoder;
  std::optional<SensorDesign> design; ///< for tare
  std::optional<ForceAlarm> alarm;
  int tareFrames = 0; ///< tare with the first frames; 0: not
  /// The tare that is known of a board from before; may be empty, and give null.
  std::function<std::shared_ptr<const Tare>(const BoardInfo&)> tareOf;
  std::shared_ptr<ReplayControl> replay;
  /// Gets each frame in the session's thread, before the ring: must return immediately.
  std::function<void(const std::shared_ptr<const LiveFrame>&)> alsoTo;
  std::size_t ringFrames = 2048; ///< kept for a reader that drains late; where there are more, the oldest are lost
  bool waitForReader = false;    ///< a recording waits for such a reader, so that each frame is seen
  bool waitForRecording = false; ///< the first report is read when a recording is there that begins with it
};

/// A board, live: one thread owns the source, decodes, records and fills a ring that a window or a program drains.
/// Meshes and solves nothing. A tare outlives a reconnection of a board of the same size.
class LiveSession {
public:
  explicit LiveSession(LiveOptions options);
  ~LiveSession();
  LiveSession(const LiveSession&) = delete;
  LiveSession& operator=(const LiveSession&) = delete;

  [[nodiscard]] LiveStatus status() const;
  /// Ends the thread and with it a recording; the status is then the last one.
  void stop();
  /// Frames since the last call, oldest first.
  std::vector<std::shared_ptr<const LiveFrame>> drain();

  // All of these take effect in the session's thread, between two reports.
  void tare(int frames);
  void clearTare();
  void setDecoder(std::optional<Decoder> decoder, std::optional<SensorDesign> design);
  void pause(bool paused); ///< decoding and display; a recording continues
  /// Nobody looks: nothing is read and no board is held open, but for a recording. The tare stays.
  void idle(bool idle);
  void configure(const BoardConfiguration& configuration);
  void mark(const std::string& text);
  /// Goes off in the marks and in the status; none: no alarm.
  void setAlarm(std::optional<ForceAlarm> alarm);

  /// Records from now on; throws Error where the file cannot be written. `network` is its fingerprint, for the head.
  void startRecording(const std::filesystem::path& path, const std::string& network, bool force);
  void stopRecording();

private:
  void run(const std::stop_token& stop);
  void post(std::function<void(LiveWorker&)> request);

  LiveOptions options_;
  mutable std::mutex mutex_;
  LiveStatus status_;
  std::deque<std::shared_ptr<const LiveFrame>> ring_;
  std::vector<std::function<void(LiveWorker&)>> requests_;
  std::jthread thread_; ///< last: it uses all of the above
};

} // namespace palp
