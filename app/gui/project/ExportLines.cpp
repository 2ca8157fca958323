#include "app/gui/project/ExportLines.h"

#include "app/gui/project/JsonFields.h"
#include "model/SensorDesign.h"

#include <QStringList>

namespace palp {

QString staleLine(const QString& stale) {
  return stale.isEmpty() ? "# up to date when it was saved\n"
                         : "# stale when it was saved: " + stale.simplified() + "\n";
}

QString exportLines(const QString& commands, const SensorDesign& design, const QString& stale) {
  QString text;
  for (const QString& command : commands.split('\n', Qt::SkipEmptyParts)) text += "# " + command + "\n";
  return text + "# design " + QString::fromStdString(jsonText(jsonOf(design))) + "\n" + staleLine(stale);
}

} // namespace palp
