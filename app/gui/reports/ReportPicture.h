#pragma once

#include <QPixmap>
#include <QScrollArea>

class QLabel;

namespace palp {

/// A picture of a report, as wide as its place, at most as it was drawn; the rest of its height is scrolled to.
class ReportPicture : public QScrollArea {
public:
  /// `words` stand there while there is no picture.
  explicit ReportPicture(const QString& words, QWidget* parent = nullptr);

  /// Nothing where the picture is null.
  void show(const QPixmap& picture);
  /// A text in place of a picture, as it is.
  void say(const QString& text);
  /// The words again.
  void clear();

protected:
  void resizeEvent(QResizeEvent* event) override;

private:
  void fit();

  QString words_;
  QLabel* label_;
  QPixmap picture_;
};

} // namespace palp
