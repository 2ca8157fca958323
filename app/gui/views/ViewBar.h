#pragma once

#include <QWidget>

namespace palp {

class BlockView;

/// Buttons that look at a block from the first place again or along an axis, each with a key.
class ViewBar : public QWidget {
public:
  explicit ViewBar(BlockView& view, QWidget* parent = nullptr);
};

} // namespace palp
