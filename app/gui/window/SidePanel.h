#pragma once

#include <QWidget>

class QScrollArea;
class QToolButton;

namespace palp {

/// The panel at a scene's left: its content at a fixed width, or wider where the text needs it, scrolled where the
/// window is too low for it, and folded away by the strip at its edge where the window is too narrow.
class SidePanel : public QWidget {
  Q_OBJECT

public:
  SidePanel(QWidget* content, int width_px);

  void setFolded(bool folded);
  [[nodiscard]] bool folded() const;

signals:
  void foldedNow(bool folded);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void fit();

  QScrollArea* scroll_;
  QToolButton* strip_;
  int width_px_;
};

QWidget* sidePanel(QWidget* content, int width_px);

} // namespace palp
