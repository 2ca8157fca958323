#pragma once

#include "app/gui/live/LiveHost.h"
#include "app/study/live/LabelledFrames.h"

#include <QWidget>

class QLabel;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QTableWidget;

namespace palp {

class KnownLoad;

/// Labelled frames of the board: collected under known loads, or from a file; the network refined with them.
class LiveCalibration : public QWidget {
  Q_OBJECT

public:
  explicit LiveCalibration(LiveHost& host, QWidget* parent = nullptr);

  /// Takes the frames of the last look.
  void take();
  [[nodiscard]] const LabelledFrames& frames() const { return frames_; }
  [[nodiscard]] const std::optional<Calibration>& calibration() const { return calibration_; }
  [[nodiscard]] JobRunner& runner() { return runner_; }
  /// Saves frames and networks, in the order of the requests.
  [[nodiscard]] JobRunner& writer() { return writer_; }
  /// The labelled frames of the project, in place of those that are here where they are others.
  void display(const std::shared_ptr<const BoardFrames>& frames);
  /// The frames that are here, as a project keeps them; null: none.
  [[nodiscard]] const std::shared_ptr<const BoardFrames>& shown() const { return shown_; }
  /// The refined network of a project that was left.
  void forgetFit();
  /// Frames that are in no file of samples.
  [[nodiscard]] int unsavedFrames() const { return unsaved_ ? static_cast<int>(frames_.samples().size()) : 0; }
  /// The network in use, the one that can be restored, and the present decoded force.
  void displayState();

signals:
  void message(const QString& sentence);
  /// By the user: shown().
  void framesEdited();
  /// The simulated board is to bear this load.
  void simulatedLoadRequested(const palp::KnownTouch& load);

private:
  QWidget* buildLabel();
  QWidget* buildFrames();
  QWidget* buildFit();
  void load(const std::filesystem::path& file);
  void saveFrames(const QString& file);
  void saveNetwork(const QString& file);
  void collect();
  [[nodiscard]] bool mayCollect();
  [[nodiscard]] bool mayUse();
  void displayFrames();
  void tellFrames();
  void fit();
  void displayFit();
  void use();
  void guarded(const std::function<void()>& act);
  void complain(const QString& sentence);

  LiveHost& host_;
  LabelledFrames frames_;
  std::shared_ptr<const BoardFrames> shown_;
  bool unsaved_ = false;
  double newest_s_ = 0; ///< host clock of the newest frame; 0: none collected here
  /// When the file that was read last was written.
  std::optional<std::filesystem::file_time_type> written_;
  std::optional<Calibration> calibration_;
  Eigen::MatrixXd fitted_ohm_; ///< of the frames that it was made from, one a column
  KnownLoad* known_ = nullptr;
  QSpinBox* count_ = nullptr;
  QPushButton* collect_ = nullptr;
  QProgressBar* progress_ = nullptr;
  QTableWidget* table_ = nullptr;
  QPushButton* remove_ = nullptr;
  QPushButton* saveFrames_ = nullptr;
  QPushButton* fit_ = nullptr;
  QPushButton* use_ = nullptr;
  QPushButton* back_ = nullptr;
  QLabel* problem_ = nullptr;
  QPushButton* saveNetwork_ = nullptr;
  QLabel* report_ = nullptr;
  JobRunner runner_;
  JobRunner writer_{JobRunner::Orders::Each};
};

} // namespace palp
