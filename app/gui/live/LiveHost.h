#pragma once

#include "app/gui/live/LiveNetwork.h"
#include "app/gui/live/SimulatedDesign.h"
#include "app/gui/live/send/LiveSending.h"
#include "app/gui/project/LiveSettings.h"
#include "app/study/live/BoardWatch.h"
#include "app/study/live/LiveHistory.h"
#include "app/study/live/SimulatedTouch.h"
#include "io/board/KeptTares.h"
#include "io/board/SimulatedSource.h"

#include <QObject>

#include <future>
#include <vector>

namespace palp {

/// Both choose the same board, simulation or recording.
[[nodiscard]] bool sameSource(const LiveSettings& a, const LiveSettings& b);

/// The live session of one board in the Live scene: opened by the settings, drained when the scene looks. While the
/// scene is hidden a recording continues and an alarm that is set works; else nothing is read.
///
/// States and order of calls: setSettings() before all else. Closed: no session; settings are stored only. The first
/// setVisible(true) opens the session and reads the network. Open: look() takes frames and status at each tick of the
/// scene, gives each connection its rate and rows, and replaces the simulated board when a real one is plugged in.
/// Other settings change the running session, except another source, seed or simulated design: restart() ends it in a
/// thread of its own and opens the next; openings() counts them. Hidden: paused, or, with a recording, an alarm or a
/// receiver, running. close() ends everything; the host may be deleted when closed() returns true.
class LiveHost : public QObject {
  Q_OBJECT

public:
  explicit LiveHost(BoardAccess access = {}, QObject* parent = nullptr);
  ~LiveHost() override;

  /// Follows new settings: another source is opened, all else changes in the running session.
  void setSettings(const LiveSettings& settings, const SensorDesign& design);
  [[nodiscard]] const LiveSettings& settings() const { return settings_; }
  /// The scene is seen or hidden.
  void setVisible(bool visible);
  /// Opens the source again: after a recording's end, or a refusal. Waits for nothing.
  void restart();
  /// Takes what has come since the last look; true where there is a new frame.
  bool look();
  /// Something is done while the scene is hidden too: a recording, or an alarm that is set.
  [[nodiscard]] bool worksHidden() const;
  /// Ends for good, without waiting; a recording is closed.
  void close();
  /// What was closed has ended.
  [[nodiscard]] bool closed();

  [[nodiscard]] const LiveStatus& status() const { return status_; }
  [[nodiscard]] const LiveHistory& history() const { return history_; }
  /// Frames of the last look.
  [[nodiscard]] const std::vector<std::shared_ptr<const LiveFrame>>& fresh() const { return fresh_; }
  [[nodiscard]] std::vector<HidBoard> boards() const;
  /// No other session of this program reads it.
  [[nodiscard]] bool free(const HidBoard& board) const { return access_.free(board); }
  /// The source is the virtual board or a recording.
  [[nodiscard]] bool simulated() const;
  [[nodiscard]] bool replaying() const { return replay_ != nullptr; }
  [[nodiscard]] ReplayControl* replay() const { return replay_.get(); }
  [[nodiscard]] LiveNetwork& network() { return network_; }
  [[nodiscard]] const LiveNetwork& network() const { return network_; }
  /// The network's design where it is known, else the project's.
  [[nodiscard]] const SensorDesign& sensor() const { return sensor_; }
  /// Solves the project's design for the simulated board.
  void simulateDesign(const MeshOptions& mesh) { simulatedDesign_.solve(design_, mesh, settings_.simulation.moving); }
  [[nodiscard]] JobRunner& simulator() { return simulatedDesign_.runner(); }
  /// What the simulated board simulates.
  [[nodiscard]] const SensorDesign& simulatedSensor() const;
  /// It simulates the project's design, and an indenter that moves where that is wanted.
  [[nodiscard]] bool simulatesOwnDesign() const;
  /// What truly touches the simulated board at the time of a frame; none where nothing moves over it.
  [[nodiscard]] std::optional<SimulatedTouch::Truth> trueTouch(const BoardFrame& at) const;
  void tare();
  void clearTare();
  void setPaused(bool paused);
  [[nodiscard]] bool paused() const { return paused_; }
  /// Of a recording, which is held then: one frame on, or back.
  void step(int frames);
  void mark(const std::string& text);
  void setPluggedIn(bool in);
  [[nodiscard]] bool pluggedIn() const;
  /// Throws Error where nothing can be recorded.
  void startRecording(const std::filesystem::path& path, bool replace);
  void stopRecording();
  /// It is recorded, or would be if the board were not out.
  [[nodiscard]] bool recording() const { return status_.recording || status_.recordingWaits; }
  /// No receiver that was switched off is still ending.
  [[nodiscard]] bool sendingSettled() const { return sending_.settled(); }
  /// Of each receiver of the settings.
  [[nodiscard]] std::vector<SendingState> sending() { return sending_.states(settings_.receivers); }
  /// Duration of the recording or of the last one [s], without the time in which the board was unplugged.
  [[nodiscard]] double recorded_s() const;
  /// The file of the last recording that was begun.
  [[nodiscard]] const std::filesystem::path& recordingFile() const { return recordingFile_; }
  /// The network of the settings again, instead of one that was refined since.
  void useChosenNetwork();
  /// Continues from this time of the recording [s].
  void seek(double to_s);

