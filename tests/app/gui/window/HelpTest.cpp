#include "app/gui/window/help/HelpDialog.h"
#include "app/gui/window/help/HelpTopics.h"

#include "app/study/Resources.h"

#include <QDialog>
#include <QDir>
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

namespace palp {
namespace {

QDir docs() {
  return QDir(QString::fromStdString(resource("help/help.html").parent_path().parent_path().string()) + "/docs");
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
  EXPECT_EQ(listed(), QStringList("help.html") + docs().entryList({"*.md"}, QDir::Files, QDir::Name));
  for (int row = 0; row < list->count(); ++row) {
    choose(row);
    const QString file = list->item(row)->data(Qt::UserRole).toString();
    EXPECT_EQ(text->source().toLocalFile(), file);
    EXPECT_GT(text->toPlainText().size(), 200) << file.toStdString() << " is empty, or cannot be read";
    EXPECT_TRUE(row == 0 || text->document()->firstBlock().blockFormat().headingLevel() == 1)
        << file.toStdString() << " does not begin with a heading, or is shown as its source";
  }
}

TEST_F(Help, OpensAgainAtTheSceneThatIsSeen) {
  choose(list->count() - 1);
  showHelp(&window, "design");
  EXPECT_EQ(list->currentRow(), 0);
  EXPECT_EQ(window.findChildren<QDialog*>("help").size(), 1);
}

TEST_F(Help, FollowsALinkToAPlaceOfAnotherPage) {
  if (list->count() < 2) GTEST_SKIP() << "there are no pages in " << docs().path().toStdString();
  const QString first = list->item(1)->data(Qt::UserRole).toString();
  const QStringList anchors = anchorsOf(contentOf(first));
  ASSERT_GT(anchors.size(), 1) << first.toStdString();
  choose(0);
  emit text->anchorClicked(QUrl("../docs/" + QFileInfo(first).fileName() + "#" + anchors.back()));
  EXPECT_EQ(list->currentRow(), 1);
  EXPECT_EQ(anchorOf(text->textCursor().block().text()), anchors.back());
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
  const QList<HelpTopic> topics{{"A", "a.md", "Of mesh", "the noise of a board"},
                                {"A", "a.md", "Noise", "a board"},
                                {"B", "b.md", "Boards", "no word of it; turbonoise"}};
  const auto headings = [&](const char* words) {
    QStringList all;
    for (const HelpTopic& topic : topicsWith(topics, words)) all << topic.heading;
    return all;
  };
  EXPECT_EQ(headings("noise"), (QStringList{"Noise", "Of mesh"}));
  EXPECT_EQ(headings("BOARD noi"), (QStringList{"Of mesh", "Noise"}));
  EXPECT_EQ(headings("board"), (QStringList{"Boards", "Of mesh", "Noise"}));
  EXPECT_EQ(headings("(a"), QStringList{}) << "no pattern";
  EXPECT_EQ(headings("  "), QStringList{});
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

} // namespace
} // namespace palp
