#pragma once

// Private to LiveSession: what its thread owns.

#include "app/study/live/LiveSession.h"
#include "app/study/live/drift/DriftWatch.h"
#include "io/board/Hotplug.h"
#include "io/board/RecordingWriter.h"

#include <utility>

namespace palp {

/// The work of the session's thread; nobody else touches it while the thread runs.
class LiveWorker {
public:
  using TakeFrame = std::function<void(std::shared_ptr<const LiveFrame>)>;

  LiveWorker(LiveOptions options, TakeFrame take);

  /// One report, one look for a board, or a short wait. Throws nothing.
  void step();
  /// Runs a call of the session's user. What it throws ends the connection, and the status has the reason.
  void guarded(const std::function<void()>& call);
  [[nodiscard]] LiveState state() const { return status_.state; }
  [[nodiscard]] LiveStatus status();

  void tare(int frames);
  void clearTare();
  void setDecoder(std::optional<Decoder> decoder, std::optional<SensorDesign> design);
  void pause(bool paused);
  void idle(bool idle);
  void configure(const BoardConfiguration& configuration);
  void mark(const std::string& text);
  void setAlarm(std::optional<ForceAlarm> alarm) {
    const bool was = !alarm_.words().empty();
    alarm_.set(alarm);
    if (was && alarm_.words().empty()) mark(kAlarmOver);
  }
  /// The recording before it is ended first; null: no other one is begun.
  void setWriter(std::shared_ptr<RecordingWriter> writer);

private:
  void rest();
  void search();
  void connect(std::unique_ptr<ReportSource> source);
  void disconnect(LiveState state, const std::string& reason);
  void read();
  void jumped();
  [[nodiscard]] ReplaySource* replay() const { return dynamic_cast<ReplaySource*>(source_.get()); }
  [[nodiscard]] bool inPast() const { return replay() != nullptr && replay()->inPast(); }
  void take(const RawReport& report);
  void takeFrame(const BoardFrame& frame);
  void takeEvent(const BoardEvent& event);
  void readConfigurationAgain();
  void makeDecoder();
  void holdTare(std::shared_ptr<const Tare> tare);
  void recordTare();
  void followConfiguration();
  void recordConfiguration();
  [[nodiscard]] double recordedTime_s() const;
  void endRecording();
  void statusOfRecording();
  /// A recording was begun and neither ended nor failed. A failed one counts what it lacks until the next one begins.
  [[nodiscard]] bool records() const { return writer_ && status_.recordingFailure.empty(); }
  void watch(const DecodedForces& forces);
  void measureRates(double now_s);
  void restartRates(double now_s);

  LiveOptions options_;
  TakeFrame give_;
  Hotplug hotplug_;
  bool searched_ = false;
  std::unique_ptr<ReportSource> source_;
  using BoardIdentity = std::pair<std::string, BoardInfo>; ///< name and its own description
  /// The board that sent reports of another protocol: left alone until it is gone or another one is there.
  std::optional<BoardIdentity> otherProtocol_;
  std::optional<FrameAssembler> assembler_;
  ReportCounts earlier_; ///< of the connections before this one
  std::optional<ForceDecoder> decoder_;
  RestReference rest_;
  std::shared_ptr<const Tare> tare_; ///< that holds; null: none
  bool ownTare_ = false;             ///< the user tared what is played: the recording's tare counts no more
  AlarmWatch alarm_;
  int blindFrames_ = 0;
  DriftWatch drift_;
  std::shared_ptr<RecordingWriter> writer_;
  LatencyMeter latency_, decoding_;
  RawReport report_;
  LiveStatus status_;
  bool paused_ = false, idle_ = false;
  std::string mark_;            ///< of the user, the last one
  std::uint64_t jumps_ = 0;     ///< of the recording that is played
  double arrival_s_ = 0;        ///< host clock at the last report
  double requestedAgain_s_ = 0; ///< host clock when the configuration was read again
  double rateStart_s_ = 0;
  std::uint64_t rateReports_ = 0, rateFrames_ = 0;
};

} // namespace palp
