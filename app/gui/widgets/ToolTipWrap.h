#pragma once

#include <QObject>

namespace palp {

/// Tool tips of the whole window stand in lines that can be read, where Qt draws a plain one as a single line.
class ToolTipWrap : public QObject {
public:
  explicit ToolTipWrap(QObject* parent);

  /// The tip as it is shown: plain words that are longer than a line are wrapped.
  [[nodiscard]] static QString wrapped(const QString& tip);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

} // namespace palp
