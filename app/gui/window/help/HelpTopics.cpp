#include "app/gui/window/help/HelpTopics.h"

#include <QFile>
#include <QRegularExpression>
#include <QStringList>
#include <QTextDocumentFragment>

#include <algorithm>

namespace palp {

namespace {

/// Words of a question that are in every topic or in none.
const QStringList kEmptyWords{"a",   "an",    "and", "any", "are",  "can",   "do",    "does", "for",  "have", "how",
                              "i",   "in",    "is",  "it",  "me",   "my",    "need",  "of",   "on",   "or",   "should",
                              "the", "there", "to",  "we",  "what", "where", "which", "why",  "with", "you"};

bool holdsAll(const QString& text, const QList<QRegularExpression>& words) {
  return std::all_of(words.begin(), words.end(),
                     [&](const QRegularExpression& word) { return word.match(text).hasMatch(); });
}

/// Of all comments "<!-- search: ... -->".
QString synonymsIn(const QString& html) {
  static const QRegularExpression comment("<!-- search:(.*?)-->", QRegularExpression::DotMatchesEverythingOption);
  QStringList all;
  for (auto matches = comment.globalMatch(html); matches.hasNext();) all << matches.next().captured(1).simplified();
  return all.join(", ");
}

QString plainHtml(const QString& html) {
  return QTextDocumentFragment::fromHtml(html).toPlainText().simplified();
}

/// A Markdown line without what is only for its look.
QString plainMarkdown(QString line) {
  static const QRegularExpression link(R"(\[([^\]]*)\]\([^)]*\))"), look("[`*|]");
  return line.replace(link, "\\1").remove(look);
}

QList<HelpTopic> markdownTopics(const HelpTopic& first, const QString& content) {
  QList<HelpTopic> topics{first};
  bool code = false;
  for (const QString& line : content.split('\n')) {
    if (line.startsWith("```")) code = !code;
    static const QRegularExpression heading("^#+ +(.*)$");
    const auto match = heading.match(line);
    if (!code && match.hasMatch())
      topics.append({first.page, first.file, plainMarkdown(match.captured(1)), {}, {}});
    else
      topics.back().text += plainMarkdown(line) + ' ';
  }
  return topics;
}

QList<HelpTopic> htmlTopics(const HelpTopic& first, const QString& content) {
  QList<HelpTopic> topics{first};
  static const QRegularExpression heading("<h[1-6][^>]*>(.*?)</h[1-6]>",
                                          QRegularExpression::DotMatchesEverythingOption);
  qsizetype from = std::max<qsizetype>(0, content.indexOf("<body"));
  const auto fill = [&topics](const QString& html) {
    topics.back().text = plainHtml(html);
    topics.back().others = synonymsIn(html);
  };
  for (auto matches = heading.globalMatch(content, from); matches.hasNext();) {
    const QRegularExpressionMatch match = matches.next();
    fill(content.mid(from, match.capturedStart() - from));
    topics.append({first.page, first.file, plainHtml(match.captured(1)), {}, {}});
    from = match.capturedEnd();
  }
  fill(content.mid(from));
  return topics;
}

} // namespace

QList<HelpTopic> topicsOf(const QString& page, const QString& file) {
  QFile source(file);
  if (!source.open(QIODevice::ReadOnly)) return {};
  const QString content = QString::fromUtf8(source.readAll());
  const HelpTopic first{page, file, page, {}, {}};
  QList<HelpTopic> topics = file.endsWith(".md") ? markdownTopics(first, content) : htmlTopics(first, content);
  for (HelpTopic& topic : topics) topic.text = topic.text.simplified();
  topics.removeIf([](const HelpTopic& topic) { return topic.text.isEmpty(); });
  return topics;
}

QList<QRegularExpression> searchPatterns(const QString& words) {
  const QStringList typed = words.toLower().simplified().split(' ', Qt::SkipEmptyParts);
  QStringList telling = typed;
  telling.removeIf([](const QString& word) { return kEmptyWords.contains(word); });
  QList<QRegularExpression> patterns;
  for (QString word : telling.isEmpty() ? typed : telling) {
    if (word.size() > 3 && word.endsWith('s') && !word.endsWith("ss")) word.chop(1);
    patterns.append(
        QRegularExpression("(?<![\\w])" + QRegularExpression::escape(word),
                           QRegularExpression::CaseInsensitiveOption | QRegularExpression::UseUnicodePropertiesOption));
  }
  return patterns;
}

QList<HelpTopic> topicsWith(const QList<HelpTopic>& topics, const QString& words) {
  const QList<QRegularExpression> all = searchPatterns(words);
  if (all.isEmpty()) return {};
  QList<HelpTopic> named, others;
  for (const HelpTopic& topic : topics) {
    const QString name = topic.heading + ' ' + topic.others;
    if (holdsAll(name, all))
      named << topic;
    else if (holdsAll(name + ' ' + topic.text, all))
      others << topic;
  }
  return named + others;
}

} // namespace palp
