#pragma once

class QRect;
class QWidget;

namespace palp {

/// Keeps the places of all named splitters, the chosen tabs and the folded panels under a widget in the user's
/// settings.
void saveLayout(const QWidget& root);
void restoreLayout(QWidget& root);

/// Makes the window no larger than a screen has room for, frame and title included, and moves it there.
void fitToScreen(QWidget& window, const QRect& room);

} // namespace palp
