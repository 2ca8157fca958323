#pragma once

#include "app/gui/jobs/NetworkSession.h"

#include <QWidget>

#include <set>

#include <vector>

class QLabel;
class QLineEdit;
class QPushButton;

namespace palp {

class DataTable;

/// The networks of this design that were trained or opened, with their errors and names; restores each of them.
class TrainedNetworks : public QWidget {
  Q_OBJECT

public:
  explicit TrainedNetworks(QWidget* parent = nullptr);

  /// Emits nothing.
  void display(const NetworkSession& session);

signals:
  void goBackRequested(std::size_t network);
  void removeRequested(const std::set<std::size_t>& networks);
  void bringBackRequested();
  void nameRequested(std::size_t network, const QString& name);

private:
  void ask();
  void askName();
  [[nodiscard]] int chosen() const;
  [[nodiscard]] std::set<std::size_t> marked() const;
  void displayChosen();
  void displayAway();

  DataTable* list_ = nullptr;
  QLabel* words_ = nullptr;
  QPushButton* back_ = nullptr;
  QPushButton* away_ = nullptr;
  QPushButton* return_ = nullptr;
  QLineEdit* name_ = nullptr;
  std::vector<std::pair<QDateTime, QString>> shown_; ///< of each row: when its network was made, and its name
};

} // namespace palp
