#pragma once

#include <QWidget>

namespace palp {

/// Two groups of buttons, one at either end of a row; one below the other where the row is too narrow for both.
class FoldingRow : public QWidget {
public:
  FoldingRow(QWidget* left, QWidget* right, QWidget* parent = nullptr);

  [[nodiscard]] QSize minimumSizeHint() const override;
  [[nodiscard]] QSize sizeHint() const override;

protected:
  void resizeEvent(QResizeEvent* event) override;
  bool event(QEvent* event) override;

private:
  void arrange();

  QWidget* left_;
  QWidget* right_;
};

} // namespace palp
