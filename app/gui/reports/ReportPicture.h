#pragma once

#include <QPixmap>
#include <QScrollArea>

class QContextMenuEvent;
class QLabel;

namespace palp {

/// A picture of a report, as wide as its place, at most as it was drawn; the rest of its height is scrolled to.
/// A right click or the menu key offers it, and the points of the report, as other charts do.
class ReportPicture : public QScrollArea {
  Q_OBJECT

public:
  /// `words` are shown while there is no picture.
  explicit ReportPicture(const QString& words, QWidget* parent = nullptr);

  /// Nothing where the file holds no picture.
  void show(const QString& png);
  /// A text in place of a picture, as it is.
  void say(const QString& text);
  /// The words again.
  void clear();

signals:
  /// A picture or points were written or copied.
  void message(const QString& sentence);

protected:
  void resizeEvent(QResizeEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

private:
  void fit();
  /// Asks for a path and writes a file of the report to it.
  void saveAs(const QString& from, const QString& title, const QString& filter);

  QString words_;
  QLabel* label_;
  QPixmap picture_;
  QString file_; ///< of the picture
};

} // namespace palp
