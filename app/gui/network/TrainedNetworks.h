#pragma once

#include "app/gui/jobs/NetworkSession.h"

#include <QWidget>

class QPushButton;
class QTreeWidget;

namespace palp {

/// The networks of this design that were trained or opened, with their errors: the way back to each.
class TrainedNetworks : public QWidget {
  Q_OBJECT

public:
  explicit TrainedNetworks(QWidget* parent = nullptr);

  /// Emits nothing.
  void display(const NetworkSession& session);

signals:
  void goBackAsked(std::size_t network);
  void takeAwayAsked(std::size_t network);

private:
  void ask();
  [[nodiscard]] int chosen() const;
  void enableButtons();

  QTreeWidget* list_ = nullptr;
  QPushButton* back_ = nullptr;
  QPushButton* away_ = nullptr;
};

} // namespace palp
