#pragma once

#include <QString>

class QWidget;

namespace palp {

/// Opens the help without blocking the window: the first time at the first hour, later at the page of the scene. A
/// list at its left has all pages.
void showHelp(QWidget* parent, const QString& scene);

/// The anchor that a heading of a Markdown page has in a link: "Error against time" has error-against-time.
QString anchorOf(const QString& heading);

} // namespace palp
