#include "app/gui/window/help/HelpPages.h"

#include "app/study/Resources.h"

#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QFileInfo>
#include <QRegularExpression>
#include <QStringList>

#include <array>

namespace palp {

namespace {

/// In the order of a first reading, relative to the resources; a page of docs that is named nowhere follows these.
constexpr std::array kUserPages{"help/first-hour.html",     "help/design.html",    "help/deformation.html",
                                "help/resistance.html",     "help/network.html",   "help/live.html",
                                "help/reports.html",        "help/files.html",     "help/limits.html",
                                "help/mouse-and-keys.html", "docs/guide.md",       "docs/live-forces.md",
                                "docs/notebooks.md",        "docs/clusters.md",    "docs/formats.md",
                                "docs/glossary.md",         "docs/physics.md",     "docs/validation.md",
                                "board/protocol.md",        "docs/environment.md", "docs/numerics/index.md"};
constexpr std::array kDeveloperPages{"docs/architecture.md", "docs/contributing.md", "docs/changelog.md"};

/// Pages below docs that neither list names, by name.
QStringList otherPages(const QDir& resources, const QStringList& named) {
  QStringList others;
  QDirIterator pages(resources.filePath("docs"), {"*.md"}, QDir::Files, QDirIterator::Subdirectories);
  while (pages.hasNext()) {
    const QString page = resources.relativeFilePath(pages.next());
    if (!named.contains(page)) others << page;
  }
  others.sort();
  return others;
}

QString pageTitle(const QString& file) {
  QFile page(file);
  const QString content = page.open(QIODevice::ReadOnly) ? QString::fromUtf8(page.readAll()) : QString();
  static const QRegularExpression html("<title>([^<]*)</title>"),
      markdown("^# +(.*)$", QRegularExpression::MultilineOption);
  const auto match = (file.endsWith(".md") ? markdown : html).match(content);
  return match.hasMatch() ? match.captured(1).trimmed() : QFileInfo(file).completeBaseName();
}

} // namespace

QList<HelpPage> helpPages() {
  const QString first = QString::fromStdString(resource(kUserPages.front()).string());
  const QDir resources(QFileInfo(first).dir().filePath(".."));
  const QStringList users(kUserPages.begin(), kUserPages.end()),
      developers(kDeveloperPages.begin(), kDeveloperPages.end());
  QList<HelpPage> pages;
  for (const QString& page : users + otherPages(resources, users + developers) + developers) {
    const QString file = QFileInfo(resources.filePath(page)).absoluteFilePath();
    if (QFileInfo::exists(file)) pages.append({pageTitle(file), QDir::cleanPath(file)});
  }
  return pages;
}

} // namespace palp
