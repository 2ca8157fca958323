#pragma once

class QWidget;

namespace palp {

/// Gives every control below a widget that has neither a text nor a label of its own a name for screen readers: its
/// tip, else the words of its object name.
void nameControls(const QWidget& root);

} // namespace palp
