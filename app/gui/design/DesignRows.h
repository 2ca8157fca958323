#pragma once

#include "app/gui/design/DesignFields.h"

#include <functional>
#include <vector>

class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QWidget;

namespace palp {

class WrappedLabel;

/// A sentence in red that takes no room while there is none.
WrappedLabel* problemLabel();

/// Marked with a red frame.
void markWrong(QLineEdit& edit, bool wrong);

/// Rows of a panel, one a parameter of the design; what is wrong with one, or not in use, is shown under it.
class DesignRows {
public:
  /// `edited` is called by the user's hand alone.
  void add(const DesignField& field, QFormLayout& form, const std::function<void()>& edited);

  /// Rows that say the same already are left as they are written; so are those that the design does not have.
  void display(const SensorDesign& design);
  /// Sets what is written, of the keys that begin with `keys`; false where something is not a value.
  bool read(SensorDesign& design, const QString& keys = {});
  /// Shows what was wrong at read() and these faults under their rows; in use is what the design has.
  void say(const std::vector<DesignFault>& faults, const SensorDesign& inUse, bool applied);
  /// Hides the rows that the design does not have.
  void showThoseOf(const SensorDesign& design);

private:
  struct Row {
    const DesignField* field = nullptr;
    QLabel* label = nullptr;
    QLineEdit* edit = nullptr; ///< one of these two
    QComboBox* choice = nullptr;
    WrappedLabel* problem = nullptr;
    QString wrong = {}; ///< at the last read()

    [[nodiscard]] QString words() const;
    [[nodiscard]] QWidget* widget() const;
  };

  std::vector<Row> rows_;
};

} // namespace palp
