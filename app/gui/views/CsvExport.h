#pragma once

#include "app/scenes/charts/Chart.h"

#include <QString>
#include <QStringList>

class QWidget;

namespace palp {

/// A cell of a CSV file: in quotation marks where it has to be.
QString csvCell(const QString& text);
/// Every point of every curve: `series,x,y`, the heads being the labels of the axes; a level has no x.
QString chartCsv(const ChartSpec& spec);
/// Lines after "#" that say what this chart or table of a scene was made with; empty outside of a scene.
QString sourceOf(const QWidget& widget);
/// Asks for a file and writes the table there, below what it was made with; reports why where it cannot be written.
/// Returns the file that was written.
QString offerCsv(QWidget* parent, const QString& proposal, const QString& text);

} // namespace palp
