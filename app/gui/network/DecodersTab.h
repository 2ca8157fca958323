#pragma once

#include "app/gui/jobs/NetworkSession.h"
#include "app/study/decoding/NoiseBound.h"

#include <QWidget>

#include <optional>
#include <vector>

class QLabel;
class QPushButton;

namespace palp {

class ChartView;
class DataTable;

/// All decoders on the same samples: errors and times, and the bound with prior.
class DecodersTab : public QWidget {
  Q_OBJECT

public:
  explicit DecodersTab(QWidget* parent = nullptr);

  /// Emits nothing. `bound`: of the comparison's rows and noise; null: not known.
  void display(const NetworkSession& session, const NetworkSettings& now, const NoiseBound* bound);

signals:
  /// To train what the marked row was trained with.
  void networkRequested(const NetworkSettings& network);

private:
  [[nodiscard]] std::optional<NetworkSettings> marked() const;
  void displayMarked();

  ChartView* error_ = nullptr;
  ChartView* time_ = nullptr;
  QLabel* words_ = nullptr;
  QPushButton* train_ = nullptr;
  DataTable* table_ = nullptr;
  std::vector<std::optional<NetworkSettings>> networks_; ///< of each row; none: it cannot be trained (again)
};

} // namespace palp
