#pragma once

#include "app/gui/project/Project.h"
#include "app/gui/widgets/FieldBindings.h"

#include <QWidget>

#include <optional>

class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QSlider;
class QVBoxLayout;

namespace palp {

class AdvancedOptions;
class SamplesBox;
class WrappedLabel;

/// Samples, training options, spread and sweep.
class NetworkPanel : public QWidget {
  Q_OBJECT

public:
  explicit NetworkPanel(QWidget* parent = nullptr);

  /// Emits nothing.
  /// `rowWires`: of the samples, or else of the design.
  void display(const Project& project, int rowWires);
  /// What there is to work with, and the state of the samples as text.
  void displaySamples(bool there, const QString& words, bool goOn);
  /// Whether networks can be trained: there are samples, and none are being made.
  void displayReadiness(bool there, bool beingMade);

  /// The spread that leave-one-out chose for the network that is shown; 0: none.
  void displayChosenSpread(double spread);
  /// While an edit of the slider is reported: which of its movements; empty: it is another edit.
  [[nodiscard]] QString slide() const { return sliding_ ? QString::number(slides_) : QString(); }

signals:
  /// By the user's hand only.
  void edited(const QString& what, const palp::SampleSettings& samples, const palp::NetworkSettings& network);
  void generateRequested();
  void openSamplesRequested();
  void importRequested();
  void saveSamplesRequested();
  void trainRequested();
  void sweepRequested();
  void compareRequested();

private:
  void buildSamples(QVBoxLayout& column);
  void buildTraining(QVBoxLayout& column);
  void buildInput(QFormLayout& form);
  void buildNetwork(QFormLayout& form);
  void buildSpread(QFormLayout& form);
  void buildSweep(QVBoxLayout& column);
  QDoubleSpinBox* addSpread(const QString& id, const QString& what, double NetworkSettings::*spread);
  void readRows();
  void showRowsProblem(const QString& sentence);
  void showSpread();
  void showNoise();
  void takeLiveSettings();

  FieldBindings<NetworkSettings> fields_;
  bool sliding_ = false;
  int slides_ = 0; ///< another one after each press of the slider and each other edit
  SamplesBox* samplesBox_ = nullptr;
  QPushButton* forLive_ = nullptr;
  QComboBox* target_ = nullptr;
  std::optional<DecoderTarget> targetBefore_; ///< the decoder of touches was chosen, which learns both
  QLineEdit* rows_ = nullptr;
  WrappedLabel* rowsProblem_ = nullptr;
  WrappedLabel* rowsHint_ = nullptr;
  int rowWires_ = 0; ///< that can be chosen from
  double boardNoise_ = 0;
  QCheckBox* automatic_ = nullptr;
  QDoubleSpinBox* spread_ = nullptr;
  QSlider* spreadSlider_ = nullptr;
  QPushButton* paper_ = nullptr;
  WrappedLabel* noiseWords_ = nullptr;
  QSpinBox* centers_ = nullptr;
  AdvancedOptions* advanced_ = nullptr;
  QPushButton* train_ = nullptr;
  QPushButton* sweep_ = nullptr;
  QPushButton* compare_ = nullptr;
};

} // namespace palp
