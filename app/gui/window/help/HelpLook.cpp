#include "app/gui/window/help/HelpLook.h"

#include <QImage>
#include <QPalette>
#include <QTextBlock>
#include <QTextCursor>
#include <QTextDocument>
#include <QUrl>

#include <algorithm>

namespace palp {

namespace {

constexpr qreal kCodeIndent_px = 12;
constexpr qreal kCodeGap_px = 10;

bool isCode(const QTextBlock& block) {
  return block.isValid() && block.blockFormat().hasProperty(QTextFormat::BlockCodeFence);
}

/// Both belong to one fenced block.
bool sameCode(const QTextBlock& a, const QTextBlock& b) {
  const auto language = QTextFormat::BlockCodeLanguage;
  return isCode(a) && isCode(b) && a.blockFormat().property(language) == b.blockFormat().property(language);
}

void narrowPictures(QTextDocument& page, const QTextBlock& block, int width_px) {
  for (auto at = block.begin(); !at.atEnd(); ++at) {
    if (!at.fragment().charFormat().isImageFormat()) continue;
    QTextImageFormat format = at.fragment().charFormat().toImageFormat();
    const auto picture = page.resource(QTextDocument::ImageResource, QUrl(format.name())).value<QImage>();
    if (picture.width() <= width_px) continue;
    format.setWidth(width_px);
    QTextCursor cursor(block);
    cursor.setPosition(at.fragment().position());
    cursor.setPosition(at.fragment().position() + at.fragment().length(), QTextCursor::KeepAnchor);
    cursor.setCharFormat(format);
    return; // the fragments are made anew
  }
}

} // namespace

void layOutHelp(QTextDocument& page, int width_px, const QPalette& palette) {
  for (QTextBlock block = page.begin(); block.isValid(); block = block.next()) {
    narrowPictures(page, block, width_px);
    if (!isCode(block)) continue;
    QTextBlockFormat format = block.blockFormat();
    format.setBackground(palette.alternateBase());
    format.setLeftMargin(kCodeIndent_px);
    format.setTopMargin(sameCode(block.previous(), block) ? 0 : kCodeGap_px);
    format.setBottomMargin(sameCode(block, block.next()) ? 0 : kCodeGap_px);
    QTextCursor(block).setBlockFormat(format);
  }
}

} // namespace palp
