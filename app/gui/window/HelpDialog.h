#pragma once

#include <QString>

class QWidget;

namespace palp {

/// Opens the help at a scene's chapter, beside the window: it does not block it.
void showHelp(QWidget* parent, const QString& scene);

} // namespace palp
