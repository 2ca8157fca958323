#pragma once

#include "app/gui/live/LiveHost.h"

#include <QToolButton>

namespace palp {

/// What a board does, for those who look at another scene.
struct LiveLampState {
  enum class Kind { Dark, Waits, Streams, Records, Alarm };
  Kind kind = Kind::Dark;
  QString words;

  bool operator==(const LiveLampState&) const = default;
};

/// Remembers alarms until the scene is seen again.
class LiveWatch {
public:
  /// After each look of the host; reports a new alarm as text, once.
  QString take(const LiveHost& host, bool seen);
  [[nodiscard]] LiveLampState state(const LiveHost& host, bool seen) const;
  /// The alarm that is on, as text, for at least a second: a short touch is seen too. Empty: none.
  [[nodiscard]] QString alarm(const LiveHost& host) const;

private:
  std::uint64_t alarms_ = 0; ///< reported
  int unseen_ = 0;
  double began_s_ = 0; ///< host clock when the last one was reported
};

/// A lamp in the window's status line; a click leads to the Live scene.
class LiveLamp : public QToolButton {
  Q_OBJECT

public:
  explicit LiveLamp(QWidget* parent = nullptr);

  void display(const LiveLampState& state);
  [[nodiscard]] const LiveLampState& state() const { return state_; }

private:
  LiveLampState state_;
};

} // namespace palp
