#pragma once

#include <QString>

class QPushButton;

namespace palp {

/// A button with its text, the name that tests and styles find it by, and its tip.
QPushButton* pushButton(const QString& text, const QString& name, const QString& tip);

} // namespace palp
