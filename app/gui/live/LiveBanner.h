#pragma once

#include "app/gui/live/LiveHost.h"

#include <QWidget>

class QLabel;
class QPushButton;

namespace palp {

/// What is to be known now, in one line over the views: red where something is wrong, plain where a recording only
/// ended, a broken wire is none of those that the network reads, or a tare is due and the forces still hold.
class LiveBanner : public QWidget {
  Q_OBJECT

public:
  explicit LiveBanner(QWidget* parent = nullptr);

  void display(const LiveHost& host, const QString& alarm);

signals:
  void tareRequested();
  /// A network of these row-wires, the intact ones, is needed: "0,1,2,4".
  void networkOfRowsRequested(const QString& rows);

private:
  QLabel* words_ = nullptr;
  QPushButton* copyRemedy_ = nullptr;
  QPushButton* otherRows_ = nullptr;
  QPushButton* tare_ = nullptr;
};

} // namespace palp
