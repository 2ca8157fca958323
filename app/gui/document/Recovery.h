#pragma once

#include <QString>

namespace palp {

class Autosave;
class MainWindow;

/// Says which recordings were cut by windows that did not end well and left that in `root`, and asks what shall become
/// of the work that they left. What is recovered is `autosave`'s from then on.
void offerRecovery(MainWindow& window, Autosave& autosave, const QString& root);

} // namespace palp
