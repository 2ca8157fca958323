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

  /// By the user's hand: kept for the next start.
  void setFolded(bool folded);
  /// Because of what else needs the room now.
  void setFoldedForNow(bool folded);
  [[nodiscard]] bool folded() const;
  /// As the user left it, whatever needed its room since.
  [[nodiscard]] bool foldedByHand() const { return foldedByHand_; }

signals:
  void foldedNow(bool folded);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void fit();

  QScrollArea* scroll_;
  QToolButton* strip_;
  int width_px_;
  bool foldedByHand_ = false;
};

QWidget* sidePanel(QWidget* content, int width_px);

} // namespace palp
