#pragma once

#include "app/gui/project/Project.h"
#include "app/study/decoding/TrainOptionTable.h"

#include <QWidget>

#include <deque>

class QCheckBox;
class QFormLayout;
class QToolButton;

namespace palp {

/// The options of `palp train` that follow from the mode unless they are set: one field for each row of
/// trainOptionTable() that is in the form. Collapsed until the user asks for them.
class AdvancedOptions : public QWidget {
  Q_OBJECT

public:
  explicit AdvancedOptions(QWidget* parent = nullptr);

  /// Emits nothing. Expands where something is set.
  void display(const NetworkSettings& network);
  /// Writes the values of the fields into the settings.
  void read(NetworkSettings& network) const;

signals:
  /// By the user only.
  void edited(const QString& what);

private:
  struct Field {
    const TrainOption* option;
    QWidget* widget; ///< combo box of a choice; line edit of a number that may be unset; otherwise a spin box
    QString shown;   ///< in the line edit
  };

  void addField(QFormLayout& form, const TrainOption& option);
  [[nodiscard]] QWidget* fieldWidget(Field& field);
  void report(const QString& what);
  void fold(bool open);
  void showMode(const NetworkSettings& network);

  bool displaying_ = false;
  QToolButton* more_ = nullptr;
  QWidget* options_ = nullptr;
  std::deque<Field> fields_; ///< validators refer to their entries
  QCheckBox* allCenters_ = nullptr;
};

} // namespace palp
