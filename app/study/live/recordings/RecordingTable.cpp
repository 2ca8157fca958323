#include "app/study/live/recordings/RecordingTable.h"

#include "app/study/live/LiveSession.h"
#include "app/study/live/send/ForceSender.h"
#include "io/AtomicFile.h"
#include "io/CsvText.h"
#include "io/board/RecordingReader.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "model/base/Text.h"

#include <algorithm>
#include <atomic>
#include <fstream>

namespace palp {

namespace {

constexpr auto kLook = std::chrono::milliseconds(50);

/// A field in quotes, on one line; empty for an empty text.
std::string textField(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.empty() ? text : quotedCsvField(text);
}

/// The lines of one recording; used by the session's thread alone until the session has ended.
class FrameTable {
public:
  FrameTable(const RecordingTableRequest& request, double startedUnix_s)
      : file_(request.table, request.force), out_(file_.temporary(), std::ios::binary), startedUnix_s_(startedUnix_s),
        forces_(request.decoder ? request.decoder->outputs() / 3 : 1) {
    out_ << request.head;
  }

  void writeHead(const BoardInfo& info) {
    std::string line = frameCsvHead(forces_);
    line.pop_back(); // the end of line
    line += ",recording_s,complete,lost_reports,missing_readings,temperature_degC,misfit,mark,reason";
    for (int row = 0; row < info.rowWires; ++row)
      for (int column = 0; column < info.columnWires; ++column)
        line += ",R_r" + std::to_string(row) + "_c" + std::to_string(column) + "_ohm";
    out_ << line << '\n';
  }

  void write(const LiveFrame& live, double begin_s) {
    const DecodedForces& forces = live.forces;
    const double recording_s = live.frame.hostTime_s - begin_s;
    std::string line = frameAsCsv(outgoing(live, startedUnix_s_ + recording_s), forces_);
    line.back() = ','; // the end of line
    line += text(recording_s) + (live.frame.complete ? ",1," : ",0,") + std::to_string(live.lostReports) + ',';
    if (forces.valid) line += std::to_string(forces.missingReadings);
    line += ',';
    if (live.frame.temperature_degC) line += text(*live.frame.temperature_degC);
    line += ',';
    if (forces.misfit) line += text(*forces.misfit);
    line += ',' + textField(live.mark == mark_ ? std::string() : live.mark) + ',' +
            textField(forces.valid ? forces.doubt : forces.reason);
    mark_ = live.mark;
    for (Eigen::Index row = 0; row < live.frame.state.rows(); ++row)
      for (Eigen::Index column = 0; column < live.frame.state.cols(); ++column) {
        line += ',';
        if (live.frame.state(row, column) == ReadingState::Good) line += text(live.frame.resistances_ohm(row, column));
      }
    out_ << line << '\n';
    if (!out_) failed_ = true;
    ++frames_;
  }

  [[nodiscard]] bool failed() const { return failed_; }
  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  void commit(const std::filesystem::path& path) {
    out_.close();
    if (!out_) throw Error(path.string() + ": cannot be written; is the disk full?");
    file_.commit();
  }

private:
  AtomicFile file_;
  std::ofstream out_;
  double startedUnix_s_;
  Eigen::Index forces_;
  std::string mark_;
  std::uint64_t frames_ = 0;
  std::atomic<bool> failed_{false};
};

} // namespace

RecordingTableReport writeRecordingTable(const RecordingTableRequest& request,
                                         const std::function<void(double share)>& progress,
                                         const std::stop_token& stop) {
  const auto control = std::make_shared<ReplayControl>();
  control->speed = 0;
  // Opened here, so that what cannot be read is refused before a table is begun.
  const auto source =
      std::make_shared<std::unique_ptr<ReportSource>>(std::make_unique<ReplaySource>(request.recording, control));
  const BoardInfo info = (*source)->info();
  const RecordingHead head = RecordingReader(request.recording).head();
  const auto table = std::make_shared<FrameTable>(request, static_cast<double>(head.startedUnix_s));
  table->writeHead(info);
  LiveOptions options;
  options.open = [source] { return std::move(*source); };
  options.reconnect = false;
  options.decoder = request.decoder;
  options.design = request.design;
  options.replay = control;
  options.ringFrames = 1;
  options.alsoTo = [table, control](const std::shared_ptr<const LiveFrame>& frame) {
    table->write(*frame, control->begin_s);
  };
  LiveSession session(std::move(options));
  LiveStatus status = session.status();
  for (; status.state != LiveState::Ended && status.state != LiveState::Refused; status = session.status()) {
    if (stop.stop_requested() || table->failed()) break;
    progress(control->length_s > 0 ? std::min(1.0, control->position_s / control->length_s) : 0);
    std::this_thread::sleep_for(kLook);
  }
  session.stop();
  throwIfStopped(stop);
  if (status.state == LiveState::Refused) throw Error(status.reason);
  table->commit(request.table);
  return {table->frames(), status.decoderProblem.empty() ? status.reason : status.decoderProblem};
}

} // namespace palp
