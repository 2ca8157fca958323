#pragma once

#include <QObject>

namespace palp {

/// Tool tips of the window, those of the rows of lists too, are shown as written, in lines that can be read: Qt
/// draws a plain one as a single line, and a file named "<b>x" as markup. A tip that means markup begins with <qt>.
class ToolTipWrap : public QObject {
public:
  explicit ToolTipWrap(QObject* parent);

  /// The tip as it is shown: words are wrapped where they are longer than a line, or look like markup.
  [[nodiscard]] static QString wrapped(const QString& tip);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

} // namespace palp
