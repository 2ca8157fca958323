#pragma once

#include "app/study/live/LiveSession.h"

#include <QWidget>

#include <vector>

class QHBoxLayout;
class QLabel;

namespace palp {

/// State, measured rate, losses, latency, trust in the force, temperature and noise in one line of tiles.
class LiveCounters : public QWidget {
  Q_OBJECT

public:
  explicit LiveCounters(QWidget* parent = nullptr);

  /// `last` may be null.
  void display(const LiveStatus& status, const LiveFrame* last, bool simulated);

private:
  struct Tile {
    QWidget* box = nullptr;
    QLabel* value = nullptr;
    QLabel* unit = nullptr;
  };
  Tile add(QHBoxLayout& row, const QString& name, const QString& title, const QString& tip, int stretch);
  void displayTrust(const LiveFrame* last);
  static void set(const Tile& tile, const QString& value, const QString& unit, bool alarm = false);

  Tile state_, rate_, losses_, latency_, trust_, climate_;
};

} // namespace palp
