#pragma once

#include "io/ImportDraft.h"

#include <QWidget>

class QComboBox;
class QSpinBox;

namespace palp {

/// How a table of text is read, where it was detected wrongly, and how many tables belong to one recording.
class TextFormBar : public QWidget {
  Q_OBJECT

public:
  explicit TextFormBar(QWidget* parent = nullptr);

  /// Emits nothing. `isText`: false for arrays, which have no separators. `files`: all tables.
  void display(const TextForm& form, bool isText, int tablesOfOneRun, int files);

signals:
  /// By the user's hand only.
  void edited(const palp::TextForm& form, int tablesOfOneRun);

private:
  void read();

  QComboBox *separator_, *decimal_;
  QSpinBox *namesLine_, *firstLine_, *tables_;
  bool displaying_ = false;
};

} // namespace palp
