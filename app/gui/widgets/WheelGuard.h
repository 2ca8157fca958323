#pragma once

#include <QObject>

namespace palp {

/// In all panels of the window the wheel changes the value of the box that has the focus alone; over all others it
/// scrolls the panel, and no value changes because the pointer happened to pass.
class WheelGuard : public QObject {
public:
  explicit WheelGuard(QObject* parent);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

} // namespace palp
