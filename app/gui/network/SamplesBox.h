#pragma once

#include "app/gui/project/Project.h"

#include <QGroupBox>

#include <array>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QPushButton;
class QSpinBox;

namespace palp {

class WrappedLabel;

/// Which samples are made, of forces on areas or of touches by an indenter; opens and saves them.
class SamplesBox : public QGroupBox {
  Q_OBJECT

public:
  explicit SamplesBox(QWidget* parent = nullptr);

  /// Emits nothing.
  void display(const SampleSettings& samples, const SensorDesign& design, const MeshOptions& mesh);
  /// Whether there are some, their state in words, and whether a generation goes on where it was stopped.
  void displayState(bool there, const QString& words, bool goOn);
  [[nodiscard]] const SampleSettings& settings() const { return samples_; }

signals:
  /// By the user's hand only.
  void edited(const QString& what);
  void generateAsked();
  void openAsked();
  void saveAsked();

private:
  using Pair = std::array<QDoubleSpinBox*, 2>;
  void buildTouches();
  void buildFiles();
  QDoubleSpinBox* number(const char* name, const QString& label, double low, double high, const QString& unit);
  Pair range(const char* name, const QString& label, double high, const QString& unit, const QString& tip);
  void read(const QString& what);
  void readKind();
  void showTouches();
  void check();

  SampleSettings samples_;
  TouchSampling touches_; ///< while forces on areas are chosen: those of before
  SensorDesign design_;
  MeshOptions mesh_;
  bool displaying_ = false;
  QFormLayout* form_ = nullptr;
  QComboBox* kind_ = nullptr;
  QLabel* countLabel_ = nullptr;
  QSpinBox* perArea_ = nullptr;
  QSpinBox* count_ = nullptr;
  QComboBox* shape_ = nullptr;
  Pair radius_{}, press_{}, friction_{};
  QDoubleSpinBox* rim_ = nullptr;
  QDoubleSpinBox* margin_ = nullptr;
  QLabel* problem_ = nullptr;
  QSpinBox* seed_ = nullptr;
  QCheckBox* surrogate_ = nullptr;
  WrappedLabel* planned_ = nullptr;
  QPushButton* generate_ = nullptr;
  QPushButton* save_ = nullptr;
  QLabel* words_ = nullptr;
};

} // namespace palp
