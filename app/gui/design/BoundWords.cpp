#include "app/gui/design/BoundWords.h"

#include <QObject>
#include <QStringList>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

/// Three digits of the largest of the three, and as many decimals of the others.
QString equallyLong(const Eigen::Vector3d& values) {
  double largest = 0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  const int before = largest > 0 ? static_cast<int>(std::floor(std::log10(largest))) + 1 : 1;
  const int decimals = std::clamp(3 - before, 0, 6);
  QStringList texts;
  for (const double value : values) texts << (std::isfinite(value) ? QString::number(value, 'f', decimals) : "-");
  return texts.join(" / ");
}

} // namespace

BoundSummary summaryOf(const DesignBounds& bounds) {
  return {bounds.centreRow.withPrior(), bounds.centreRow.withoutPrior(), bounds.allRows.withPrior(),
          bounds.allRows.withoutPrior()};
}

QString boundPercents(const Eigen::Vector3d& bound_percent) {
  return equallyLong(bound_percent) + " %";
}

QString boundNewtons(const Eigen::Vector3d& bound_percent, const ForceRange& range) {
  return equallyLong(0.01 * bound_percent.cwiseProduct(range.high_N - range.low_N)) + " N";
}

QString boundTable(const QString& nameA, const BoundSummary& a, const QString& nameB, const BoundSummary& b) {
  const auto line = [](const QString& name, const Eigen::Vector3d& one, const Eigen::Vector3d& other) {
    return "<tr><td>" + name + "&nbsp;&nbsp;</td><td>" + boundPercents(one) + "&nbsp;&nbsp;</td><td><b>" +
           boundPercents(other) + "</b></td></tr>";
  };
  return QObject::tr("Cramer-Rao bound of Fx / Fy / Fz in % of the force range, loaded area known, root mean square "
                     "over the areas:") +
         "<table><tr><td></td><td>" + nameA + "</td><td><b>" + nameB + "</b></td></tr>" +
         line(QObject::tr("middle row-wire"), a.centreWithPrior, b.centreWithPrior) +
         line(QObject::tr("without prior"), a.centreWithoutPrior, b.centreWithoutPrior) +
         line(QObject::tr("all row-wires"), a.allWithPrior, b.allWithPrior) +
         line(QObject::tr("without prior"), a.allWithoutPrior, b.allWithoutPrior) + "</table>";
}

} // namespace palp
