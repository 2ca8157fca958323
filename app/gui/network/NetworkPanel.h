#pragma once

#include "app/gui/project/Project.h"

#include <QWidget>

#include <optional>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QSlider;
class QSpinBox;
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
  /// What there is to work with, and the state of the samples in words.
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
  void generateAsked();
  void openSamplesAsked();
  void saveSamplesAsked();
  void trainAsked();
  void sweepAsked();
  void compareAsked();

private:
  void buildSamples(QVBoxLayout& column);
  void buildTraining(QVBoxLayout& column);
  void buildInput(QFormLayout& form);
  void buildNetwork(QFormLayout& form);
  void buildSpread(QFormLayout& form);
  void buildSweep(QVBoxLayout& column);
  void read(const QString& what);
  void readRows();
  void showRowsProblem(const QString& sentence);
  void showSpread();
  void showNoise();
  void takeLiveSettings();
  [[nodiscard]] bool readableLive() const;

  NetworkSettings network_;
  bool displaying_ = false;
  bool sliding_ = false;
  int slides_ = 0; ///< another one after each press of the slider and each other edit
  SamplesBox* samplesBox_ = nullptr;
  QComboBox* input_ = nullptr;
  QPushButton* forLive_ = nullptr;
  QComboBox* mode_ = nullptr;
  QComboBox* decoder_ = nullptr;
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
  QDoubleSpinBox* noise_ = nullptr;
  QDoubleSpinBox* testNoise_ = nullptr;
  AdvancedOptions* advanced_ = nullptr;
  QPushButton* train_ = nullptr;
  QDoubleSpinBox* from_ = nullptr;
  QDoubleSpinBox* to_ = nullptr;
  QSpinBox* count_ = nullptr;
  QPushButton* sweep_ = nullptr;
  QPushButton* compare_ = nullptr;
};

} // namespace palp
