#include "app/gui/design/BoundWords.h"

#include <QObject>
#include <QStringList>

#include <cmath>

namespace palp {

QString boundPercents(const Eigen::Vector3d& bound_percent) {
  QStringList texts;
  for (const double value : bound_percent) texts << (std::isfinite(value) ? QString::number(value, 'g', 3) : "-");
  return texts.join(" / ") + " %";
}

QString boundTable(const QString& nameA, const DesignBounds& a, const QString& nameB, const DesignBounds& b) {
  const auto line = [](const QString& name, const Eigen::Vector3d& one, const Eigen::Vector3d& other) {
    return "<tr><td>" + name + "&nbsp;&nbsp;</td><td>" + boundPercents(one) + "&nbsp;&nbsp;</td><td><b>" +
           boundPercents(other) + "</b></td></tr>";
  };
  return QObject::tr("Cramer-Rao bound of Fx / Fy / Fz in % of the force range, area known, root mean square over the "
                     "areas:") +
         "<table><tr><td></td><td>" + nameA + "</td><td><b>" + nameB + "</b></td></tr>" +
         line(QObject::tr("middle row-wire"), a.centreRow.withPrior(), b.centreRow.withPrior()) +
         line(QObject::tr("the same without prior"), a.centreRow.withoutPrior(), b.centreRow.withoutPrior()) +
         line(QObject::tr("all row-wires"), a.allRows.withPrior(), b.allRows.withPrior()) +
         line(QObject::tr("the same without prior"), a.allRows.withoutPrior(), b.allRows.withoutPrior()) + "</table>";
}

} // namespace palp
