#include "app/gui/reports/PageWords.h"

#include <QFile>
#include <QRegularExpression>

#include <utility>

namespace palp {

PageWords::PageWords(QWidget* parent) : QTextBrowser(parent) {
  setObjectName("reportWords");
  setAccessibleName(tr("Text and tables of the report"));
  setPlaceholderText(tr("Text and tables appear here when a report is done or selected under Earlier reports."));
  setOpenLinks(false);
}

void PageWords::show(const QString& page) {
  QFile file(page);
  if (page.isEmpty() || !file.open(QIODevice::ReadOnly)) return clear();
  static const QRegularExpression style("<style>.*?</style>", QRegularExpression::DotMatchesEverythingOption);
  static const QRegularExpression picture("<img [^>]*>");
  QString html = QString::fromUtf8(file.readAll());
  html.remove(style).remove(picture); // the browser's colours are not the window's
  for (const auto& [kind, colour] :
       {std::pair{"good", "#301a7f37"}, std::pair{"doubtful", "#40d4a72c"}, std::pair{"bad", "#30cf222e"}})
    html.replace(QString("<tr class=\"%1\">").arg(kind), QString("<tr bgcolor=\"%1\">").arg(colour)); // as on the page
  html.replace("<figcaption>", "<p>").replace("</figcaption>", "</p>");
  html.replace("<table>", "<table border=\"1\" cellspacing=\"0\" cellpadding=\"4\">");
  setHtml(html);
}

} // namespace palp
