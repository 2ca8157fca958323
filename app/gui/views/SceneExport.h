#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/scenes/Picture.h"

#include <QPointer>
#include <QWidget>

#include <string>
#include <vector>

namespace palp {

/// Every chart of a scene as a picture of twice its size and as its points, every view of the block as a picture and
/// every table as CSV, into a folder. Views that show nothing yet are left out. The window draws one picture at a time
/// and stays free between them; the files are written in the background.
class SceneExport : public QObject {
  Q_OBJECT

public:
  explicit SceneExport(QObject* parent = nullptr);

  /// Asks for the name of a new folder. One export at a time: while one is drawn or written it only reports that.
  void ask(QWidget& scene);
  /// Into an existing folder.
  void write(QWidget& scene, const QString& folder);
  [[nodiscard]] bool running() const { return !left_.empty() || writer_.running(); }
  [[nodiscard]] JobRunner& runner() { return writer_; }

signals:
  void done(const QString& sentence);

private:
  struct File {
    QString path;
    std::string content;
    Picture picture; ///< in place of the content
  };
  void next();
  void finish();
  [[nodiscard]] QString free(const QString& name) const;

  /// What is still to be drawn: a view or a table, or a chart's lines alone, under the name that it was given.
  struct Piece {
    QPointer<QWidget> widget;
    QString linesAs;
  };
  std::vector<Piece> left_;
  std::vector<File> files_;
  QString folder_;
  JobRunner writer_{JobRunner::Orders::Each};
};

} // namespace palp
