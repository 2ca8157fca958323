#pragma once

#include <QString>

class QWidget;

namespace palp {

/// Opens the help at a scene's chapter, beside the window: it does not block it. A list at its left has the help and
/// the pages of resources/docs.
void showHelp(QWidget* parent, const QString& scene);

/// The anchor that a heading of a Markdown page has in a link: "Error against time" has error-against-time.
QString anchorOf(const QString& heading);

} // namespace palp
