#pragma once

#include "app/gui/project/Workbench.h"

#include <QWidget>

class QLabel;
class QPushButton;
class QTableWidget;

namespace palp {

/// The steps of an indenter after its load as rows of numbers, and what was found at each: force, contact and slip.
class PathPanel : public QWidget {
  Q_OBJECT

public:
  explicit PathPanel(Workbench& workbench, QWidget* parent = nullptr);

  /// Makes steps of a line that was drawn over the top face from an indenter. One that is pressed by a force is moved
  /// from then on, as deep as the force has pressed it.
  void draw(int indenter, const Eigen::Matrix2Xd& way_mm);

signals:
  void message(const QString& sentence);

protected:
  void showEvent(QShowEvent* event) override;

private:
  void display();
  void displayFound();
  void addStep();
  void takeAway();
  void clear();
  void save();
  void readCell(int row, int column);
  void edit(const QString& what, const std::optional<IndenterPath>& path);
  /// Of the path, else the last of the load; null without indenters.
  [[nodiscard]] const Indenter* indenter() const;
  [[nodiscard]] int indenterNumber() const;

  Workbench& workbench_;
  bool displaying_ = false;
  QLabel* words_ = nullptr;
  QTableWidget* table_ = nullptr;
  QPushButton* add_ = nullptr;
  QPushButton* take_ = nullptr;
  QPushButton* clear_ = nullptr;
  QPushButton* save_ = nullptr;
};

} // namespace palp
