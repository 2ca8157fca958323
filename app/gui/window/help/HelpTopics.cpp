#include "app/gui/window/help/HelpTopics.h"

#include <QFile>
#include <QRegularExpression>
#include <QTextDocumentFragment>

#include <algorithm>

namespace palp {

namespace {

bool holdsAll(const QString& text, const QList<QRegularExpression>& words) {
  return std::all_of(words.begin(), words.end(),
                     [&](const QRegularExpression& word) { return word.match(text).hasMatch(); });
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
      topics.append({first.page, first.file, plainMarkdown(match.captured(1)), {}});
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
  for (auto matches = heading.globalMatch(content, from); matches.hasNext();) {
    const QRegularExpressionMatch match = matches.next();
    topics.back().text = plainHtml(content.mid(from, match.capturedStart() - from));
    topics.append({first.page, first.file, plainHtml(match.captured(1)), {}});
    from = match.capturedEnd();
  }
  topics.back().text = plainHtml(content.mid(from));
  return topics;
}

} // namespace

QList<HelpTopic> topicsOf(const QString& page, const QString& file) {
  QFile source(file);
  if (!source.open(QIODevice::ReadOnly)) return {};
  const QString content = QString::fromUtf8(source.readAll());
  const HelpTopic first{page, file, page, {}};
  QList<HelpTopic> topics = file.endsWith(".md") ? markdownTopics(first, content) : htmlTopics(first, content);
  for (HelpTopic& topic : topics) topic.text = topic.text.simplified();
  topics.removeIf([](const HelpTopic& topic) { return topic.text.isEmpty(); });
  return topics;
}

QList<HelpTopic> topicsWith(const QList<HelpTopic>& topics, const QString& words) {
  QList<QRegularExpression> all;
  for (const QString& word : words.simplified().split(' ', Qt::SkipEmptyParts))
    all.append(
        QRegularExpression("(?<![\\w])" + QRegularExpression::escape(word),
                           QRegularExpression::CaseInsensitiveOption | QRegularExpression::UseUnicodePropertiesOption));
  if (all.isEmpty()) return {};
  QList<HelpTopic> found;
  std::copy_if(topics.begin(), topics.end(), std::back_inserter(found),
               [&](const HelpTopic& topic) { return holdsAll(topic.heading + ' ' + topic.text, all); });
  std::stable_partition(found.begin(), found.end(),
                        [&](const HelpTopic& topic) { return holdsAll(topic.heading, all); });
  return found;
}

} // namespace palp
