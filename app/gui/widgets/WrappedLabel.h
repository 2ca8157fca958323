#pragma once

#include <QLabel>

namespace palp {

/// Words that break into as many lines as they need: a layout alone gives such a label the height of fewer lines where
/// it appears later, and the widgets below cover the rest.
class WrappedLabel : public QLabel {
public:
  explicit WrappedLabel(const QString& words = {}, QWidget* parent = nullptr);

  /// Shows a sentence; empty: takes no room.
  void say(const QString& sentence);

protected:
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;

private:
  void fit();
};

} // namespace palp
