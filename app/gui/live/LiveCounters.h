#pragma once

#include "app/study/live/LiveSession.h"
#include "app/study/live/trust/DeviationNote.h"

#include <QWidget>

#include <array>

class QGridLayout;
class QLabel;

namespace palp {

/// State, measured rate, losses, latency, trust in the force, temperature and noise in one line of tiles, or in more
/// where it is narrow.
class LiveCounters : public QWidget {
  Q_OBJECT

public:
  explicit LiveCounters(QWidget* parent = nullptr);

  /// `last` may be null; `note`: of the network in use.
  void display(const LiveStatus& status, const LiveFrame* last, bool simulated, bool replaying, bool loading,
               const DeviationNote& note = {});

  /// That a tile needs for its usual words [px].
  [[nodiscard]] int tileWidth() const;

protected:
  void resizeEvent(QResizeEvent* event) override;

private:
  struct Tile {
    QWidget* box = nullptr;
    QLabel* value = nullptr;
    QLabel* unit = nullptr;
    QString tip; ///< explanation; the tool tip has the text as well, as it may be cut
  };
  Tile add(const QString& name, const QString& title, const QString& tip);
  void arrange(int columns);
  void displayTrust(const LiveStatus& status, const LiveFrame* last, bool loading, const DeviationNote& note);
  static void set(const Tile& tile, const QString& value, const QString& unit, bool alarm = false);

  QGridLayout* grid_;
  int columns_ = 0;
  Tile state_, rate_, losses_, latency_, trust_, climate_;
};

} // namespace palp
