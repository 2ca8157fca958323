#include "app/gui/live/LiveNews.h"

#include "io/board/HostClock.h"

#include <algorithm>
#include <utility>

namespace palp {

namespace {

constexpr double kLasting_s = 0.7;    // a wire must be broken before it is reported: a passing fault is ignored
constexpr double kDriftAgain_s = 300; // between two reports of one drift

bool contains(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

} // namespace

QString networkWords(const LiveHost& host) {
  const std::optional<Decoder>& decoder = host.network().decoder();
  if (!decoder) return host.network().loading() ? QObject::tr("Reading the network...") : QObject::tr("No network.");
  const QString rows =
      static_cast<int>(decoder->input.rows.size()) == decoder->input.rowWires
          ? QObject::tr("all row-wires")
          : QObject::tr("%1 of %2 row-wires").arg(decoder->input.rows.size()).arg(decoder->input.rowWires);
  return QObject::tr("%1: %2, %3, trained for a noise of %4 ppm")
      .arg(host.network().name(), traits(decoder->kind).description, rows)
      .arg(1e6 * decoder->noise, 0, 'g', 3);
}

QString driftWords(const LiveStatus& status) {
  if (!status.tareSuggested) return {};
  const QString rest = QObject::tr("The sensor drifts: all readings change together, and rest reads as %1 N")
                           .arg(status.driftForce_N, 0, 'g', 2);
  if (status.driftRate_N_min == 0)
    return QObject::tr("%1. Leave it unloaded; whether it is still drifting is known in a few seconds.").arg(rest);
  if (!status.driftsOn) return QObject::tr("%1. Unload the sensor and tare.").arg(rest);
  return QObject::tr("%1; still drifting at %2 N/min. Wait until the drift is below %3 N/min before taring.")
      .arg(rest)
      .arg(status.driftRate_N_min, 0, 'g', 2)
      .arg(status.steadyRate_N_min, 0, 'g', 2);
}

QStringList LiveNews::take(const LiveHost& host) {
  QStringList news;
  if (host.openings() == 0) return news;
  if (host.openings() != openings_) { // another source; the network in use is still the same
    const bool first = openings_ == 0;
    const QString network = network_;
    *this = {};
    openings_ = host.openings();
    network_ = network;
    known_ = false;
    if (!first)
      news << QObject::tr("Now: %1.")
                  .arg(host.replaying()   ? QString::fromStdString(host.settings().recording)
                       : host.simulated() ? QObject::tr("the simulated board")
                                          : QObject::tr("a board"));
  }
  if (host.network().decoder()) {
    const QString network = host.network().name();
    if (!network_.isEmpty() && network != network_) news << QObject::tr("Network in use: %1.").arg(network);
    network_ = network;
  }
  const QString failure = QString::fromStdString(host.status().recordingFailure);
  if (failure != std::exchange(recordingFailure_, failure) && !failure.isEmpty())
    news << QObject::tr("Nothing is recorded any more: %1.").arg(failure);
  if (!host.replaying()) takeSource(host, news);
  return news;
}

void LiveNews::takeSource(const LiveHost& host, QStringList& news) {
  const LiveStatus& status = host.status();
  const bool streams = status.state == LiveState::Streaming || status.state == LiveState::Paused;
  if (status.connections > 0 && !streams && !gone_)
    news << QObject::tr("Board unplugged: %1.")
                .arg(status.reason.empty() ? QString::fromLatin1(name(status.state))
                                           : QString::fromStdString(status.reason));
  if (streams && gone_) news << QObject::tr("Board is back: %1.").arg(QString::fromStdString(status.source));
  gone_ = status.connections > 0 && !streams;
  if (!streams) return;
  takeWires(host, news);
  takeRest(status, news);
  known_ = true;
}

void LiveNews::takeWires(const LiveHost& host, QStringList& news) {
  const LiveFrame* last = host.history().last();
  if (last == nullptr || !last->frame.complete) return;
  const double now_s = hostClock_s();
  if (last->faults != fresh_) freshSince_s_ = now_s;
  fresh_ = last->faults;
  if (now_s - freshSince_s_ < kLasting_s) return;
  for (const std::string& fault : fresh_)
    if (!contains(faults_, fault)) news << QObject::tr("Broken: %1.").arg(QString::fromStdString(fault));
  for (const std::string& fault : faults_)
    if (!contains(fresh_, fault))
      news
          << QObject::tr("Repaired: %1. Network in use: %2.").arg(QString::fromStdString(fault), host.network().name());
  faults_ = fresh_;
}

void LiveNews::takeRest(const LiveStatus& status, QStringList& news) {
  if (status.taring) return;
  if (known_ && status.tare != tare_) {
    drifted_s_ = 0;
    news << (status.tare ? QObject::tr("Tared (mean of %1 frames).").arg(status.tare->frames)
                         : QObject::tr("Tare cleared: changes are relative to %1.")
                               .arg(QString::fromStdString(status.restName)));
  }
  tare_ = status.tare;
  const double now_s = hostClock_s();
  if (!status.tareSuggested || (drifted_s_ > 0 && now_s < drifted_s_ + kDriftAgain_s)) return;
  news << driftWords(status);
  drifted_s_ = now_s;
}

} // namespace palp
