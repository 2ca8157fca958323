#pragma once

#include <QString>

namespace palp {

class Autosave;
class MainWindow;

/// Reports which recordings were cut when windows crashed and left a note in `root`, and asks what shall become
/// of the work that they left. What is recovered is `autosave`'s from then on.
void offerRecovery(MainWindow& window, Autosave& autosave, const QString& root);

} // namespace palp
