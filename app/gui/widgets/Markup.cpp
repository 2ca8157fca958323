#include "app/gui/widgets/Markup.h"

#include <QLabel>

namespace palp {

QLabel* markupLabel(const QString& markup) {
  auto* label = new QLabel(markup);
  label->setTextFormat(Qt::RichText);
  return label;
}

void showWords(QLabel& label, const QString& words) {
  label.setText(asWritten(words));
}

QString asWritten(const QString& words) {
  return words.toHtmlEscaped().replace('\n', "<br>");
}

QString asWrittenWithBold(const QString& words) {
  QString shown = asWritten(words);
  for (const char* tag : {"<b>", "</b>", "<br>"}) shown.replace(QString(tag).toHtmlEscaped(), tag);
  return shown;
}

} // namespace palp
