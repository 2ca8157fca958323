#pragma once

#include "io/ImportDraft.h"

#include <QWidget>

#include <array>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLayout;
class QLineEdit;
class QSpinBox;
class QStackedWidget;

namespace palp {

/// What holds for all readings, forces, positions and times of a table: kinds, units, signs.
class ImportOptions : public QWidget {
  Q_OBJECT

public:
  explicit ImportOptions(QWidget* parent = nullptr);

  /// Emits nothing.
  void display(const ImportDraft& draft);

signals:
  /// By the user's hand only.
  void edited(const palp::ImportDraft& draft);

private:
  QLayout* readingsRow();
  QLayout* forcesRow();
  QLayout* othersRow();
  void read();
  [[nodiscard]] bool has(std::initializer_list<ColumnMeaning> meanings) const;

  ImportDraft draft_;
  QComboBox* kind_ = nullptr;
  QStackedWidget* law_ = nullptr; ///< the fields of the kind
  QLineEdit* signalUnit_ = nullptr;
  QComboBox* resistanceUnit_ = nullptr;
  QDoubleSpinBox *ohmPerCode_ = nullptr, *zero_ = nullptr, *fullScale_ = nullptr, *resistor_ = nullptr;
  QSpinBox* rowWires_ = nullptr;
  QComboBox *forceUnit_ = nullptr, *positionUnit_ = nullptr, *timeUnit_ = nullptr;
  std::array<QCheckBox*, 3> inverted_{};
  QCheckBox *degrees_ = nullptr, *badRows_ = nullptr;
  QSpinBox *areas_ = nullptr, *firstArea_ = nullptr;
  bool displaying_ = false;
};

} // namespace palp
