#include "app/gui/views/CsvExport.h"

#include "app/gui/widgets/FileDialogs.h"
#include "app/gui/window/Scene.h"
#include "app/study/reports/Csv.h"
#include "io/AtomicFile.h"
#include "model/base/Error.h"

#include <QMessageBox>

#include <algorithm>

namespace palp {

QString csvCell(const QString& text) {
  return QString::fromStdString(CsvCell(text.toStdString()).text());
}

QString chartCsv(const ChartSpec& spec) {
  Csv csv({"series", spec.xLabel, spec.yLabel});
  for (const ChartSeries& series : spec.series) {
    if (series.level && !series.y.empty()) {
      csv.add({series.name, "", series.y.front()});
      continue;
    }
    for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k)
      csv.add({series.name, series.x[k], series.y[k]});
  }
  return QString::fromStdString(csv.text());
}

QString sourceOf(const QWidget& widget) {
  for (const QWidget* place = &widget; place != nullptr; place = place->parentWidget())
    if (const auto* scene = dynamic_cast<const Scene*>(place)) {
      const QString lines = scene->exportSource(widget);
      if (!lines.isEmpty()) return lines; // a board's page lies in the scene of all boards
    }
  return {};
}

QString offerCsv(QWidget* parent, const QString& proposal, const QString& text) {
  const QString file = askFileToSave(parent, QObject::tr("Save as CSV"), proposal, QObject::tr("Tables (*.csv)"));
  if (file.isEmpty()) return {};
  try {
    writeFile(file.toStdString(), (sourceOf(*parent) + text).toStdString(), true); // confirmed in the dialog
    return file;
  } catch (const Error& error) {
    QMessageBox::warning(parent, QObject::tr("Save as CSV"), QString::fromStdString(error.what()));
    return {};
  }
}

} // namespace palp
