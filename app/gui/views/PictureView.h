#pragma once

#include "app/scenes/Picture.h"

#include <QImage>
#include <QPixmap>
#include <QPointF>
#include <QWidget>

#include <string>

namespace palp {

/// A widget that shows one picture: drawn at most once a paint, and only where something changed; costs nothing while
/// hidden. A right click or the menu key offers it as PNG. It takes the focus, which a frame shows.
class PictureView : public QWidget {
  Q_OBJECT

public:
  explicit PictureView(QWidget* parent = nullptr);

  /// Something changed: draw at the next paint.
  void invalidate();
  /// What the view shows, as an image of its size in device pixels.
  [[nodiscard]] const QImage& image();
  /// The view in another size.
  [[nodiscard]] Picture picture(int width, int height) { return renderPicture(width, height); }
  /// What the view shows as a table, offered next to the picture; empty: it has none.
  [[nodiscard]] virtual QString table() const { return {}; }
  /// What the view shows can be drawn by lines and letters, offered as SVG next to the picture.
  [[nodiscard]] virtual bool hasSvg() const { return false; }
  /// The text of an SVG file of the view's size. Throws Error.
  [[nodiscard]] virtual std::string svg() const { return {}; }
  /// There is something to be seen.
  [[nodiscard]] virtual bool worthSaving() const { return true; }
  /// The name that is proposed for its files, without an ending: that of the view.
  [[nodiscard]] QString fileName(const QString& otherwise) const;
  [[nodiscard]] int renderCount() const { return renderCount_; }
  /// Something changed that is seen and not drawn yet.
  [[nodiscard]] bool waitsToDraw() const { return changed_ && !visibleRegion().isEmpty(); }
  [[nodiscard]] double aspect() const;
  /// A place of the widget as VTK counts: device pixels from the lower left.
  [[nodiscard]] QPointF devicePlace(const QPointF& place) const;
  /// Asks for a file and saves the view as PNG, twice as large as it is seen.
  void savePicture();

signals:
  /// A picture or its numbers were written.
  void message(const QString& sentence);
  /// Pressed and released at one place.
  void clicked(const QPointF& place);
  void hovered(const QPointF& place);
  void doubleClicked();
  void sizeChanged();

protected:
  /// Draws into an image of the view's size, RGB32.
  virtual void render(QImage& image) = 0;
  /// Prepares what drawing needs; false: that took its time, and drawing is for the next pass of the event loop.
  [[nodiscard]] virtual bool prepared() { return true; }
  [[nodiscard]] virtual Picture renderPicture(int width, int height) = 0;
  [[nodiscard]] QSize deviceSize() const;
  /// How much larger than the view a picture of this size is: its words and lines grow with it.
  [[nodiscard]] double magnification(int width, int height) const;
  /// Lets the picture go; the next paint draws it anew.
  void forget();

  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

private:
  void draw();
  /// This pass of the event loop has drawn for so long more.
  void count(qint64 time_ms);
  /// Shows what it has for another pass of the event loop, which has taken long enough already.
  [[nodiscard]] bool waits();
  /// Not yet: there are passes of the event loop to be waited for.
  [[nodiscard]] bool drawsNow();
  /// Asks for a size and a file and saves the view as PNG; or copies it, or its table.
  void offerPicture(const QPoint& globalPlace);
  /// Empty where none was given.
  [[nodiscard]] QSize askSize(const QSize& now);
  void savePicture(const QSize& size);
  void saveSvg();

  QImage image_;
  bool changed_ = true;
  bool waited_ = false;
  qint64 lastDraw_ms_ = 0;
  int renderCount_ = 0;
  QPointF pressed_;
};

/// The window as it is seen, with every view of it drawn to the end.
QPixmap windowPicture(QWidget& window);

} // namespace palp
