#pragma once

class QWidget;

namespace palp {

/// The panel at a scene's left: `content` at a fixed width, scrolled where the window is too low for it.
QWidget* sidePanel(QWidget* content, int width_px);

} // namespace palp
