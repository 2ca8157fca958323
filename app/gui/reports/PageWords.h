#pragma once

#include <QTextBrowser>

namespace palp {

/// What a report's page says, and its tables; the pictures stand beside.
class PageWords : public QTextBrowser {
  Q_OBJECT

public:
  explicit PageWords(QWidget* parent = nullptr);

  /// The page's file; empty: none.
  void show(const QString& page);
};

} // namespace palp
