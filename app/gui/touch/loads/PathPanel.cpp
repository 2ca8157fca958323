#include "app/gui/touch/loads/PathPanel.h"

#include "app/gui/widgets/FileDialogs.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/SpinBoxes.h"
#include "io/AtomicFile.h"
#include "model/base/Error.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <array>
#include <cmath>

namespace palp {

namespace {

constexpr int kDrawnSteps = 8;
constexpr int kAroundLine_px = 8; ///< in a row of the table
constexpr int kPrescribedColumns = 3, kFoundColumns = 5;
constexpr double kUnknownDepth_mm = 0.2; ///< of a force that was not solved yet

std::array<double, 3> prescribedBy(const std::variant<Press, Motion>& control) {
  if (const Press* press = std::get_if<Press>(&control))
    return {press->force_N.x(), press->force_N.y(), press->force_N.z()};
  const Motion& motion = std::get<Motion>(control);
  return {motion.depth_mm, motion.shift_mm.x(), motion.shift_mm.y()};
}

std::variant<Press, Motion> controlOf(const std::array<double, 3>& told, bool pressed) {
  if (pressed) return Press{{told[0], told[1], told[2]}};
  return Motion{told[0], {told[1], told[2]}};
}

/// What the indenters do at the end of a load of the path; null where that was not reached.
const IndenterState* stateAtEnd(const Solution* solution, int load, int indenter) {
  if (solution == nullptr) return nullptr;
  for (const LoadIncrement& state : solution->increments)
    if (std::abs(state.loadFraction - (load + 1)) < 1e-9 && static_cast<std::size_t>(indenter) < state.indenters.size())
      return &state.indenters[static_cast<std::size_t>(indenter)];
  return nullptr;
}

} // namespace

PathPanel::PathPanel(Workbench& workbench, QWidget* parent) : QWidget(parent), workbench_(workbench) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(4, 4, 4, 4);
  words_ = textLabel("pathHint");
  column->addWidget(words_);
  table_ = new QTableWidget;
  table_->setObjectName("pathSteps");
  table_->setAccessibleName(tr("Steps of the path"));
  table_->setToolTip(tr(
      "Double click a number to change it; the columns at the right show the computed values at the end of each step"));
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->verticalHeader()->hide();
  table_->verticalHeader()->setDefaultSectionSize(table_->fontMetrics().height() + kAroundLine_px);
  column->addWidget(table_, 1);
  auto* row = new QHBoxLayout;
  const auto button = [&](const QString& text, const char* name, const QString& tip, void (PathPanel::*slot)()) {
    auto* made = pushButton(text, name, tip);
    connect(made, &QPushButton::clicked, this, slot);
    row->addWidget(made);
    return made;
  };
  add_ = button(tr("Add a step"), "addStep", tr("Adds a step after the last one, 1 mm further along x"),
                &PathPanel::addStep);
  take_ = button(tr("Remove"), "takeStep", tr("Removes the selected steps, or the last step if none is selected"),
                 &PathPanel::takeAway);
  clear_ = button(tr("Clear the path"), "clearPath", tr("Removes all steps; the load remains"), &PathPanel::clear);
  save_ = button(tr("Save as a load file..."), "savePath", tr("Saves load and steps as a file for palp solve --loads"),
                 &PathPanel::save);
  row->addStretch(1);
  column->addLayout(row);
  connect(table_, &QTableWidget::cellChanged, this, &PathPanel::readCell);
  connect(&workbench_, &Workbench::projectChanged, this, &PathPanel::display);
  connect(&workbench_.touch(), &TouchSession::changed, this, &PathPanel::displayFound);
  display();
}

void PathPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  display();
}

int PathPanel::indenterNumber() const {
  const Project& project = workbench_.project();
  return project.path ? project.path->indenter : static_cast<int>(project.load.indenters.size()) - 1;
}

const Indenter* PathPanel::indenter() const {
  const int k = indenterNumber();
  const auto& all = workbench_.project().load.indenters;
  return k >= 0 && static_cast<std::size_t>(k) < all.size() ? &all[static_cast<std::size_t>(k)] : nullptr;
}

