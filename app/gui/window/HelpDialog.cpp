#include "app/gui/window/HelpDialog.h"

#include "app/study/Resources.h"
#include "model/base/Error.h"

#include <QDesktopServices>
#include <QDialog>
#include <QDir>
#include <QFileInfo>
#include <QListWidget>
#include <QMessageBox>
#include <QSplitter>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextDocument>
#include <QVBoxLayout>

namespace palp {

namespace {

constexpr int kFileRole = Qt::UserRole;
constexpr int kListWidth_px = 190;

/// The first heading of a Markdown page.
QString titleOf(const QString& file) {
  QFile page(file);
  if (!page.open(QIODevice::ReadOnly)) return QFileInfo(file).completeBaseName();
  while (!page.atEnd()) {
    const QString line = QString::fromUtf8(page.readLine()).trimmed();
    if (line.startsWith("# ")) return line.mid(2);
  }
  return QFileInfo(file).completeBaseName();
}

/// What the help shows, by their titles: the help itself, then the pages in the order of their files' names.
QList<QPair<QString, QString>> helpPages() {
  const QString help = QString::fromStdString(resource("help/help.html").string());
  QList<QPair<QString, QString>> pages{{QObject::tr("The window"), QFileInfo(help).absoluteFilePath()}};
  const QDir docs(QFileInfo(help).dir().filePath("../docs"));
  for (const QFileInfo& page : docs.entryInfoList({"*.md"}, QDir::Files, QDir::Name))
    pages.append({titleOf(page.filePath()), page.absoluteFilePath()});
  return pages;
}

class HelpDialog : public QDialog {
public:
  explicit HelpDialog(QWidget* parent) : QDialog(parent) {
    setObjectName("help");
    setWindowTitle(tr("Palp: help"));
    resize(1110, 720);
    list_->setObjectName("helpPages");
    for (const auto& [title, file] : helpPages()) {
      auto* item = new QListWidgetItem(title, list_);
      item->setData(kFileRole, file);
      item->setToolTip(title);
    }
    text_->setOpenLinks(false);
    text_->setSearchPaths({QFileInfo(list_->item(0)->data(kFileRole).toString()).path()});
    auto* both = new QSplitter;
    both->addWidget(list_);
    both->addWidget(text_);
    both->setStretchFactor(1, 1);
    both->setSizes({kListWidth_px, 920});
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(both);
    connect(list_, &QListWidget::currentItemChanged, this, [this](const QListWidgetItem* item) {
      if (item != nullptr) text_->setSource(QUrl::fromLocalFile(item->data(kFileRole).toString()));
    });
    connect(text_, &QTextBrowser::anchorClicked, this, &HelpDialog::follow);
    list_->setCurrentRow(0);
  }

  void showScene(const QString& scene) {
    list_->setCurrentRow(0);
    text_->scrollToAnchor(scene);
  }

private:
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
      text_->setTextCursor(QTextCursor(block));
      text_->ensureCursorVisible();
      return;
    }
    text_->scrollToAnchor(anchor);
  }

  QListWidget* list_ = new QListWidget;
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
    if (dialog == nullptr) dialog = new HelpDialog(parent);
  } catch (const Error& error) {
    QMessageBox::warning(parent, QObject::tr("Help"), QString::fromStdString(error.what()));
    return;
  }
  dialog->showScene(scene);
  dialog->show();
  dialog->raise();
}

} // namespace palp
