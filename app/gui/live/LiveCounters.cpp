#include "app/gui/live/LiveCounters.h"

#include "app/gui/widgets/ElidedLabel.h"

#include <QGridLayout>
#include <QLabel>
#include <QStyle>
#include <QVBoxLayout>

#include <cmath>

namespace palp {

namespace {

constexpr int kTileMargins_px = 24;

QString milliseconds(double seconds) {
  return QString::number(1e3 * seconds, 'f', seconds < 1e-3 ? 2 : 1);
}

QString triple(const LatencySummary& latency, std::uint64_t frames) {
  if (frames == 0) return QObject::tr("none");
  return milliseconds(latency.p50_s) + " / " + milliseconds(latency.p99_s) + " / " + milliseconds(latency.longest_s);
}

QString stateTitle(const LiveStatus& status, bool simulated, bool replaying) {
  QString title = QString::fromLatin1(name(status.state));
  if (status.state == LiveState::Streaming && (simulated || replaying))
    title = simulated ? QObject::tr("simulated") : QObject::tr("playing");
  title[0] = title[0].toUpper();
  if (status.recording) title += QObject::tr(", recording");
  if (status.recordingWaits) title += QObject::tr(", recording waits");
  return title;
}

} // namespace

LiveCounters::LiveCounters(QWidget* parent) : QWidget(parent) {
  grid_ = new QGridLayout(this);
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setSpacing(6);
  state_ = add("liveState", tr("State"), tr("State of the source, and the reason for it"));
  rate_ = add("liveRate", tr("Measured rate"),
              tr("Reports received in the last second, and complete scans (frames) per second"));
  losses_ = add("liveLosses", tr("Lost reports"),
                tr("Reports of the board that are missing in its sequence. Below: corrupt reports (wrong length, ID, "
                   "checksum or range), frames decoded more than 20 ms after the board read them, and all reports "
                   "received. All counts are since the start."));
  latency_ = add("liveLatency", tr("Latency [ms]"),
                 tr("Time from the board's last reading of a frame to the decoded force [ms]: median / 99 % / longest. "
                    "Offset and drift of the two clocks are removed. Below: the part spent in Palp, from the report's "
                    "arrival to the force, median / 99 %."));
  trust_ =
      add("liveTrust", tr("Trust"),
          tr("Whether the readings match a touch that the network was trained for. The residual is what the most "
             "likely touch "
             "leaves unexplained, relative to the noise, the tare and the network's model error (rms): about 1 is "
             "good, and 1 % of good frames exceed the limit. Implausible: more than half of the last quarter of a "
             "second exceeds the limit, or the force is outside of the training range; causes are drift, hysteresis, "
             "several touches, or another sensor. Uncalibrated: the readings match, but the stated deviation leaves "
             "out how far this board differs from the design until a calibration has measured it."));
  climate_ =
      add("liveClimate", tr("Temperature, noise, drift"),
          tr("Temperature of the board [degC]. Noise: relative noise of a reading [ppm], measured while taring and "
             "before that from frame to frame. Drift: common change of all readings since rest [ppm], measured while "
             "the sensor is unloaded. A tare is suggested when the drift reads as more than 1 % of the force range."));
  arrange(6);
}

void LiveCounters::arrange(int columns) {
  if (columns == columns_) return;
  columns_ = columns;
  const std::array boxes{state_.box, rate_.box, losses_.box, latency_.box, trust_.box, climate_.box};
  for (int k = 0; k < static_cast<int>(boxes.size()); ++k) {
    grid_->addWidget(boxes[static_cast<std::size_t>(k)], k / columns, k % columns);
    grid_->setColumnStretch(k, k < columns ? 1 : 0);
  }
}

int LiveCounters::tileWidth() const {
  return fontMetrics().horizontalAdvance(tr("of 1000; 1000.0 frames/s")) + kTileMargins_px;
}

/// As many in a line as show their text, the lines equally long.
void LiveCounters::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  const int most = width() / tileWidth();
  arrange(most >= 6 ? 6 : most >= 3 ? 3 : 2);
}

LiveCounters::Tile LiveCounters::add(const QString& name, const QString& title, const QString& tip) {
  auto* box = new QWidget;
  box->setProperty("role", "tile");
  box->setToolTip("<qt>" + tip.toHtmlEscaped() + "</qt>"); // broken into lines; later with the words, which may be cut
  auto* column = new QVBoxLayout(box);
  column->setContentsMargins(6, 4, 6, 4);
  column->setSpacing(0);
  auto* head = new QLabel(title);
  head->setProperty("role", "hint");
  Tile tile{box, new ElidedLabel, new ElidedLabel, tip};
  tile.value->setObjectName(name);
  tile.value->setProperty("role", "value");
  tile.unit->setObjectName(name + "Unit");
  tile.unit->setProperty("role", "hint");
  head->setMinimumWidth(10);
  for (QLabel* label : {head, tile.value, tile.unit}) column->addWidget(label);
  return tile;
}

