#pragma once

class QPalette;
class QTextDocument;

namespace palp {

/// What Qt leaves out of a Markdown page: blocks of code stand on a ground of their own, apart from what they print
/// and from the text, and no picture is wider than the page.
void layOutHelp(QTextDocument& page, int width_px, const QPalette& palette);

} // namespace palp
