#include "app/gui/views/ViewBar.h"

#include "app/gui/views/BlockView.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

namespace palp {

ViewBar::ViewBar(BlockView& view, QWidget* parent) : QWidget(parent) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(2);
  row->addWidget(new QLabel(tr("Look from")));
  const auto add = [&](const QString& name, const QString& words, const QKeySequence& key, const QString& tip) {
    auto* button = new QToolButton;
    button->setObjectName(name);
    button->setText(words);
    button->setAccessibleName(tip);
    button->setToolTip(tr("%1 (key %2)").arg(tip, key.toString()));
    button->setShortcut(key);
    row->addWidget(button);
    return button;
  };
  connect(add("viewHome", tr("Home"), Qt::Key_H, tr("Initial view: from the front, above and the left")),
          &QToolButton::clicked, &view, [&view] { view.resetCamera(); });
  struct Side {
    const char* name;
    QKeySequence key;
    Eigen::Vector3d from;
  };
  const std::array<Side, 6> sides{{{"+x", Qt::Key_X, {1, 0, 0}},
                                   {"-x", Qt::SHIFT | Qt::Key_X, {-1, 0, 0}},
                                   {"+y", Qt::Key_Y, {0, 1, 0}},
                                   {"-y", Qt::SHIFT | Qt::Key_Y, {0, -1, 0}},
                                   {"+z", Qt::Key_Z, {0, 0, 1}},
                                   {"-z", Qt::SHIFT | Qt::Key_Z, {0, 0, -1}}}};
  for (const Side& side : sides)
    connect(add(QString("view") + side.name, side.name, side.key, tr("View from %1").arg(side.name)),
            &QToolButton::clicked, &view, [&view, from = side.from] { view.lookAlong(-from); });
}

} // namespace palp
