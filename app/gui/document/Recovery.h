#pragma once

#include <QString>

namespace palp {

class MainWindow;

/// Asks what shall become of work that windows which did not end well have left below `root`, if there is any.
void offerRecovery(MainWindow& window, const QString& root);

} // namespace palp
