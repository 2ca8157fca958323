#pragma once

#include <QList>
#include <QString>

namespace palp {

/// What stands under one heading of a page of the help.
struct HelpTopic {
  QString page;    ///< title of the page
  QString file;    ///< absolute
  QString heading; ///< in its words; of the page itself where it has none before
  QString text;    ///< plain, in one line
};

/// The topics of a page, in Markdown or HTML by the file's ending; none of a file that cannot be read.
QList<HelpTopic> topicsOf(const QString& page, const QString& file);

/// Those that hold all the words, each where a word begins: first those with all in their heading, then in the pages'
/// order. None without a word.
QList<HelpTopic> topicsWith(const QList<HelpTopic>& topics, const QString& words);

} // namespace palp
