#pragma once

#include <QString>

class QLabel;

namespace palp {

// Labels show their text as written (Application), so that a file named "<b>x" looks like it. Text with markup is
// marked so here, and escapes what comes from users and files.

/// A label whose text is markup.
QLabel* markupLabel(const QString& markup = {});
/// Shows words as written in a label of markup.
void showWords(QLabel& label, const QString& words);
/// The words as markup that shows them as written.
QString asWritten(const QString& words);
/// The same, but with <b> and <br>: of words that a file keeps.
QString asWrittenWithBold(const QString& words);

} // namespace palp
