#pragma once

#include <QLabel>

namespace palp {

/// One line of words that ends in dots where it is too narrow for them; its tip then has all of them.
class ElidedLabel : public QLabel {
public:
  explicit ElidedLabel(const QString& words = {}, QWidget* parent = nullptr);

  /// What is seen of the words.
  [[nodiscard]] QString shownWords() const;

protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;
};

} // namespace palp
