#pragma once

#include "app/gui/jobs/NetworkSession.h"
#include "app/study/decoding/NoiseBound.h"

#include <QWidget>

class QLabel;

namespace palp {

class ChartView;
class DataTable;

/// All decoders on the same samples: errors and times, and the bound that none can beat.
class DecodersTab : public QWidget {
  Q_OBJECT

public:
  explicit DecodersTab(QWidget* parent = nullptr);

  /// Emits nothing. `bound`: of the comparison's rows and noise; null: not known.
  void display(const NetworkSession& session, const NetworkSettings& now, const NoiseBound* bound);

private:
  ChartView* error_ = nullptr;
  ChartView* time_ = nullptr;
  QLabel* words_ = nullptr;
  DataTable* table_ = nullptr;
};

} // namespace palp
