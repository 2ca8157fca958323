#pragma once

#include <QString>

class QWidget;

namespace palp {

/// Asks for a file to write. A name that was typed without an ending gets that of the proposal, before the question
/// whether a file of that name is to be replaced. Empty where the user does not want it.
QString askFileToSave(QWidget* parent, const QString& title, const QString& proposal, const QString& filter);

} // namespace palp
