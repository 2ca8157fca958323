#pragma once

#include "app/gui/project/Workbench.h"
#include "io/StudyFile.h"

#include <QWidget>

#include <optional>
#include <vector>

class QCheckBox;
class QComboBox;
class QLineEdit;
class QPushButton;
class QScrollArea;
class QSpinBox;
class QVBoxLayout;

namespace palp {

class WrappedLabel;

/// Asks for a study: which numbers of a design vary and over which values, and what is worked out of each design.
class StudyForm : public QWidget {
  Q_OBJECT

public:
  explicit StudyForm(Workbench& workbench, QWidget* parent = nullptr);

  /// The study as it is set, checked as a file of it is. Throws Error.
  [[nodiscard]] StudyPlan plan() const;
  /// Shows a study, with the design and the mesh that it holds.
  void show(const StudyPlan& plan);

  /// A study in this folder was stopped; its next run continues there, if the form is unchanged then.
  void goOnIn(const QString& folder) { unfinished_ = folder; }
  /// The folder of the study's run, its file within: the one it continues in, or a new one below `base`. Throws Error.
  [[nodiscard]] QString runFolder(const QString& base) const;

signals:
  /// Something was set.
  void changed();

private:
  struct Axis {
    QWidget* row = nullptr;
    QComboBox* key = nullptr;
    QLineEdit* values = nullptr;
  };

  void build();
  QWidget* buildAxes();
  QWidget* buildSettings();
  QWidget* buildQuantities();
  QWidget* buildResult();
  void addAxis(const QString& key, const QString& values);
  void removeAxis(const QWidget* row);
  /// Throws Error where its values are not a range or a list, or a comma of theirs is unclear.
  static StudyAxis typedAxis(const Axis& axis);
  void numberAxes();
  /// Ten per cent to both sides of what the design has.
  [[nodiscard]] QString proposal(const QString& key) const;
  [[nodiscard]] const SensorDesign& design() const;
  /// The keys of the study's base design.
  void listKeys();
  void check();
  void open();
  void save();
  void takeOver();

  Workbench& workbench_;
  std::optional<StudyPlan> opened_; ///< the file whose design and mesh may be used
  std::optional<SensorDesign> openedDesign_;
  QString unfinished_;
  SensorDesign listed_; ///< whose keys are offered
  bool showing_ = false;
  std::vector<Axis> axes_;
  QVBoxLayout* axesColumn_ = nullptr;
  QScrollArea* axesArea_ = nullptr;
  QComboBox* base_ = nullptr;
  QComboBox* plan_ = nullptr;
  QSpinBox* points_ = nullptr;
  QSpinBox* seed_ = nullptr;
  std::vector<QCheckBox*> quantities_; ///< in the order of kStudyQuantities
  QLineEdit* decoders_ = nullptr;
  QLineEdit* noise_ = nullptr;
  QSpinBox* perArea_ = nullptr;
  WrappedLabel* problem_ = nullptr;
  QWidget* result_ = nullptr;
  QSpinBox* chosen_ = nullptr;
  QPushButton* take_ = nullptr;
};

} // namespace palp
