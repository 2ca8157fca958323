#pragma once

#include <QObject>

namespace palp {

/// Escape in a window: where a drop-down or a menu is open it closes that and does nothing more.
class EscapeKey : public QObject {
  Q_OBJECT

public:
  explicit EscapeKey(QWidget* window);

signals:
  /// With nothing open.
  void pressed();

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

} // namespace palp
