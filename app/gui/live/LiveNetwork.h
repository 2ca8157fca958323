#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/live/SimulatedDesign.h"
#include "app/gui/project/LiveSettings.h"
#include "app/gui/project/live/BoardCalibration.h"
#include "io/Decoder.h"
#include "io/board/Protocol.h"

#include <QObject>

#include <memory>
#include <optional>
#include <string>

namespace palp {

/// The network that decodes the readings of a board: the file that the settings name, a network that was refined from
/// it, or that of the simulated design; and the network before it, which can be restored.
class LiveNetwork : public QObject {
  Q_OBJECT

public:
  explicit LiveNetwork(QObject* parent = nullptr);

  /// Empty before the first network is read, or where none can be.
  [[nodiscard]] const std::optional<Decoder>& decoder() const { return inUse_.decoder; }
  /// Its file, or how it was made.
  [[nodiscard]] QString name() const;
  /// Empty: the network that ships with Palp.
  [[nodiscard]] const std::string& file() const { return inUse_.file; }
  [[nodiscard]] const std::string& fingerprint() const { return inUse_.fingerprint; }
  /// Null where the network is as it was selected, not refined.
  [[nodiscard]] const std::shared_ptr<const CalibratedNetwork>& calibrated() const { return inUse_.calibrated; }
  [[nodiscard]] bool ofSimulation() const { return inUse_.ofSimulation; }
  /// Name of the network that was in use before; empty where there is none to restore.
  [[nodiscard]] const QString& nameBefore() const { return before_.name; }
  [[nodiscard]] JobRunner& loader() { return loader_; }
  [[nodiscard]] bool loading() const { return loader_.running(); }

  /// Follows new settings; load() reads the network that they name unless it is in use already.
  void follow(const LiveSettings& settings);
  /// The network of the settings is in use, or is being read.
  [[nodiscard]] bool requested() const { return requested_; }
  /// Reads the network of the settings in the background. `solved`: the simulated design, whose network is used where
  /// the settings name none; may be null. `info`: the board that a file's network must be able to read.
  void load(const SimulatedDesign::Solved* solved, const std::optional<BoardInfo>& info);
  /// Uses a refined network instead of the one in use. Recordings get a mark.
  void refine(Decoder decoder, const QString& name);
  /// Uses the network again that was in use before.
  void restore();
  /// Another project is open: there is no network of it to restore.
  void forgetBefore();
  /// Reports the network in use again, to another session.
  void refresh() { use(inUse_); }

signals:
  void changed();
  /// Another network is in use than the settings name: file(), calibrated().
  void otherInUse();
  /// The selected file is not a network for this board; the one in use stays.
  void refused(const QString& sentence);
  /// Text of a mark in the recording.
  void marked(const QString& text);

private:
  struct Network {
    std::optional<Decoder> decoder;
    std::string file;
    std::string fingerprint;                               ///< of the file; empty: it is in none
    QString name;                                          ///< empty: that of its file
    bool ofSimulation = false;                             ///< trained on the samples of the simulated board
    std::shared_ptr<const CalibratedNetwork> calibrated{}; ///< null: not refined
  };
  void use(Network network);
  void takeLoaded(Network network);
  void useCalibrated(const std::shared_ptr<const CalibratedNetwork>& calibrated, const std::string& file);
  [[nodiscard]] bool namedBySettings() const;
  [[nodiscard]] bool fileInUse() const { return inUse_.decoder && inUse_.file == wantedFile_; }

  Network inUse_, before_;
  std::string wantedFile_; ///< of the settings
  std::shared_ptr<const CalibratedNetwork> wantedCalibrated_;
  bool requested_ = false;
  bool anotherProject_ = false; ///< the network that is being read is the first one of a project
  JobRunner loader_;
};

} // namespace palp
