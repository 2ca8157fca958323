#include "app/gui/window/SidePanel.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QScrollArea>
#include <QScrollBar>
#include <QToolButton>

#include <algorithm>

namespace palp {

namespace {

constexpr int kStripWidth_px = 12;

} // namespace

SidePanel::SidePanel(QWidget* content, int width_px)
    : scroll_(new QScrollArea), strip_(new QToolButton), width_px_(width_px) {
  setObjectName("sidePanel");
  scroll_->setWidget(content);
  scroll_->setWidgetResizable(true);
  scroll_->setFrameShape(QFrame::NoFrame);
  scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  strip_->setObjectName("foldPanel");
  strip_->setAutoRaise(true);
  strip_->setFixedWidth(kStripWidth_px);
  strip_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(0);
  row->addWidget(scroll_);
  row->addWidget(strip_);
  connect(strip_, &QToolButton::clicked, this, [this] { setFolded(!folded()); });
  content->installEventFilter(this);
  setFolded(false);
  fit();
}

void SidePanel::setFolded(bool folded) {
  foldedByHand_ = folded;
  setFoldedForNow(folded);
}

void SidePanel::setFoldedForNow(bool folded) {
  scroll_->setVisible(!folded);
  strip_->setArrowType(folded ? Qt::RightArrow : Qt::LeftArrow);
  strip_->setToolTip(folded ? tr("Shows the panel (F9)") : tr("Hides the panel (F9)"));
  strip_->setAccessibleName(folded ? tr("Show the panel") : tr("Hide the panel"));
  emit foldedNow(folded);
}

bool SidePanel::folded() const {
  return scroll_->isHidden();
}

bool SidePanel::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::LayoutRequest) fit(); // a larger text, or other words
  return QWidget::eventFilter(watched, event);
}

void SidePanel::fit() {
  const int needed = scroll_->widget()->minimumSizeHint().width() + scroll_->verticalScrollBar()->sizeHint().width();
  scroll_->setFixedWidth(std::max(width_px_, needed));
}

QWidget* sidePanel(QWidget* content, int width_px) {
  return new SidePanel(content, width_px);
}

} // namespace palp
