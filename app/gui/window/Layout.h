#pragma once

class QWidget;

namespace palp {

/// Keeps the places of all named splitters and the chosen tabs under a widget in the user's settings.
void saveLayout(const QWidget& root);
void restoreLayout(QWidget& root);

} // namespace palp
