#include "app/gui/project/ExportLines.h"

#include "io/DesignFile.h"

#include <QJsonDocument>
#include <QStringList>

namespace palp {

QString staleLine(const QString& stale) {
  return stale.isEmpty() ? "# up to date when it was saved\n"
                         : "# stale when it was saved: " + stale.simplified() + "\n";
}

QString exportLines(const QString& commands, const SensorDesign& design, const QString& stale) {
  QString text;
  for (const QString& command : commands.split('\n', Qt::SkipEmptyParts)) text += "# " + command + "\n";
  const QJsonDocument json = QJsonDocument::fromJson(QByteArray::fromStdString(toJson(design)));
  return text + "# design " + QString::fromUtf8(json.toJson(QJsonDocument::Compact)) + "\n" + staleLine(stale);
}

} // namespace palp
