#pragma once

#include "app/gui/live/LiveHost.h"
#include "app/scenes/Palette.h"

#include <QSplitter>

#include <array>
#include <vector>

namespace palp {

class StripChart;
struct StripSpec;

/// The curves of a live source: the force, and dR/R of some cells.
class LiveCurves : public QSplitter {
  Q_OBJECT

public:
  explicit LiveCurves(LiveHost& host, QWidget* parent = nullptr);

  /// The last seconds; what is held stays.
  void draw();
  void setTheme(Theme theme);
  /// Adds the cell's curve, or takes it away.
  void toggleCell(int row, int column);
  /// The cell that was chosen last; none where nobody chose.
  [[nodiscard]] std::optional<std::array<int, 2>> chosenCell() const;

signals:
  void message(const QString& sentence);

private:
  void hold();
  void chooseCells();
  [[nodiscard]] StripSpec timed(StripSpec spec) const;
  [[nodiscard]] const Decoder* decoder() const;

  LiveHost& host_;
  StripChart* forces_ = nullptr;
  StripChart* changes_ = nullptr;
  int opened_ = 0;                        ///< LiveHost::openings() of what is drawn
  std::vector<std::array<int, 2>> cells_; ///< row, column of each curve of dR/R
  bool cellsChosen_ = false;              ///< by the user
};

} // namespace palp
