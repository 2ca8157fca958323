#include "app/gui/window/HelpDialog.h"

#include "app/study/Resources.h"

#include <QDialog>
#include <QDir>
#include <QFile>
#include <QListWidget>
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
