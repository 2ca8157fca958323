#include "app/gui/network/TrainedNetworks.h"

#include "app/gui/network/FitWords.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>

namespace palp {

namespace {

constexpr int kMadeRole = Qt::UserRole; ///< of a row: when its network was made

} // namespace

TrainedNetworks::TrainedNetworks(QWidget* parent) : QWidget(parent) {
  list_ = new QTreeWidget;
  list_->setObjectName("trainedNetworks");
  list_->setAccessibleName(tr("Trained networks"));
  list_->setRootIsDecorated(false);
  list_->setAlternatingRowColors(true);
  list_->setHeaderLabels({tr("When"), tr("RMSE in % of range, Fx / Fy / Fz"), tr("Samples"), tr("How")});
  list_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  list_->setToolTip(tr("Enter or a double click goes back to a network, with the settings it was trained with"));
  back_ = new QPushButton(tr("Go back to this one"));
  back_->setObjectName("goBack");
  back_->setToolTip(tr("Shows the network again and sets the panel as it was; can be undone"));
  away_ = new QPushButton(tr("Take away"));
  away_->setObjectName("takeAway");
  away_->setToolTip(tr("Takes the network off the list; the one that is shown stays shown"));
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(back_);
  buttons->addWidget(away_);
  buttons->addStretch(1);
  auto* column = new QVBoxLayout(this);
  column->addWidget(list_, 1);
  column->addLayout(buttons);
  connect(list_, &QTreeWidget::itemActivated, this, &TrainedNetworks::ask);
  connect(list_, &QTreeWidget::currentItemChanged, this, &TrainedNetworks::enableButtons);
  connect(back_, &QPushButton::clicked, this, &TrainedNetworks::ask);
  connect(away_, &QPushButton::clicked, this, [this] {
    if (chosen() >= 0) emit takeAwayAsked(static_cast<std::size_t>(chosen()));
  });
  enableButtons();
}

int TrainedNetworks::chosen() const {
  return list_->indexOfTopLevelItem(list_->currentItem());
}

void TrainedNetworks::ask() {
  if (chosen() >= 0) emit goBackAsked(static_cast<std::size_t>(chosen()));
}

void TrainedNetworks::enableButtons() {
  for (QPushButton* button : {back_, away_}) button->setEnabled(chosen() >= 0);
}

void TrainedNetworks::display(const NetworkSession& session) {
  const QDateTime before =
      list_->currentItem() != nullptr ? list_->currentItem()->data(0, kMadeRole).toDateTime() : QDateTime();
  list_->clear();
  for (const auto& fit : session.kept()) {
    const QString file = fit->file.isEmpty() ? QString() : tr("%1: ").arg(QFileInfo(fit->file).fileName());
    auto* item = new QTreeWidgetItem(
        list_,
        {QLocale().toString(fit->made, "d MMM HH:mm:ss"), triple(fit->error.error.rmsePercentOfRange, "%"),
         tr("%1 an area, seed %2").arg(fit->madeFrom.perArea).arg(fit->madeFrom.seed), file + originWords(*fit)});
    QFont font = item->font(0);
    font.setBold(fit.get() == session.fit());
    for (int column = 0; column < list_->columnCount(); ++column) {
      item->setFont(column, font);
      item->setToolTip(column, item->text(column));
    }
    item->setData(0, kMadeRole, fit->made);
    if (before.isValid() && fit->made == before) list_->setCurrentItem(item); // the network, wherever it stands now
  }
  enableButtons();
}

} // namespace palp
