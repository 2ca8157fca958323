#include "app/gui/widgets/PushButton.h"

#include <QPushButton>

namespace palp {

QPushButton* pushButton(const QString& text, const QString& name, const QString& tip) {
  auto* push = new QPushButton(text);
  push->setObjectName(name);
  push->setToolTip(tip);
  return push;
}

} // namespace palp
