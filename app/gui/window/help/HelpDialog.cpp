#include "app/gui/window/help/HelpDialog.h"

#include "app/gui/window/help/HelpPages.h"
#include "app/gui/window/help/HelpTopics.h"
#include "model/base/Error.h"

#include <QDesktopServices>
#include <QDialog>
#include <QDir>
#include <QEvent>
#include <QFileInfo>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QPalette>
#include <QShortcut>
#include <QSplitter>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextCursor>
#include <QTextDocument>
#include <QUrl>
#include <QVBoxLayout>

#include <algorithm>

namespace palp {

namespace {

constexpr int kFileRole = Qt::UserRole;
constexpr int kHeadingRole = Qt::UserRole + 1;
constexpr int kListWidth_px = 230;
constexpr int kPicture_px = 800;     // next to the list
constexpr qsizetype kFewLetters = 3; // fewer are a word that is being typed: no page is opened for each
constexpr qsizetype kMostTinted = 200;
constexpr int kShownText = 300; // letters of a topic that was found, in its tool tip

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

/// What Qt leaves out of a Markdown page: blocks of code get a background of their own, apart from what they print
/// and from the text, and no picture is wider than the page.
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

class HelpDialog : public QDialog {
public:
  explicit HelpDialog(QWidget* parent) : QDialog(parent) {
    setObjectName("help");
    setWindowTitle(tr("Palp: help"));
    resize(1110, 720);
    list_->setObjectName("helpPages");
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff); // a long title is cut, and complete in its tooltip
    for (const auto& [title, file] : helpPages()) {
      auto* item = new QListWidgetItem(title, list_);
      item->setData(kFileRole, file);
      item->setToolTip(title);
      topics_ += topicsOf(title, file);
    }
    buildSearch();
    text_->setOpenLinks(false);
    text_->setSearchPaths({QFileInfo(list_->item(0)->data(kFileRole).toString()).path()});
    auto* both = new QSplitter;
    auto* left = new QWidget;
    auto* leftColumn = new QVBoxLayout(left);
    leftColumn->setContentsMargins(0, 0, 0, 0);
    for (QWidget* widget : {static_cast<QWidget*>(search_), static_cast<QWidget*>(none_)})
      leftColumn->addWidget(widget);
    for (QListWidget* list : {list_, found_}) leftColumn->addWidget(list, 1);
    both->addWidget(left);
    both->addWidget(text_);
    both->setStretchFactor(1, 1);
    both->setSizes({kListWidth_px, 880});
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(both);
    connect(list_, &QListWidget::currentItemChanged, this, [this](const QListWidgetItem* item) {
      if (item != nullptr) text_->setSource(QUrl::fromLocalFile(item->data(kFileRole).toString()));
    });
    connect(text_, &QTextBrowser::sourceChanged, this, [this] { layOut(); });
    connect(text_, &QTextBrowser::anchorClicked, this, &HelpDialog::follow);
    list_->setCurrentRow(0);
  }

  /// The page of a scene; the first hour if it has none.
  void showScene(const QString& scene) {
    search_->clear();
    search_->setFocus();
    list_->setCurrentRow(0);
    showPage(QFileInfo(list_->item(0)->data(kFileRole).toString()).dir().filePath(scene + ".html"));
  }

protected:
  /// The grounds of code are colours of the page itself.
  void changeEvent(QEvent* event) override {
    QDialog::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) layOut();
  }

private:
  void layOut() { layOutHelp(*text_->document(), kPicture_px, palette()); }
  void buildSearch() {
    search_->setObjectName("helpSearch");
    search_->setPlaceholderText(tr("Search the help"));
    search_->setAccessibleName(search_->placeholderText());
    search_->setToolTip(tr("Finds topics that contain all these words or words that begin with them (Ctrl+F)"));
    search_->setClearButtonEnabled(true);
    found_->setObjectName("helpFound");
    found_->setAccessibleName(tr("Topics found"));
    found_->hide();
    none_->setObjectName("helpNone");
    none_->setProperty("role", "hint");
    none_->setWordWrap(true);
    none_->hide();
    connect(search_, &QLineEdit::textChanged, this, &HelpDialog::search);
    connect(found_, &QListWidget::currentItemChanged, this, [this](const QListWidgetItem* item) { showFound(item); });
    connect(new QShortcut(QKeySequence::Find, this), &QShortcut::activated, search_, [this] {
      search_->setFocus();
      search_->selectAll();
    });
  }

