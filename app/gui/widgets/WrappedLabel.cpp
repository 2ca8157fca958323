#include "app/gui/widgets/WrappedLabel.h"

namespace palp {

WrappedLabel::WrappedLabel(const QString& words, QWidget* parent) : QLabel(words, parent) {
  setWordWrap(true);
}

void WrappedLabel::say(const QString& sentence) {
  setText(sentence);
  fit();
  setVisible(!sentence.isEmpty());
}

void WrappedLabel::fit() {
  setMinimumHeight(text().isEmpty() ? 0 : heightForWidth(width()));
}

void WrappedLabel::resizeEvent(QResizeEvent* event) {
  QLabel::resizeEvent(event);
  fit();
}

void WrappedLabel::showEvent(QShowEvent* event) {
  QLabel::showEvent(event);
  fit();
}

} // namespace palp
