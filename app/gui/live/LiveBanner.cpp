#include "app/gui/live/LiveBanner.h"

#include "app/gui/live/LiveNews.h"
#include "app/gui/widgets/KeepRoom.h"
#include "app/gui/widgets/MakeWidgets.h"

#include <QApplication>
#include <QClipboard>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QStyle>

namespace palp {

namespace {

constexpr qsizetype kMostFaults = 4;

/// What an operator can do about broken wires that leave the network in use without readings, or with fewer.
struct WayOnward {
  QString words;
  QString rows; ///< that a network could read instead; empty: none
};

WayOnward wayOnward(const LiveHost& host, const LiveFrame& frame) {
  const bool goesOn = frame.forces.valid && frame.forces.missingReadings > 0;
  if (frame.faults.empty() || (frame.forces.valid && !goesOn) || !host.network().decoder()) return {};
  if (!frame.frame.complete)
    return {goesOn ? QObject::tr("Forces continue without it, with larger deviations.") : QString(), {}};
  const auto rows = static_cast<int>(frame.frame.rowExpected.size());
  QStringList whole, broken;
  for (int row = 0; row < rows; ++row) {
    if (!frame.frame.rowExpected[static_cast<std::size_t>(row)]) return {}; // one row-wire alone is scanned
    (frame.frame.rowGood(row) ? whole : broken) << QString::number(row);
  }
  if (goesOn && whole.isEmpty())
    return {QObject::tr("Forces continue without these readings, with larger deviations: repair the wire."), {}};
  if (whole.isEmpty())
    return {QObject::tr("Every row-wire has bad readings, as a column-wire crosses them all; no network can work "
                        "without them. Repair the wire; forces then resume automatically."),
            {}};
  if (host.replaying())
    return {QObject::tr("A network that does not read row-wire %1 gives forces.").arg(broken.join(", ")), {}};
  const QString how =
      goesOn ? QObject::tr("Forces continue without these readings, with larger deviations. Repair the wire, or train "
                           "a network that does not read row-wire %1: Network, Row-wires %2.")
             : QObject::tr("Forces resume when the wire is repaired, or with a network that does not read row-wire %1: "
                           "Network, Row-wires %2.");
  return {how.arg(broken.join(", "), whole.join(',')), whole.join(',')};
}

/// Wires are broken, and the network in use reads none of them.
bool doesWithout(const LiveFrame& frame) {
  return !frame.faults.empty() && frame.forces.valid && frame.forces.missingReadings == 0;
}

QString wordsOf(const LiveHost& host, const QString& alarm) {
  const LiveStatus& status = host.status();
  const QString reason = QString::fromStdString(status.reason);
  switch (status.state) {
  case LiveState::Searching:
    return status.connections > 0
               ? QObject::tr("No board: %1. Palp reconnects automatically when the board is back.").arg(reason)
               : QObject::tr("No board is plugged in.");
  case LiveState::Refused:
  case LiveState::Stalled:
    return reason;
  case LiveState::Ended:
    if (!host.replaying()) return reason;
    return QObject::tr("The recording has ended. %1").arg(reason);
  case LiveState::Streaming:
  case LiveState::Paused:
    break;
  }
  if (!alarm.isEmpty() && !status.blind) return alarm;
  const LiveFrame* last = host.history().last();
  if (last == nullptr) return {};
  if (last->faults.empty()) return host.replaying() ? QString() : driftWords(status);
  QStringList faults;
  for (const std::string& fault : last->faults) faults << QString::fromStdString(fault);
  if (faults.size() > kMostFaults)
    faults = faults.mid(0, kMostFaults) << QObject::tr("%1 more").arg(faults.size() - kMostFaults);
  const QString way = doesWithout(*last) ? QObject::tr("The network in use does not need it; forces continue.")
                                         : wayOnward(host, *last).words;
  return way.isEmpty() ? faults.join("; ") : faults.join("; ") + ". " + way;
}

} // namespace

LiveBanner::LiveBanner(QWidget* parent) : QWidget(parent) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  words_ = textLabel("liveBanner", "banner");
  words_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  copyRemedy_ = pushButton(tr("Copy the command"), "copyRemedy", tr("Copies the command that installs the udev rule"));
  otherRows_ =
      pushButton(tr("Train without it..."), "otherRows",
                 tr("Opens the Network scene with input and row-wires set for a network that reads only intact "
                    "row-wires; generate samples there, train, and press Use in Live"));
  row->addWidget(words_, 1);
  tare_ = pushButton(tr("Tare"), "tareDue", tr("Takes the present readings as rest"));
  addTo(*row, {otherRows_, tare_, copyRemedy_});
  connect(copyRemedy_, &QPushButton::clicked, this, [] {
    const QString remedy = QString::fromStdString(permissionRemedy());
    QApplication::clipboard()->setText(remedy.section(": ", 1).section(" (", 0, 0));
  });
  connect(otherRows_, &QPushButton::clicked, this,
          [this] { emit networkOfRowsRequested(otherRows_->property("rows").toString()); });
  connect(tare_, &QPushButton::clicked, this, &LiveBanner::tareRequested);
  keepRoom(*this);
  hide();
}

void LiveBanner::display(const LiveHost& host, const QString& alarm) {
  const QString words = wordsOf(host, alarm).trimmed();
  if (words_->text() != words) words_->setText(words);
  const LiveState state = host.status().state;
  const LiveFrame* last = host.history().last();
  const bool ended = state == LiveState::Ended && host.replaying();
  const bool reads = state == LiveState::Streaming || state == LiveState::Paused;
  const bool drifts = reads && alarm.isEmpty() && last != nullptr && last->faults.empty() && !words.isEmpty();
  const bool holds = drifts && last->forces.valid && last->forces.doubt.empty();
  const bool calm = ended || holds || (reads && alarm.isEmpty() && last != nullptr && doesWithout(*last));
  const QString role = calm ? "note" : "banner";
  if (words_->property("role").toString() != role) {
    words_->setProperty("role", role);
    words_->style()->unpolish(words_);
    words_->style()->polish(words_);
  }
  copyRemedy_->setVisible(host.status().state == LiveState::Refused && words.contains("permission"));
  const QString rows = last != nullptr && words.contains("Row-wires") ? wayOnward(host, *last).rows : QString();
  otherRows_->setProperty("rows", rows);
  otherRows_->setVisible(!rows.isEmpty());
  tare_->setVisible(drifts);
  setVisible(!words.isEmpty());
}

} // namespace palp
