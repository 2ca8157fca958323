#include "app/gui/widgets/SaveDialog.h"

#include <QFileDialog>
#include <QFileInfo>

namespace palp {

QString askFileToSave(QWidget* parent, const QString& title, const QString& proposal, const QString& filter) {
  QFileDialog dialog(parent, title, {}, filter);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setFileMode(QFileDialog::AnyFile);
  dialog.setDefaultSuffix(QFileInfo(proposal).suffix());
  dialog.selectFile(proposal);
  return dialog.exec() == QDialog::Accepted && !dialog.selectedFiles().isEmpty() ? dialog.selectedFiles().front()
                                                                                 : QString();
}

} // namespace palp
