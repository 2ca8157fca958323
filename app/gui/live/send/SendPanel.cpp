#include "app/gui/live/send/SendPanel.h"

#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/WrappedLabel.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

namespace palp {

namespace {

enum SendColumn { kTo, kSent, kDropped };
constexpr int kLines = 4; // of the list

/// What is typed; HOST:PORT alone goes by UDP.
std::string addressOf(const QString& typed) {
  static const QRegularExpression hostAndPort(R"(^[^:\s]+:\d+$)");
  return ((hostAndPort.match(typed).hasMatch() ? "udp:" : "") + typed).toStdString();
}

} // namespace

SendPanel::SendPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  head_ = new QToolButton;
  head_->setObjectName("sendForces");
  head_->setText(tr("Send forces to other programs"));
  head_->setToolTip(tr("Sends the forces of each frame by UDP, OSC, ZeroMQ or as CSV lines"));
  head_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  head_->setAutoRaise(true);
  head_->setCheckable(true);
  column->addWidget(head_);
  content_ = build();
  column->addWidget(content_);
  connect(head_, &QToolButton::toggled, this, &SendPanel::fold);
  fold(false);
}

QWidget* SendPanel::build() {
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, 0, 0);
  list_ = new QTreeWidget;
  list_->setObjectName("receivers");
  list_->setAccessibleName(tr("Receivers of the forces"));
  list_->setRootIsDecorated(false);
  list_->setHeaderLabels({tr("receiver"), tr("sent"), tr("dropped")});
  list_->header()->setStretchLastSection(false);
  list_->header()->setSectionResizeMode(kTo, QHeaderView::Stretch);
  list_->header()->setSectionResizeMode(kSent, QHeaderView::ResizeToContents);
  list_->header()->setSectionResizeMode(kDropped, QHeaderView::ResizeToContents);
  list_->setFixedHeight((kLines + 2) * list_->fontMetrics().lineSpacing());
  list_->setToolTip(tr("Ticked receivers get each frame. Frames that a receiver does not take in time are dropped; "
                       "nothing else is affected."));
  column->addWidget(list_);
  auto* row = new QHBoxLayout;
  address_ =
      lineEdit("receiver", tr("udp:HOST:PORT (JSON, for PlotJuggler), osc:HOST:PORT, zmq:HOST:PORT or csv:FILE"));
  address_->setPlaceholderText("udp:localhost:9870");
  add_ = pushButton(tr("Add"), "addReceiver");
  remove_ = pushButton(tr("Remove"), "removeReceiver");
  addTo(*row, {{address_, 1}, add_, remove_});
  column->addLayout(row);
  problem_ = wrappedLabel("sendProblem", "problem");
  column->addWidget(problem_);
  connect(add_, &QPushButton::clicked, this, &SendPanel::add);
  connect(address_, &QLineEdit::returnPressed, this, &SendPanel::add);
  connect(remove_, &QPushButton::clicked, this, &SendPanel::remove);
  connect(list_, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item, int) {
    const auto place = static_cast<std::size_t>(list_->indexOfTopLevelItem(item));
    std::vector<LiveReceiver> next = settings_.receivers;
    next[place].on = item->checkState(kTo) == Qt::Checked;
    next[place].heldBack = false;
    edit(tr("sending of forces"), next);
  });
  return content;
}

void SendPanel::fold(bool open) {
  content_->setVisible(open);
  head_->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
}

void SendPanel::add() {
  const QString typed = address_->text().trimmed();
  const std::string to = addressOf(typed.isEmpty() ? address_->placeholderText() : typed);
  std::vector<LiveReceiver> next = settings_.receivers;
  const auto same = std::find_if(next.begin(), next.end(), [&](const LiveReceiver& other) { return other.to == to; });
  if (same != next.end())
    *same = {to, true};
  else if (next.size() < LiveSettings::kMostReceivers)
    next.push_back({to, true});
  address_->clear();
  edit(tr("receiver of forces"), next);
}

void SendPanel::remove() {
  const int place = list_->indexOfTopLevelItem(list_->currentItem());
  if (place < 0) return;
  std::vector<LiveReceiver> next = settings_.receivers;
  next.erase(next.begin() + place);
  edit(tr("receiver removed"), next);
}

