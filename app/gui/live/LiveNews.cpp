#include "app/gui/live/LiveNews.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double kMinute_s = 60, kFewSeconds = 90;
constexpr double kLongest_s = 3600; // a drift that is said to last longer is not known so well

bool contains(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

QString about(double seconds) {
  if (seconds < kFewSeconds) return QObject::tr("about %1 s").arg(10 * std::ceil(seconds / 10));
  return QObject::tr("about %1 min").arg(std::ceil(seconds / kMinute_s));
}

} // namespace

QString driftWords(const LiveStatus& status) {
  if (!status.tareSuggested) return {};
  const QString rest = QObject::tr("The sensor drifts: all readings go together, and rest reads as %1 N")
                           .arg(status.driftForce_N, 0, 'g', 2);
  if (!status.driftsOn) return QObject::tr("%1. Take your hand off it and tare.").arg(rest);
  const QString wait = status.driftsFor_s && *status.driftsFor_s < kLongest_s
                           ? QObject::tr("Wait %1, then tare").arg(about(*status.driftsFor_s))
                           : QObject::tr("Wait until it is steady, then tare");
  return QObject::tr("%1, by %2 N a minute still. %3: a tare of now would be wanted again within a minute.")
      .arg(rest)
      .arg(status.driftRate_N_min, 0, 'g', 2)
      .arg(wait);
}

QStringList LiveNews::take(const LiveHost& host) {
  QStringList news;
  if (host.openings() != openings_) *this = {};
  openings_ = host.openings();
  const LiveStatus& status = host.status();
  if (host.replaying() || openings_ == 0) return news;
  const bool streams = status.state == LiveState::Streaming || status.state == LiveState::Paused;
  if (status.connections > 0 && !streams && !gone_)
    news << QObject::tr("The board is out: %1.")
                .arg(status.reason.empty() ? QString::fromLatin1(name(status.state))
                                           : QString::fromStdString(status.reason));
  if (streams && gone_) news << QObject::tr("The board is back: %1.").arg(QString::fromStdString(status.source));
  gone_ = status.connections > 0 && !streams;
  if (streams) takeWires(host, news);
  if (streams) takeRest(status, news);
  known_ = known_ || streams;
  return news;
}

void LiveNews::takeWires(const LiveHost& host, QStringList& news) {
  const LiveFrame* last = host.history().last();
  if (last == nullptr || !last->frame.complete) return;
  for (const std::string& fault : last->faults)
    if (!contains(faults_, fault)) news << QObject::tr("Broken: %1.").arg(QString::fromStdString(fault));
  for (const std::string& fault : faults_)
    if (!contains(last->faults, fault))
      news << QObject::tr("No longer: %1. The network in use is %2.")
                  .arg(QString::fromStdString(fault), host.networkName());
  faults_ = last->faults;
}

void LiveNews::takeRest(const LiveStatus& status, QStringList& news) {
  if (status.tareSuggested && !drifted_) news << driftWords(status);
  if (!status.tareSuggested && drifted_) news << QObject::tr("The drift is over.");
  drifted_ = status.tareSuggested;
  if (status.taring) return;
  if (known_ && status.tare != tare_)
    news << (status.tare ? QObject::tr("Tared: %1 frames are rest.").arg(status.tare->frames)
                         : QObject::tr("The tare is cleared: changes count from %1.")
                               .arg(QString::fromStdString(status.restName)));
  tare_ = status.tare;
}

} // namespace palp
