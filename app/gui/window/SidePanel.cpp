#include "app/gui/window/SidePanel.h"

#include <QScrollArea>

namespace palp {

QWidget* sidePanel(QWidget* content, int width_px) {
  auto* scroll = new QScrollArea;
  scroll->setWidget(content);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFixedWidth(width_px);
  return scroll;
}

} // namespace palp
