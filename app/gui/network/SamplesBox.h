#pragma once

#include "app/gui/project/Project.h"
#include "app/gui/widgets/FieldBindings.h"
#include "app/gui/widgets/MakeWidgets.h"

#include <QGroupBox>

class QFormLayout;
class QLabel;
class QPushButton;

namespace palp {

class WrappedLabel;

/// Which samples are made, of forces on areas or of touches by an indenter; opens and saves them.
class SamplesBox : public QGroupBox {
  Q_OBJECT

public:
  explicit SamplesBox(QWidget* parent = nullptr);

  /// Emits nothing.
  void display(const SampleSettings& samples, const SensorDesign& design, const MeshOptions& mesh);
  /// Whether there are some, their state as text, and whether a generation continues where it was stopped.
  void displayState(bool there, const QString& words, bool goOn);
  [[nodiscard]] const SampleSettings& settings() const { return fields_.settings(); }

signals:
  /// By the user's hand only.
  void edited(const QString& what);
  void generateRequested();
  void openRequested();
  void importRequested();
  void saveRequested();

private:
  template <class Value> auto of(Value TouchSampling::*member);
  void buildTouches();
  void buildFiles();
  QWidget* range(const char* name, const QString& label, NumberForm form, double TouchSampling::*least,
                 double TouchSampling::*most, const QString& tip);
  void readKind();
  void check();

  FieldBindings<SampleSettings> fields_;
  TouchSampling touches_; ///< as they were set last, also while forces on areas are sampled
  SensorDesign design_;
  MeshOptions mesh_;
  QFormLayout* form_ = nullptr;
  QComboBox* kind_ = nullptr;
  QLabel* countLabel_ = nullptr;
  QSpinBox* perArea_ = nullptr;
  QSpinBox* count_ = nullptr;
  QComboBox* shape_ = nullptr;
  QWidget *radius_ = nullptr, *press_ = nullptr, *friction_ = nullptr; ///< rows with minimum and maximum
  QDoubleSpinBox* rim_ = nullptr;
  QDoubleSpinBox* margin_ = nullptr;
  QLabel* problem_ = nullptr;
  QCheckBox* surrogate_ = nullptr;
  WrappedLabel* planned_ = nullptr;
  QPushButton* generate_ = nullptr;
  QPushButton* save_ = nullptr;
  QLabel* words_ = nullptr;
};

} // namespace palp
