#pragma once

#include <QTextBrowser>

namespace palp {

/// The text of a report's page and its tables; the pictures are shown next to it.
class PageWords : public QTextBrowser {
  Q_OBJECT

public:
  explicit PageWords(QWidget* parent = nullptr);

  /// The page's file; empty: none.
  void show(const QString& page);
};

} // namespace palp
