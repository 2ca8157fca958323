#include "app/gui/window/help/HelpDialog.h"
#include "app/gui/window/help/HelpPages.h"
#include "app/gui/window/help/HelpTopics.h"

#include "app/study/Resources.h"

#include <QDialog>
#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPalette>
#include <QRegularExpression>
#include <QTest>
#include <QTextBlock>
#include <QTextBrowser>
#include <QWidget>

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace palp {
namespace {

QDir resources() {
  return QDir(QString::fromStdString(resource("help/first-hour.html").parent_path().parent_path().string()));
}

QDir docs() {
  return QDir(resources().filePath("docs"));
}

QString contentOf(const QString& file) {
  QFile page(file);
  return page.open(QIODevice::ReadOnly) ? QString::fromUtf8(page.readAll()) : QString();
}

/// Headings of a Markdown page, as links name them; what stands in code is none.
QStringList anchorsOf(const QString& markdown) {
  QStringList anchors;
  bool code = false;
  for (const QString& line : markdown.split('\n')) {
    if (line.startsWith("```")) code = !code;
    static const QRegularExpression heading("^#+ +(.*)$");
    if (const auto match = heading.match(line); !code && match.hasMatch())
      anchors << anchorOf(match.captured(1).remove('`'));
  }
  return anchors;
}

class Help : public testing::Test {
protected:
  Help() {
    showHelp(&window, "live");
    list = window.findChild<QListWidget*>("helpPages");
    text = window.findChild<QTextBrowser*>();
  }
  void choose(int row) {
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualItemRect(list->item(row)).center());
  }
  QStringList listed() const {
    QStringList files;
    for (int row = 0; row < list->count(); ++row)
      files << QFileInfo(list->item(row)->data(Qt::UserRole).toString()).fileName();
    return files;
  }

  QWidget window;
  QListWidget* list = nullptr;
  QTextBrowser* text = nullptr;
};

TEST_F(Help, ListsEveryPageAndOpensItWithItsWords) {
  ASSERT_NE(list, nullptr);
  for (int row = 0; row < list->count(); ++row) {
    choose(row);
    const QString file = list->item(row)->data(Qt::UserRole).toString();
    EXPECT_EQ(text->source().toLocalFile(), file);
    EXPECT_GT(text->toPlainText().size(), 200) << file.toStdString() << " is empty, or cannot be read";
    EXPECT_EQ(text->document()->firstBlock().blockFormat().headingLevel(), 1)
        << file.toStdString() << " does not begin with a heading, or is shown as its source";
  }
}

TEST_F(Help, OpensOnTheFirstHourAndLaterAtTheSceneThatIsSeen) {
  EXPECT_EQ(text->source().fileName(), "first-hour.html");
  choose(list->count() - 1);
  showHelp(&window, "design");
  EXPECT_EQ(text->source().fileName(), "design.html");
  EXPECT_EQ(list->currentRow(), listed().indexOf("design.html"));
  EXPECT_EQ(window.findChildren<QDialog*>("help").size(), 1);
}

TEST(HelpPages, AreAllListedOnceForUsersFirstAndForDevelopersLast) {
  QStringList listed, all;
  for (const HelpPage& page : helpPages()) listed << resources().relativeFilePath(page.file);
  for (const char* folder : {"help", "docs", "board"}) {
    QDirIterator pages(resources().filePath(folder), {"*.md", "*.html"}, QDir::Files, QDirIterator::Subdirectories);
    while (pages.hasNext()) all << resources().relativeFilePath(pages.next());
  }
  EXPECT_EQ(listed.front(), "help/first-hour.html");
  EXPECT_EQ(listed.mid(listed.size() - 3),
            (QStringList{"docs/architecture.md", "docs/contributing.md", "docs/changelog.md"}));
  listed.sort();
  all.sort();
  EXPECT_EQ(listed, all);
}

TEST_F(Help, FollowsALinkToAPlaceOfAnotherPage) {
  const QStringList anchors = anchorsOf(contentOf(docs().filePath("formats.md")));
  ASSERT_GT(anchors.size(), 1);
  choose(0);
  emit text->anchorClicked(QUrl("../docs/formats.md#" + anchors.back()));
  EXPECT_EQ(list->currentRow(), listed().indexOf("formats.md"));
  EXPECT_EQ(anchorOf(text->textCursor().block().text()), anchors.back());
  emit text->anchorClicked(QUrl("../help/limits.html"));
  EXPECT_EQ(text->source().fileName(), "limits.html");
}

TEST_F(Help, SetsCodeApartFromWhatItPrintsAndPicturesIntoThePage) {
  choose(static_cast<int>(listed().indexOf("guide.md")));
  int code = 0, apart = 0, pictures = 0;
  for (QTextBlock block = text->document()->begin(); block.isValid(); block = block.next()) {
    const QTextBlockFormat format = block.blockFormat();
    if (format.hasProperty(QTextFormat::BlockCodeFence)) {
      ++code;
      EXPECT_NE(format.background().style(), Qt::NoBrush) << block.text().toStdString();
      if (format.topMargin() > 0) ++apart;
    }
    for (auto at = block.begin(); !at.atEnd(); ++at) {
      const QTextCharFormat piece = at.fragment().charFormat();
      if (!piece.isImageFormat()) continue;
      ++pictures;
      EXPECT_GT(piece.toImageFormat().width(), 0);
      EXPECT_LE(piece.toImageFormat().width(), 800);
    }
  }
  EXPECT_GT(apart, 10) << "commands and what they print";
  EXPECT_GT(code, apart);
  EXPECT_GT(pictures, 0);
}

TEST_F(Help, TheGroundOfCodeFollowsTheThemeWhileItIsOpen) {
  choose(static_cast<int>(listed().indexOf("guide.md")));
  const auto grounds = [&] {
    QList<QColor> all;
    for (QTextBlock block = text->document()->begin(); block.isValid(); block = block.next())
      if (block.blockFormat().hasProperty(QTextFormat::BlockCodeFence)) all << block.blockFormat().background().color();
    return all;
  };
  ASSERT_FALSE(grounds().isEmpty());
  QPalette other = window.palette();
  other.setColor(QPalette::AlternateBase, QColor(17, 34, 51));
  window.findChild<QDialog*>("help")->setPalette(other);
  for (const QColor& ground : grounds()) EXPECT_EQ(ground, QColor(17, 34, 51));
}

TEST_F(Help, FindsTopicsByAWordAndLeadsToThem) {
  auto& search = *window.findChild<QLineEdit*>("helpSearch");
  auto& found = *window.findChild<QListWidget*>("helpFound");
  QTest::keyClicks(&search, "slurm");
  EXPECT_TRUE(list->isHidden());
  ASSERT_GT(found.count(), 1);
  EXPECT_TRUE(text->toPlainText().contains("Slurm"));
  EXPECT_FALSE(text->extraSelections().isEmpty()) << "the word is tinted";
  const auto* last = found.item(found.count() - 1);
  found.scrollToItem(last);
  QTest::mouseClick(found.viewport(), Qt::LeftButton, {}, found.visualItemRect(last).center());
  EXPECT_EQ(text->source().toLocalFile(), last->data(Qt::UserRole).toString());
  EXPECT_EQ(list->currentItem()->data(Qt::UserRole), last->data(Qt::UserRole));
  QTest::keyClicks(&search, " xyzzyx");
  EXPECT_EQ(found.count(), 0);
  EXPECT_TRUE(window.findChild<QLabel*>("helpNone")->text().contains("slurm xyzzyx"));
  search.clear();
  EXPECT_FALSE(list->isHidden());
  EXPECT_TRUE(found.isHidden());
}

TEST(HelpTopics, HoldAllWordsWhereWordsBeginAndHeadingsComeFirst) {
  const QList<HelpTopic> topics{{"A", "a.md", "Of mesh", "the noise of a board", {}},
                                {"A", "a.md", "Noise", "a board", "hiss"},
                                {"B", "b.md", "Boards", "no word of it; turbonoise", {}}};
  const auto headings = [&](const char* words) {
    QStringList all;
    for (const HelpTopic& topic : topicsWith(topics, words)) all << topic.heading;
    return all;
  };
  EXPECT_EQ(headings("noise"), (QStringList{"Noise", "Of mesh"}));
  EXPECT_EQ(headings("BOARD noi"), (QStringList{"Of mesh", "Noise"}));
  EXPECT_EQ(headings("board"), (QStringList{"Boards", "Of mesh", "Noise"}));
  EXPECT_EQ(headings("the boards of a mesh"), QStringList("Of mesh")) << "singular, and without empty words";
  EXPECT_EQ(headings("hiss"), QStringList("Noise")) << "a synonym";
  EXPECT_EQ(headings("(a"), QStringList{}) << "no pattern";
  EXPECT_EQ(headings("  "), QStringList{});
}

TEST(HelpTopics, ThatPeopleTypeAreFoundOnThePageWhereTheyLookForThem) {
  QList<HelpTopic> topics;
  for (const HelpPage& page : helpPages()) topics += topicsOf(page.title, page.file);
  const std::vector<std::pair<const char*, const char*>> asked{{"Shore", "limits.html"},
                                                               {"shore a 30", "limits.html"},
                                                               {"hardness", "limits.html"},
                                                               {"Yeoh", "limits.html"},
                                                               {"Ogden", "limits.html"},
                                                               {"dome", "limits.html"},
                                                               {"domes", "limits.html"},
                                                               {"layers", "limits.html"},
                                                               {"creep", "limits.html"},
                                                               {"STL", "limits.html"},
                                                               {"udev", "live.html"},
                                                               {"permission denied", "live.html"},
                                                               {"protocol", "live.html"},
                                                               {"latency", "live.html"},
                                                               {"calibrate", "live.html"},
                                                               {"twin", "live.html"},
                                                               {"load step", "deformation.html"},
                                                               {"load steps", "deformation.html"},
                                                               {"force-displacement curve", "deformation.html"},
                                                               {"friction", "deformation.html"},
                                                               {"sneak path", "design.html"},
                                                               {"how many samples", "network.html"},
                                                               {"how many samples do I need", "network.html"},
                                                               {"maximum likelihood", "network.html"},
                                                               {"Latin hypercube", "reports.html"},
                                                               {"autosave", "files.html"},
                                                               {"shortcuts", "mouse-and-keys.html"},
                                                               {"tutorial", "first-hour.html"}};
  for (const auto& [words, page] : asked) {
    const QList<HelpTopic> found = topicsWith(topics, words);
    ASSERT_FALSE(found.isEmpty()) << words;
    EXPECT_EQ(QFileInfo(found.front().file).fileName(), page) << words << ": " << found.front().heading.toStdString();
  }
  EXPECT_EQ(topicsWith(topics, "how many samples").front().heading, "How many samples are enough");
}

TEST(HelpTopics, OfAPageStandUnderTheirHeadings) {
  const QString page = docs().filePath("formats.md");
  const QList<HelpTopic> topics = topicsOf("Formats", page);
  EXPECT_GT(topics.size(), 5);
  for (const HelpTopic& topic : topics) {
    EXPECT_FALSE(topic.text.isEmpty());
    EXPECT_FALSE(topic.heading.startsWith('#')) << topic.heading.toStdString();
  }
  EXPECT_TRUE(topicsOf("none", "/no such page.md").isEmpty());
}

TEST(HelpPages, EveryLinkBetweenThemLeadsSomewhere) {
  const QStringList pages = docs().entryList({"*.md"}, QDir::Files, QDir::Name);
  for (const QString& page : pages) {
    const QString markdown = contentOf(docs().filePath(page));
    static const QRegularExpression link(R"(\]\(([^)\s]+)\))");
    for (auto matches = link.globalMatch(markdown); matches.hasNext();) {
      const QString target = matches.next().captured(1);
      if (target.contains("://") || target.startsWith("mailto:")) continue;
      const QString path = target.section('#', 0, 0), anchor = target.section('#', 1);
      const QString file = path.isEmpty() ? docs().filePath(page) : docs().filePath(path);
      EXPECT_TRUE(QFile::exists(file)) << page.toStdString() << ": " << target.toStdString();
      if (!anchor.isEmpty() && file.endsWith(".md")) {
        EXPECT_TRUE(anchorsOf(contentOf(file)).contains(anchor)) << page.toStdString() << ": " << target.toStdString();
      }
    }
  }
}

TEST(HelpPages, EveryLinkAndPictureOfTheHelpsOwnPagesIsThere) {
  const QDir help(resources().filePath("help"));
  for (const QString& page : help.entryList({"*.html"}, QDir::Files)) {
    static const QRegularExpression link("(?:href|src)=\"([^\"#]+)");
    for (auto matches = link.globalMatch(contentOf(help.filePath(page))); matches.hasNext();) {
      const QString target = matches.next().captured(1);
      EXPECT_TRUE(QFile::exists(help.filePath(target))) << page.toStdString() << ": " << target.toStdString();
    }
  }
}

} // namespace
} // namespace palp