void SendPanel::edit(const QString& what, const std::vector<LiveReceiver>& receivers) {
  if (receivers == settings_.receivers) return;
  LiveSettings next = settings_;
  next.receivers = receivers;
  emit edited(what, next);
}

void SendPanel::display(const LiveSettings& settings) {
  const std::vector<LiveReceiver> before = std::exchange(settings_, settings).receivers;
  const auto heldBack = [](const LiveReceiver& receiver) { return receiver.heldBack; };
  const bool asks = std::any_of(settings.receivers.begin(), settings.receivers.end(), heldBack);
  if (asks && std::none_of(before.begin(), before.end(), heldBack)) head_->setChecked(true); // the question is seen
  const QSignalBlocker quiet(list_);
  // A click on a tick comes here while the list still works on that line: it stays where the addresses are the same.
  if (std::equal(before.begin(), before.end(), settings.receivers.begin(), settings.receivers.end(),
                 [](const LiveReceiver& a, const LiveReceiver& b) { return a.to == b.to; }) &&
      list_->topLevelItemCount() == static_cast<int>(settings.receivers.size())) {
    for (std::size_t k = 0; k < settings.receivers.size(); ++k)
      list_->topLevelItem(static_cast<int>(k))
          ->setCheckState(kTo, settings.receivers[k].on ? Qt::Checked : Qt::Unchecked);
    return;
  }
  const int current = list_->indexOfTopLevelItem(list_->currentItem());
  list_->clear();
  for (const LiveReceiver& receiver : settings.receivers) {
    auto* item = new QTreeWidgetItem(list_, {QString::fromStdString(receiver.to)});
    item->setToolTip(kTo, QString::fromStdString(receiver.to));
    item->setCheckState(kTo, receiver.on ? Qt::Checked : Qt::Unchecked);
    item->setTextAlignment(kSent, Qt::AlignRight);
    item->setTextAlignment(kDropped, Qt::AlignRight);
  }
  list_->setCurrentItem(list_->topLevelItem(std::min(current, list_->topLevelItemCount() - 1)));
  remove_->setEnabled(!settings.receivers.empty());
  add_->setEnabled(settings.receivers.size() < LiveSettings::kMostReceivers);
}

void SendPanel::displayState(const std::vector<SendingState>& states) {
  QStringList problems;
  const QSignalBlocker quiet(list_);
  for (std::size_t k = 0; k < states.size() && k < settings_.receivers.size(); ++k) {
    QTreeWidgetItem& item = *list_->topLevelItem(static_cast<int>(k));
    const SendingState& state = states[k];
    const auto put = [&item](int column, const QString& text) {
      if (item.text(column) != text) item.setText(column, text);
    };
    const QString to = QString::fromStdString(state.to.empty() ? settings_.receivers[k].to : state.to);
    put(kTo, to);
    item.setToolTip(kTo, to);
    switch (state.kind) {
    case SendingState::Kind::Off:
      put(kSent, tr("off"));
      put(kDropped, {});
      if (settings_.receivers[k].heldBack)
        problems << tr("This project sends forces to %1: tick it to allow this.").arg(to);
      break;
    case SendingState::Kind::Opening:
      put(kSent, tr("opening..."));
      put(kDropped, {});
      break;
    case SendingState::Kind::Refused:
      put(kSent, tr("refused"));
      put(kDropped, {});
      problems << QString::fromStdString(state.problem);
      break;
    case SendingState::Kind::Sending:
      put(kSent, QString::number(state.sent));
      put(kDropped, QString::number(state.dropped));
      break;
    }
  }
  problem_->say(problems.join("\n"));
  const auto sending = std::count_if(states.begin(), states.end(),
                                     [](const SendingState& s) { return s.kind == SendingState::Kind::Sending; });
  const QString words =
      sending > 0 ? tr("Send forces to other programs: %1 on").arg(sending) : tr("Send forces to other programs");
  if (head_->text() != words) head_->setText(words);
}

} // namespace palp
