#pragma once

#include <QString>

namespace palp {

class MainWindow;
class Workbench;

/// Waits until the scene shows all that it shows at the start and nothing runs, writes a picture of the window and ends
/// the program: status 0, or 1 with a sentence on standard error.
void snapshotWhenComplete(MainWindow& window, Workbench& workbench, const QString& file);

} // namespace palp
