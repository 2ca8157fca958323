#pragma once

#include <QObject>
#include <QPointF>

namespace palp {

/// In all panels of the window the wheel changes the value of the box that has the focus alone; over all others it
/// scrolls the panel, and no value changes because the pointer happened to pass, or because the box came under it while
/// the panel was scrolled.
class WheelGuard : public QObject {
public:
  explicit WheelGuard(QObject* parent);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  QPointF scrolledAt_{-1, -1}; ///< where the pointer was when the wheel last scrolled [px of the screen]
};

} // namespace palp