void PathPanel::edit(const QString& what, const std::optional<IndenterPath>& path) {
  Project next = workbench_.project();
  next.path = path && !path->steps.empty() ? path : std::nullopt;
  workbench_.closeEntry();
  workbench_.edit(what, next);
}

void PathPanel::draw(int indenter, const Eigen::Matrix2Xd& way_mm) {
  Project next = workbench_.project();
  if (indenter < 0 || static_cast<std::size_t>(indenter) >= next.load.indenters.size()) return;
  Indenter& its = next.load.indenters[static_cast<std::size_t>(indenter)];
  QString words;
  if (its.press() != nullptr) {
    const IndenterState* pressed = stateAtEnd(workbench_.touch().touch().solution(), 0, indenter);
    const double depth = pressed != nullptr ? -pressed->translation_mm.z() : kUnknownDepth_mm;
    its.control = Motion{std::max(0.001, std::round(1000 * depth) / 1000)};
    words = tr(" It is now displacement-controlled at the depth reached: %1 mm.").arg(its.motion()->depth_mm);
  }
  IndenterPath path{indenter, stepsAlong(way_mm, *its.motion(), kDrawnSteps)};
  if (path.steps.empty()) {
    emit message(tr("Too short for a path: at least 0.25 mm is needed."));
    return;
  }
  emit message(tr("Indenter %1 slides along a path of %2 steps.").arg(indenter).arg(path.steps.size()) + words);
  next.path = std::move(path);
  workbench_.closeEntry();
  workbench_.edit(tr("Draw a path of indenter %1").arg(indenter), next);
}

void PathPanel::addStep() {
  const Indenter* its = indenter();
  if (its == nullptr) return;
  IndenterPath path = workbench_.project().path.value_or(IndenterPath{indenterNumber(), {}});
  if (path.steps.size() >= kMostPathSteps) return;
  std::variant<Press, Motion> next = path.steps.empty() ? its->control : path.steps.back();
  if (Motion* motion = std::get_if<Motion>(&next)) motion->shift_mm.x() += 1;
  path.steps.push_back(next);
  edit(tr("Add a step to the path"), path);
}

void PathPanel::takeAway() {
  IndenterPath path = workbench_.project().path.value_or(IndenterPath{});
  std::vector<int> rows;
  for (const QModelIndex& index : table_->selectionModel()->selectedRows())
    if (index.row() > 0) rows.push_back(index.row());
  if (rows.empty()) rows.push_back(static_cast<int>(path.steps.size()));
  std::sort(rows.rbegin(), rows.rend());
  for (const int row : rows)
    if (row > 0 && row <= static_cast<int>(path.steps.size())) path.steps.erase(path.steps.begin() + row - 1);
  edit(tr("Remove steps of the path"), path);
}

void PathPanel::clear() {
  edit(tr("Clear the path"), {});
}

void PathPanel::save() {
  const Project& project = workbench_.project();
  const QString file = askFileToSave(this, tr("Save as a load file"), "path.json", tr("Load files (*.json)"));
  if (file.isEmpty() || !project.path) return;
  try {
    writeFile(file.toStdString(), loadFile(project.load, *project.path, project.design), true);
    emit message(tr("Wrote %1; use it with palp solve sensor.json --loads %1.").arg(file));
  } catch (const Error& error) {
    emit message(QString::fromStdString(error.what()));
  }
}

void PathPanel::readCell(int row, int column) {
  std::optional<IndenterPath> path = workbench_.project().path;
  if (displaying_ || !path || row < 1 || column < 1 || column > kPrescribedColumns) return;
  auto& step = path->steps[static_cast<std::size_t>(row - 1)];
  std::array<double, 3> told = prescribedBy(step);
  const auto typed = typedNumber(table_->item(row, column)->text());
  const std::variant<Press, Motion> before = step;
  if (typed) {
    told[static_cast<std::size_t>(column - 1)] = *typed;
    step = controlOf(told, std::holds_alternative<Press>(step));
  }
  const Project& project = workbench_.project();
  const auto wrong = typed ? whyInvalid(project.load, *path, project.design) : std::nullopt;
  if (!typed || wrong) {
    const QString typedText = table_->item(row, column)->text();
    display(); // what holds
    words_->setText(
        typed ? tr("Not applied: %1").arg(QString::fromStdString(*wrong))
              : tr("Not applied: \"%1\" is not a number; use a decimal point, for example 0.5").arg(typedText));
    return;
  }
  edit(tr("Change step %1 of the path").arg(row), path);
}

