#pragma once

#include <QList>
#include <QRegularExpression>
#include <QString>

namespace palp {

/// The text under one heading of a page of the help.
struct HelpTopic {
  QString page;    ///< title of the page
  QString file;    ///< absolute
  QString heading; ///< in its words; of the page itself where it has none before
  QString text;    ///< plain, in one line
  QString others;  ///< what else people search for it by; of a comment "<!-- search: ... -->" in HTML
};

/// The topics of a page, in Markdown or HTML by the file's ending; none of a file that cannot be read.
QList<HelpTopic> topicsOf(const QString& page, const QString& file);

/// One pattern per searched word: it matches where a word begins, in singular and plural. Words that say nothing of the
/// topic ("how", "do", "the") are left out unless there are no others.
QList<QRegularExpression> searchPatterns(const QString& words);

/// The topics that contain all words: first those with all in heading and synonyms, then the rest, each in the order of
/// the pages. None for an empty query.
QList<HelpTopic> topicsWith(const QList<HelpTopic>& topics, const QString& words);

} // namespace palp
