#pragma once

#include <QList>
#include <QString>

namespace palp {

/// A page of the help, in HTML or Markdown.
struct HelpPage {
  QString title; ///< its <title> or its first heading; the file's name if it has none
  QString file;  ///< absolute
};

/// All pages in the order of the list: the first hour, a page per scene, other pages for users, and the developers'
/// pages last. Throws Error if the help is not installed.
QList<HelpPage> helpPages();

} // namespace palp