void PathPanel::display() {
  if (!isVisible()) return;
  displaying_ = true;
  const Project& project = workbench_.project();
  const Indenter* its = indenter();
  const bool pressed = its != nullptr && its->press() != nullptr;
  const int steps = project.path ? static_cast<int>(project.path->steps.size()) : 0;
  words_->setText(
      its == nullptr ? tr("An indenter can slide along a path: press with an indenter first (tool Indenter, key I).")
      : steps == 0   ? tr("No path yet: with the tool Indenter, hold Ctrl and drag from the indenter over the "
                            "face, or add steps here.")
                     : tr("Path of indenter %1 after its load (step 0). Play it above; colour the block by contact "
                            "pressure, shear, or shear / pressure: slipping contact has the coefficient of friction, %2.")
                         .arg(indenterNumber())
                         .arg(its->friction));
  QStringList heads{tr("step")};
  heads << (pressed ? QStringList{tr("Fx [N]"), tr("Fy [N]"), tr("Fz [N]")}
                    : QStringList{tr("depth [mm]"), tr("shift x [mm]"), tr("shift y [mm]")});
  heads << tr("computed Fx [N]") << tr("Fy [N]") << tr("Fz [N]") << tr("contact radius [mm]")
        << tr("slipping area [%]");
  table_->setColumnCount(static_cast<int>(heads.size()));
  table_->setHorizontalHeaderLabels(heads);
  table_->setRowCount(its == nullptr ? 0 : 1 + steps);
  for (int row = 0; row < table_->rowCount(); ++row) {
    const std::array<double, 3> told =
        prescribedBy(row == 0 ? its->control : project.path->steps[static_cast<std::size_t>(row - 1)]);
    for (int column = 0; column < table_->columnCount(); ++column) {
      auto* cell = new QTableWidgetItem;
      const bool editable = row > 0 && column > 0 && column <= kPrescribedColumns;
      if (!editable) cell->setFlags(cell->flags() & ~Qt::ItemIsEditable);
      cell->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      if (column == 0) cell->setText(QString::number(row));
      if (column > 0 && column <= kPrescribedColumns)
        cell->setText(QString::number(told[static_cast<std::size_t>(column - 1)], 'g', 6));
      table_->setItem(row, column, cell);
    }
  }
  add_->setEnabled(its != nullptr && steps < static_cast<int>(kMostPathSteps));
  for (QPushButton* each : {take_, clear_, save_}) each->setEnabled(steps > 0);
  displaying_ = false;
  displayFound();
}

void PathPanel::displayFound() {
  if (!isVisible() || table_->columnCount() <= kPrescribedColumns) return;
  displaying_ = true;
  const TouchSession& touch = workbench_.touch();
  const Solution* solution = touch.upToDate() ? touch.touch().solution() : nullptr;
  for (int row = 0; row < table_->rowCount(); ++row) {
    const IndenterState* found = stateAtEnd(solution, row, indenterNumber());
    for (int k = 0; k < kFoundColumns; ++k) {
      QString text;
      if (found != nullptr) {
        const std::array<double, kFoundColumns> values{found->force_N.x(), found->force_N.y(), found->force_N.z(),
                                                       found->contactRadius_mm, 100 * found->slipShare};
        const double value = values[static_cast<std::size_t>(k)];
        text = QString::number(k < 3 && std::abs(value) < 1e-6 * found->force_N.norm() ? 0 : value, 'g', 4);
      }
      table_->item(row, 1 + kPrescribedColumns + k)->setText(text);
    }
  }
  table_->resizeColumnsToContents();
  displaying_ = false;
}

} // namespace palp
