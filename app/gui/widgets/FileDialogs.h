#pragma once

#include <QStringList>

class QWidget;

namespace palp {

// Dialogs for files begin in the folder that was chosen last, in this window or in one before.

/// Asks for a file to write, and before an existing file is replaced. A name that was typed without an ending of the
/// filter gets that of the proposal: the question is about the name that is returned. A proposal without a folder
/// begins with the project's name, where that has one, and has a number behind it where it is there already. Empty
/// where the user does not want it.
QString askFileToSave(QWidget* parent, const QString& title, const QString& proposal, const QString& filter);

/// Asks for a file to read; begins in `folder` where one is given. Empty where the user does not want it.
QString askFileToOpen(QWidget* parent, const QString& title, const QString& filter, const QString& folder = {});

/// The same for several files.
QStringList askFilesToOpen(QWidget* parent, const QString& title, const QString& filter);

} // namespace palp
