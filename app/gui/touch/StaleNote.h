#pragma once

#include <QLabel>

namespace palp {

class Workbench;

/// Over a view of the touch, where it does not show what is set: that the new result is being computed, or is not.
class StaleNote : public QLabel {
public:
  StaleNote(QWidget& over, Workbench& workbench);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void display();

  Workbench& workbench_;
};

} // namespace palp
