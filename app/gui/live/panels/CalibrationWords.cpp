#include "app/gui/live/panels/CalibrationWords.h"

#include <QObject>
#include <QStringList>

#include <array>

namespace palp {

namespace {

constexpr std::array<const char*, 3> kAxisNames{"Fx", "Fy", "Fz"};
constexpr double kMinutesOfADay = 1440;

} // namespace

QString calibrationWords(const Calibration& calibration, double age_days) {
  const CalibrationReport& report = calibration.report;
  QStringList with, without;
  for (std::size_t area = 0; area < report.samplesPerArea.size(); ++area) {
    const auto count = report.samplesPerArea[area];
    if (count > 0) with << QObject::tr("%1 on area %2").arg(count).arg(area);
    if (count == 0) without << QString::number(area);
  }
  QString text = QObject::tr("<b>%1 frames</b>: %2").arg(report.samples).arg(with.join(", "));
  if (!without.isEmpty()) text += QObject::tr("; not calibrated: area %1").arg(without.join(", "));
  text += QObject::tr(". Newest: %1.<table cellspacing=0 cellpadding=2><tr><td></td><td>labels "
                      "[N]&nbsp;&nbsp;</td><td>coverage&nbsp;&nbsp;</td><td>error before "
                      "[N]&nbsp;&nbsp;</td><td>after, held out [N]&nbsp;&nbsp;</td><td>after, % of range</td></tr>")
              .arg(age_days * kMinutesOfADay < 1 ? QObject::tr("just now")
                   : age_days < 1                ? QObject::tr("%1 min ago").arg(age_days * kMinutesOfADay, 0, 'f', 0)
                                                 : QObject::tr("%1 days ago").arg(age_days, 0, 'f', 1));
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    text += QObject::tr("<tr><td>%1&nbsp;</td><td>%2 to %3&nbsp;</td><td>%4 %&nbsp;</td><td>%5</td><td>%6</td>"
                        "<td>%7 %</td></tr>")
                .arg(kAxisNames[static_cast<std::size_t>(axis)])
                .arg(report.lowest_N(axis), 0, 'g', 3)
                .arg(report.highest_N(axis), 0, 'g', 3)
                .arg(report.coverage_percent(axis), 0, 'f', 0)
                .arg(report.rmseBefore_N(axis), 0, 'g', 3)
                .arg(report.rmseAfter_N(axis), 0, 'g', 3)
                .arg(report.rmseAfter_percentOfRange(axis), 0, 'f', 2);
  text += QObject::tr("</table>Worst frame: row %1 of the table, error %2 N.")
              .arg(report.worstSample + 1) // rows are counted from 1
              .arg(report.worstError_N, 0, 'g', 3);
  if (const auto& place = report.place)
    text += QObject::tr(" Position along x, y: error before %1, %2 mm, after (held out) %3, %4 mm.")
                .arg(place->rmseBefore_mm.x(), 0, 'g', 3)
                .arg(place->rmseBefore_mm.y(), 0, 'g', 3)
                .arg(place->rmseAfter_mm.x(), 0, 'g', 3)
                .arg(place->rmseAfter_mm.y(), 0, 'g', 3);
  for (const std::string& warning : warningsOf(report))
    text = QObject::tr("<p><b>Poor fit: %1.</b></p>").arg(QString::fromStdString(warning).toHtmlEscaped()) + text;
  if (report.coverage_percent.minCoeff() < 50)
    text += QObject::tr(" The labels cover less than half of the force range of a component.");
  return text;
}

} // namespace palp
