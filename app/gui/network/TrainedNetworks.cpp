#include "app/gui/network/TrainedNetworks.h"

#include "app/gui/network/NetworkTables.h"
#include "app/gui/network/words/FitWords.h"
#include "app/gui/views/DataTable.h"
#include "app/gui/widgets/MakeWidgets.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QShortcut>
#include <QVBoxLayout>

#include <algorithm>

namespace palp {

TrainedNetworks::TrainedNetworks(QWidget* parent) : QWidget(parent) {
  words_ = textLabel("trainedWords", "hint");
  list_ = new DataTable("networks.csv");
  list_->setObjectName("trainedNetworks");
  list_->setAccessibleName(tr("Trained networks"));
  list_->setSelectionBehavior(QAbstractItemView::SelectRows);
  list_->setAlternatingRowColors(true);
  list_->setToolTip(tr("Enter or a double click restores a network with its training settings, F2 names it, a click on "
                       "a column head sorts, and a right click saves the list as CSV."));
  back_ = pushButton(
      tr("Restore"), "goBack",
      tr("Shows the selected network again with its settings, and its design if that has changed; this can be undone"));
  away_ = pushButton(tr("Remove"), "takeAway",
                     tr("Removes the selected networks from the list; the network shown stays shown"));
  return_ =
      pushButton(tr("Undo remove"), "bringBack", tr("Returns the networks removed last to their place in the list"));
  name_ =
      lineEdit("networkName",
               tr("Name in the list, saved with the project; a network with a name is never dropped from the list"));
  name_->setMaxLength(80);
  name_->setPlaceholderText(tr("Name of the selected network (F2)"));
  auto* nameWords = new QLabel(tr("Name"));
  nameWords->setBuddy(name_);
  auto* buttons = inRow({back_, away_, return_, nameWords, {name_, 1}});
  auto* column = new QVBoxLayout(this);
  addTo(*column, {words_, {list_, 1}, buttons});
  connect(list_, &DataTable::itemActivated, this, &TrainedNetworks::ask);
  connect(list_, &DataTable::currentCellChanged, this, [this](int row, int, int before, int) {
    if (row != before) displayChosen();
  });
  connect(back_, &QPushButton::clicked, this, &TrainedNetworks::ask);
  connect(list_, &DataTable::itemSelectionChanged, this, &TrainedNetworks::displayAway);
  connect(away_, &QPushButton::clicked, this, [this] { emit removeRequested(marked()); });
  connect(return_, &QPushButton::clicked, this, &TrainedNetworks::bringBackRequested);
  connect(name_, &QLineEdit::editingFinished, this, &TrainedNetworks::askName);
  connect(name_, &QLineEdit::returnPressed, list_, [this] { list_->setFocus(); });
  auto* keys = new QShortcut(Qt::Key_F2, list_);
  keys->setContext(Qt::WidgetShortcut);
  connect(keys, &QShortcut::activated, name_, [this] { name_->setFocus(Qt::ShortcutFocusReason); });
  displayChosen();
  displayAway();
}

int TrainedNetworks::chosen() const {
  return list_->dataRow(list_->currentRow());
}

std::set<std::size_t> TrainedNetworks::marked() const {
  std::set<std::size_t> rows;
  for (const QModelIndex& row : list_->selectionModel()->selectedRows())
    rows.insert(static_cast<std::size_t>(list_->dataRow(row.row())));
  return rows;
}

/// Shows how many will be removed before it happens.
void TrainedNetworks::displayAway() {
  const std::size_t count = marked().size();
  away_->setText(count > 1 ? tr("Remove %1").arg(count) : tr("Remove"));
  away_->setEnabled(count > 0);
}

void TrainedNetworks::ask() {
  if (chosen() >= 0) emit goBackRequested(static_cast<std::size_t>(chosen()));
}

void TrainedNetworks::askName() {
  if (chosen() >= 0 && name_->isModified())
    emit nameRequested(static_cast<std::size_t>(chosen()), name_->text().simplified());
  name_->setModified(false);
}

void TrainedNetworks::displayChosen() {
  for (QWidget* one : std::initializer_list<QWidget*>{back_, name_}) one->setEnabled(chosen() >= 0);
  const auto row = static_cast<std::size_t>(chosen());
  name_->setText(chosen() >= 0 && row < shown_.size() ? shown_[row].second : QString());
}

void TrainedNetworks::display(const NetworkSession& session) {
  const auto marked = static_cast<std::size_t>(std::max(0, chosen()));
  const QDateTime before = chosen() >= 0 && marked < shown_.size() ? shown_[marked].first : QDateTime();
  const QString typed = name_->isModified() ? name_->text() : QString();
  shown_.clear();
  int now = -1;
  for (const auto& fit : session.kept()) {
    if (fit->made == before) now = static_cast<int>(shown_.size()); // the network, whatever its row is now
    shown_.emplace_back(fit->made, fit->name);
  }
  return_->setEnabled(session.canBringBack());
  const TableText table = networksTable(session.kept());
  list_->show(table.heads, table.rows);
  const bool old = !session.upToDate();
  for (int row = 0; row < list_->rowCount(); ++row) {
    const NetworkFit& fit = *session.kept()[static_cast<std::size_t>(list_->dataRow(row))];
    const QString origin = originWords(fit);
    for (int column = 0; column < list_->columnCount(); ++column) {
      list_->item(row, column)->setToolTip(origin);
      if (old) list_->item(row, column)->setForeground(palette().color(QPalette::PlaceholderText));
    }
    if (!old && session.fit() != nullptr && fit.made == session.fit()->made) list_->mark(list_->dataRow(row));
  }
  if (now >= 0)
    list_->setCurrentCell(list_->shownRow(now), std::max(0, list_->currentColumn()));
  else
    list_->setCurrentCell(-1, -1);
  displayChosen();
  displayAway();
  if (now >= 0 && !typed.isEmpty()) { // what is being typed stays
    name_->setText(typed);
    name_->setModified(true);
  }
  words_->setText(old && !session.kept().empty()
                      ? tr("These belong to an earlier design; restoring one restores its design, too.")
                      : tr("All trained networks except those of sweeps and comparisons, which have their own tables; "
                           "duplicates are listed once. The last %1 are kept, and all that have a name. Fx, Fy, Fz: "
                           "test RMSE in % of range. Bold: the network shown.")
                            .arg(NetworkSession::kKeptNetworks));
}

} // namespace palp