  /// The topics with these words replace the pages until the words are deleted.
  void search(const QString& words) {
    const QList<HelpTopic> topics = topicsWith(topics_, words);
    const bool any = !words.trimmed().isEmpty();
    found_->clear();
    for (const HelpTopic& topic : topics) {
      auto* item =
          new QListWidgetItem(topic.heading == topic.page ? topic.page : topic.heading + "\n    " + topic.page, found_);
      item->setData(kFileRole, topic.file);
      item->setData(kHeadingRole, topic.heading);
      item->setToolTip(topic.text.left(kShownText) + "...");
    }
    list_->setVisible(!any);
    found_->setVisible(any);
    none_->setText(tr("Nothing found for \"%1\".").arg(words.trimmed()));
    none_->setVisible(any && topics.isEmpty());
    if (!topics.isEmpty() && words.trimmed().size() >= kFewLetters) return found_->setCurrentRow(0);
    text_->setExtraSelections({});
  }

  /// The topic's page at its heading, with the words tinted.
  void showFound(const QListWidgetItem* item) {
    if (item == nullptr) return;
    showPage(item->data(kFileRole).toString());
    goTo(anchorOf(item->data(kHeadingRole).toString()));
    QList<QTextEdit::ExtraSelection> tinted;
    for (const QRegularExpression& word : searchPatterns(search_->text()))
      for (QTextCursor at = text_->document()->find(word); !at.isNull() && tinted.size() < kMostTinted;
           at = text_->document()->find(word, at)) {
        QTextCharFormat format;
        format.setBackground(palette().highlight());
        format.setForeground(palette().highlightedText());
        tinted.append({at, format});
      }
    text_->setExtraSelections(tinted);
  }

  /// The page is chosen in the list of pages too.
  void showPage(const QString& file) {
    for (int row = 0; row < list_->count(); ++row)
      if (list_->item(row)->data(kFileRole).toString() == file) list_->setCurrentRow(row);
  }

  /// A link to another page or a place of this one; all others are the desktop's.
  void follow(const QUrl& link) {
    const QUrl whole = text_->source().resolved(link);
    for (int row = 0; whole.isLocalFile() && row < list_->count(); ++row) {
      if (QFileInfo(whole.toLocalFile()) != QFileInfo(list_->item(row)->data(kFileRole).toString())) continue;
      list_->setCurrentRow(row);
      if (whole.hasFragment()) goTo(whole.fragment());
      return;
    }
    if (whole.isLocalFile() && whole.path().endsWith(".md")) { // a page of another folder
      list_->setCurrentItem(nullptr);
      text_->setSource(whole);
    } else {
      QDesktopServices::openUrl(whole);
    }
  }

  /// To an anchor, or to the heading whose words make it ("Error against time": error-against-time): Markdown's
  /// headings have no anchors in Qt.
  void goTo(const QString& anchor) {
    for (QTextBlock block = text_->document()->begin(); block.isValid(); block = block.next()) {
      if (block.blockFormat().headingLevel() == 0 || anchorOf(block.text()) != anchor) continue;
      text_->moveCursor(QTextCursor::End); // so that the heading comes to the top
      text_->setTextCursor(QTextCursor(block));
      text_->ensureCursorVisible();
      return;
    }
    text_->scrollToAnchor(anchor);
  }

  QLineEdit* search_ = new QLineEdit;
  QLabel* none_ = new QLabel;
  QListWidget* list_ = new QListWidget;
  QListWidget* found_ = new QListWidget;
  QList<HelpTopic> topics_;
  QTextBrowser* text_ = new QTextBrowser;
};

} // namespace

QString anchorOf(const QString& heading) {
  QString anchor;
  for (const QChar letter : heading.toLower())
    if (letter.isLetterOrNumber() || letter == '-' || letter == '_') {
      anchor += letter;
    } else if (letter.isSpace()) {
      anchor += '-';
    }
  return anchor;
}

void showHelp(QWidget* parent, const QString& scene) {
  auto* dialog = static_cast<HelpDialog*>(parent->findChild<QDialog*>("help"));
  try {
    if (dialog == nullptr)
      dialog = new HelpDialog(parent); // at the first hour
    else
      dialog->showScene(scene);
  } catch (const Error& error) {
    QMessageBox::warning(parent, QObject::tr("Help"), QString::fromStdString(error.what()));
    return;
  }
  dialog->show();
  dialog->raise();
}

} // namespace palp
