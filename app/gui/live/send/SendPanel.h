#pragma once

#include "app/gui/live/send/LiveSending.h"

#include <QWidget>

class QLineEdit;
class QPushButton;
class QToolButton;
class QTreeWidget;

namespace palp {

class WrappedLabel;

/// Other programs that get the forces of this board: an address each, switched on and off by its tick, with what was
/// sent and dropped. Folded away until it is opened.
class SendPanel : public QWidget {
  Q_OBJECT

public:
  explicit SendPanel(QWidget* parent = nullptr);

  void display(const LiveSettings& settings);
  /// Of each receiver of the settings that were displayed last.
  void displayState(const std::vector<SendingState>& states);

signals:
  void edited(const QString& what, const LiveSettings& settings);

private:
  QWidget* build();
  void fold(bool open);
  void add();
  void remove();
  void edit(const QString& what, const std::vector<LiveReceiver>& receivers);

  LiveSettings settings_;
  QToolButton* head_ = nullptr;
  QWidget* content_ = nullptr;
  QTreeWidget* list_ = nullptr;
  QLineEdit* address_ = nullptr;
  QPushButton* add_ = nullptr;
  QPushButton* remove_ = nullptr;
  WrappedLabel* problem_ = nullptr;
};

} // namespace palp