  /// Sources that were opened so far: another number is another source.
  [[nodiscard]] int openings() const { return openings_; }

signals:
  /// Another network is in use, or its sensor() has changed.
  void decoderChanged();

private:
  void open();
  /// Ends a thread of its own without waiting for it.
  template <class Running> void endInBackground(std::unique_ptr<Running> old);
  void loadNetwork();
  void applyNetwork();
  void applyPause();
  [[nodiscard]] bool watches() const { return (settings_.alarmOn || sending_.on()) && !replay_; }
  void configureOnce();
  void drain();
  void timeRecording();
  [[nodiscard]] LiveOptions options();
  [[nodiscard]] BoardDisturbance disturbance() const;
  [[nodiscard]] BoardFaults faults() const;
  [[nodiscard]] std::optional<SensorDesign> tareDesign() const;
  [[nodiscard]] std::optional<ForceAlarm> alarm() const;
  [[nodiscard]] const SimulatedDesign::Solved* own() const;
  void followDesign();
  void hold();

  BoardAccess access_;
  LiveSettings settings_;
  SensorDesign design_, sensor_;
  std::shared_ptr<const SampleSet> running_; ///< that the simulated board was opened with; null: those of Palp
  LiveNetwork network_;
  bool designWaits_ = false; ///< the simulated board follows the design when its recording has ended
  bool visible_ = false, paused_ = false;
  bool recorded_ = false; ///< at the last look
  std::filesystem::path recordingFile_;
  double recordedBefore_s_ = 0;          ///< that the recording holds, up to the last time that the board went out
  std::optional<double> recordsSince_s_; ///< by hostClock_s; none: nothing comes, or none is running
  bool recordingEnds_ = false;           ///< was requested
  SimulatedDesign simulatedDesign_;
  std::shared_ptr<TouchHand> hand_ = std::make_shared<TouchHand>(); ///< on the simulated board
  std::shared_ptr<SimulationControl> simulation_;
  std::shared_ptr<ReplayControl> replay_;
  std::shared_ptr<std::atomic<bool>> boardSeen_; ///< a real board was opened since the start
  std::unique_ptr<BoardWatch> watch_;
  std::unique_ptr<LiveSession> session_;
  LiveSending sending_;
  std::vector<std::future<void>> closing_; ///< sessions and watches before these, while they end
  LiveStatus status_;
  KeptTares tares_;
  LiveHistory history_;
  int openings_ = 0;
  std::vector<std::shared_ptr<const LiveFrame>> fresh_;
  std::vector<std::shared_ptr<const LiveFrame>> waiting_; ///< frames of the past, for the place that was gone to
  std::uint64_t configured_ = 0;                          ///< the connection that has got its rate and rows
};

} // namespace palp
