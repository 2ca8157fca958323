#include "app/gui/live/LiveLamp.h"

#include <QStyle>

namespace palp {

namespace {

constexpr int kSecondsOfAMinute = 60;
constexpr double kLeastAlarm_s = 1; // that an alarm is shown

QString roleOf(LiveLampState::Kind kind) {
  switch (kind) {
  case LiveLampState::Kind::Records:
    return "records";
  case LiveLampState::Kind::Alarm:
    return "alarm";
  case LiveLampState::Kind::Dark:
  case LiveLampState::Kind::Waits:
  case LiveLampState::Kind::Streams:
    break;
  }
  return "streams";
}

QString timeOf(double seconds) {
  const int whole = static_cast<int>(seconds);
  return QString("%1:%2").arg(whole / kSecondsOfAMinute).arg(whole % kSecondsOfAMinute, 2, 10, QChar('0'));
}

} // namespace

QString LiveWatch::take(const LiveHost& host, bool seen) {
  const LiveStatus& status = host.status();
  if (seen) unseen_ = 0;
  if (status.alarms < alarms_) alarms_ = 0; // another session
  const std::uint64_t fresh = status.alarms - alarms_;
  alarms_ = status.alarms;
  if (fresh == 0) return {};
  began_s_ = hostClock_s();
  if (!seen) unseen_ += static_cast<int>(fresh);
  return QString::fromStdString(status.lastAlarm);
}

QString LiveWatch::alarm(const LiveHost& host) const {
  const LiveStatus& status = host.status();
  const bool fresh = host.settings().alarmOn && began_s_ > 0 && hostClock_s() - began_s_ < kLeastAlarm_s;
  QString words = QString::fromStdString(status.alarm.empty() && fresh ? status.lastAlarm : status.alarm);
  return words.replace(0, 1, words.left(1).toUpper());
}

LiveLampState LiveWatch::state(const LiveHost& host, bool seen) const {
  const LiveStatus& status = host.status();
  const QString file = QString::fromStdString(host.recordingFile().filename().string());
  const QString recording = status.recordingWaits ? QObject::tr("Recording %1: waiting for the board").arg(file)
                            : status.recording    ? QObject::tr("Recording %1, %2").arg(file, timeOf(host.recorded_s()))
                                                  : QString();
  const QString alarm = this->alarm(host);
  if (!alarm.isEmpty() || unseen_ > 0) {
    QString words = alarm.isEmpty() ? QString::fromStdString(status.lastAlarm) : alarm;
    words.replace(0, 1, words.left(1).toUpper());
    if (unseen_ > 1) words += QObject::tr(" (%1 times)").arg(unseen_);
    return {LiveLampState::Kind::Alarm, recording.isEmpty() ? words : words + "; " + recording};
  }
  if (!recording.isEmpty()) return {LiveLampState::Kind::Records, recording};
  if (!seen && !status.recordingFailure.empty()) // in the scene itself the panel has the reason
    return {LiveLampState::Kind::Alarm, QObject::tr("Nothing is recorded any more: %1").arg(file)};
  const QString source = QString::fromStdString(status.source);
  const QString state = QString::fromLatin1(name(status.state));
  if (!seen && !host.worksHidden() && status.connections > 0 && !host.replaying())
    return {LiveLampState::Kind::Waits, QObject::tr("Live is waiting: %1").arg(source)};
  if (status.state != LiveState::Streaming) {
    const bool stands = host.replaying() && (status.state == LiveState::Paused || status.state == LiveState::Ended);
    const QString replay = status.state == LiveState::Ended ? QObject::tr("Replay ended: %1").arg(source)
                                                            : QObject::tr("Replay paused: %1").arg(source);
    if (!seen && host.worksHidden())
      return {LiveLampState::Kind::Alarm,
              QObject::tr("Nothing is monitored: %1").arg(stands ? replay : QObject::tr("the board is %1").arg(state))};
    if (seen && stands) return {LiveLampState::Kind::Streams, replay};
    const bool gone = status.connections > 0 && status.state != LiveState::Paused && status.state != LiveState::Ended;
    if (seen && gone) return {LiveLampState::Kind::Alarm, QObject::tr("Live: %1 is unplugged, %2").arg(source, state)};
    return seen ? LiveLampState{LiveLampState::Kind::Streams, QObject::tr("Live: %1").arg(state)} : LiveLampState{};
  }
  if (seen && host.replaying()) return {LiveLampState::Kind::Streams, QObject::tr("Playing the %1").arg(source)};
  const LiveFrame* last = host.history().last();
  if (seen && status.blind && last != nullptr && !last->faults.empty())
    return {LiveLampState::Kind::Alarm, QObject::tr("No forces: %1").arg(QString::fromStdString(last->faults[0]))};
  if (seen) return {LiveLampState::Kind::Streams, QObject::tr("Live: %1").arg(source)};
  if (host.worksHidden() && host.settings().alarmOn && status.blind)
    return {LiveLampState::Kind::Alarm, QObject::tr("The alarm has no forces: %1").arg(source)};
  return host.worksHidden() ? LiveLampState{LiveLampState::Kind::Streams,
                                            (host.settings().alarmOn ? QObject::tr("Alarm on: %1")
                                                                     : QObject::tr("Forces are being sent: %1"))
                                                .arg(source)}
                            : LiveLampState{};
}

LiveLamp::LiveLamp(QWidget* parent) : QToolButton(parent) {
  setObjectName("liveLamp");
  setAutoRaise(true);
  setProperty("role", "streams");
  hide();
}

void LiveLamp::display(const LiveLampState& state) {
  if (state == state_) return;
  state_ = state;
  setVisible(state.kind != LiveLampState::Kind::Dark);
  const bool waits = state.kind == LiveLampState::Kind::Waits;
  setText(QString::fromUtf8(waits ? "\u25CB " : "\u25CF ") + state.words);
  setAccessibleName(state.words);
  setToolTip(waits ? tr("%1. Nothing is read while this scene is hidden, as no recording, alarm or receiver is on. A "
                        "click opens the Live scene.")
                         .arg(state.words)
                   : tr("%1. A click opens the Live scene; only its Record button ends a recording.").arg(state.words));
  const QString role = roleOf(state.kind);
  if (property("role").toString() == role) return;
  setProperty("role", role);
  style()->unpolish(this);
  style()->polish(this);
}

} // namespace palp
