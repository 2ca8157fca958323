#include "app/gui/views/CsvExport.h"

#include "app/gui/widgets/FileDialogs.h"
#include "app/gui/window/Scene.h"
#include "io/AtomicFile.h"
#include "model/base/Error.h"
#include "model/base/Text.h"

#include <QMessageBox>

#include <algorithm>

namespace palp {

QString csvCell(const QString& text) {
  if (!text.contains(',') && !text.contains('"') && !text.contains('\n')) return text;
  QString inner = text;
  return '"' + inner.replace('"', "\"\"") + '"';
}

QString chartCsv(const ChartSpec& spec) {
  const auto cell = [](const std::string& text) { return csvCell(QString::fromStdString(text)); };
  QString csv = "series," + cell(spec.xLabel) + "," + cell(spec.yLabel) + "\n";
  for (const ChartSeries& series : spec.series) {
    if (series.level && !series.y.empty()) {
      csv += cell(series.name) + ",," + QString::fromStdString(text(series.y.front())) + "\n";
      continue;
    }
    for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k)
      csv += cell(series.name) + "," + QString::fromStdString(text(series.x[k])) + "," +
             QString::fromStdString(text(series.y[k])) + "\n";
  }
  return csv;
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
    writeFile(file.toStdString(), (sourceOf(*parent) + text).toStdString(), true); // the dialog has asked
    return file;
  } catch (const Error& error) {
    QMessageBox::warning(parent, QObject::tr("Save as CSV"), QString::fromStdString(error.what()));
    return {};
  }
}

} // namespace palp
