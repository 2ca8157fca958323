#pragma once

#include "app/gui/project/Project.h"

#include <QWidget>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLineEdit;
class QSpinBox;
class QToolButton;

namespace palp {

/// The options of `palp train` that follow from the mode unless they are set, folded away until asked for.
class AdvancedOptions : public QWidget {
  Q_OBJECT

public:
  explicit AdvancedOptions(QWidget* parent = nullptr);

  /// Emits nothing. Unfolds where something is set.
  void display(const NetworkSettings& network);
  /// Puts what is chosen here into the settings.
  void read(NetworkSettings& network) const;

signals:
  /// By the user's hand only.
  void edited(const QString& what);

private:
  QComboBox* choice(QFormLayout& form, const QString& label, const char* name, const QString& tip,
                    const std::vector<std::string>& values);
  void fold(bool open);
  void showMode(const NetworkSettings& network);
  void enableFor(DecoderKind decoder);

  bool displaying_ = false;
  QToolButton* more_ = nullptr;
  QWidget* options_ = nullptr;
  QComboBox* solver_ = nullptr;
  QComboBox* scaler_ = nullptr;
  QComboBox* tail_ = nullptr;
  QComboBox* convention_ = nullptr;
  QComboBox* centersBy_ = nullptr;
  QCheckBox* allCenters_ = nullptr;
  QString ridgeShown_;
  QLineEdit* ridge_ = nullptr;
  QSpinBox* seed_ = nullptr;
  QDoubleSpinBox* forgetting_ = nullptr;
};

} // namespace palp