void LiveCounters::set(const Tile& tile, const QString& value, const QString& unit, bool alarm) {
  if (tile.value->text() != value || tile.unit->text() != unit) {
    tile.value->setText(value);
    tile.unit->setText(unit);
    tile.box->setToolTip(QString("<qt><p><b>%1</b>: %2</p>%3</qt>")
                             .arg(value.toHtmlEscaped(), unit.toHtmlEscaped(), tile.tip.toHtmlEscaped()));
  }
  const QString role = alarm ? "problem" : "value";
  if (tile.value->property("role").toString() == role) return;
  tile.value->setProperty("role", role);
  tile.value->style()->unpolish(tile.value);
  tile.value->style()->polish(tile.value);
}

void LiveCounters::displayTrust(const LiveStatus& status, const LiveFrame* last, bool loading,
                                const DeviationNote& note) {
  if (status.state != LiveState::Streaming && status.state != LiveState::Paused && status.state != LiveState::Ended)
    return set(trust_, tr("none"), tr("no readings now"));
  if (last == nullptr) return set(trust_, tr("waiting"), tr("for the first frame"));
  if (!last->forces.valid && last->forces.reason.empty() && (loading || status.decoderProblem.empty()))
    return set(trust_, tr("waiting"), tr("reading the network"));
  if (!last->forces.valid) return set(trust_, tr("none"), tr("no forces"));
  const DecodedForces& forces = last->forces;
  const bool doubted = !forces.doubt.empty();
  const QString misfit = forces.misfit ? tr("residual %1").arg(*forces.misfit, 0, 'g', 3) : tr("readings within range");
  // All readings have changed together, by more than their scatter: that alone is not a known touch.
  const bool drifted = doubted && status.drift && status.noise > 0 && std::abs(*status.drift) > status.noise;
  const QString remedy = !drifted          ? QString()
                         : status.driftsOn ? tr("still drifting: wait, then tare; ")
                                           : tr("tare: rest reads as %1 N; ").arg(status.driftForce_N, 0, 'g', 2);
  const QString why = remedy + QString::fromStdString(forces.doubt);
  const QString known =
      note.sentence.empty() ? misfit : tr("%1; %2").arg(misfit, QString::fromStdString(note.sentence));
  const QString fits = note.brief.empty() ? tr("plausible") : QString::fromStdString(note.brief);
  set(trust_, doubted ? tr("implausible") : fits, doubted ? why : known, doubted || note.wrong);
}

void LiveCounters::display(const LiveStatus& status, const LiveFrame* last, bool simulated, bool replaying,
                           bool loading, const DeviationNote& note) {
  const bool alarm = status.state == LiveState::Refused || status.state == LiveState::Stalled ||
                     (status.state == LiveState::Searching && status.connections > 0);
  set(state_, stateTitle(status, simulated, replaying),
      QString::fromStdString(status.reason.empty() ? status.source : status.reason), alarm);
  const QString wanted = status.configuration ? tr("of %1; ").arg(status.configuration->rate_Hz) : QString();
  if (status.state != LiveState::Paused) // held with the views
    set(rate_, tr("%1 reports/s").arg(status.reportsPerSecond, 0, 'f', 0),
        wanted + tr("%1 frames/s").arg(status.framesPerSecond, 0, 'f', 0));
  set(losses_, tr("%1 lost").arg(status.counts.lost),
      tr("%1 corrupt, %2 late, of %3").arg(status.counts.bad).arg(status.lateFrames).arg(status.counts.reports),
      status.counts.lost + status.counts.bad > 0);
  set(latency_, triple(status.latency, status.counts.frames),
      status.counts.frames == 0 ? QString()
                                : tr("of these in Palp %1 / %2")
                                      .arg(milliseconds(status.decoding.p50_s), milliseconds(status.decoding.p99_s)));
  displayTrust(status, last, loading, note);
  const QString drift = status.drift ? tr("drift %1 ppm").arg(qRound64(1e6 * *status.drift)) : QString();
  const QString reads = tr("reads as %1 N: tare; ").arg(status.driftForce_N, 0, 'g', 2);
  const QString noise =
      status.noise > 0 ? tr("noise %1 ppm").arg(1e6 * status.noise, 0, 'g', 2) : tr("noise not known");
  set(climate_,
      status.temperature_degC ? QString::fromUtf8("%1 \u00b0C").arg(*status.temperature_degC, 0, 'f', 1) : tr("none"),
      status.driftsOn        ? tr("still drifting %1 N/min: wait").arg(status.driftRate_N_min, 0, 'g', 2)
      : status.tareSuggested ? reads + drift
      : drift.isEmpty()      ? noise
                             : noise + ", " + drift,
      status.tareSuggested);
}

} // namespace palp
