#include "app/gui/widgets/FileDialogs.h"

#include "tests/app/gui/WindowFixture.h"

#include <QDir>
#include <QFile>
#include <QMessageBox>
#include <QTemporaryDir>

#include <gtest/gtest.h>

namespace palp {
namespace {

TEST(FileDialogs, BeginInTheFolderThatWasChosenLast) {
  QSettings().clear();
  const QTemporaryDir folder;
  QDir(folder.path()).mkdir("work");
  const QString file = folder.filePath("work/a.csv");
  QFile made(file);
  ASSERT_TRUE(made.open(QIODevice::WriteOnly));
  made.close();
  answerFileDialog(file);
  EXPECT_EQ(askFileToOpen(nullptr, "Open", "Tables (*.csv)"), file);

  QString began;
  QTimer look;
  QObject::connect(&look, &QTimer::timeout, [&] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    if (dialog == nullptr) return;
    look.stop();
    began = dialog->directory().absolutePath();
    dialog->reject();
  });
  look.start(20);
  EXPECT_TRUE(askFileToSave(nullptr, "Save", "b.csv", "Tables (*.csv)").isEmpty());
  EXPECT_EQ(began, QDir(folder.filePath("work")).absolutePath());
}

TEST(FileDialogs, OfferANameThatBeginsWithTheProjects) {
  QWidget window;
  QWidget page(&window);
  const auto offered = [&](const QString& proposal) {
    QString name;
    QTimer look;
    QObject::connect(&look, &QTimer::timeout, [&] {
      auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
      if (dialog == nullptr) return;
      look.stop();
      name = dialog->findChild<QLineEdit*>("fileNameEdit")->text();
      dialog->reject();
    });
    look.start(20);
    EXPECT_TRUE(askFileToSave(&page, "Save", proposal, "Tables (*.csv)").isEmpty());
    return name;
  };
  EXPECT_EQ(offered("samples.csv"), "samples.csv") << "an untitled project";
  window.setWindowFilePath("/somewhere/finger v2.json");
  EXPECT_EQ(offered("samples.csv"), "finger v2-samples.csv");
  EXPECT_EQ(offered("finger v2.json"), "finger v2.json") << "the project itself";

  const QTemporaryDir folder; // a name that is there already gets a number
  for (const char* name : {"finger v2-samples.csv", "finger v2-samples-2.csv"}) {
    QFile made(folder.filePath(name));
    ASSERT_TRUE(made.open(QIODevice::WriteOnly));
  }
  QDir(folder.path()).mkdir("finger v2-film");
  QSettings().setValue("lastFolder", folder.path());
  EXPECT_EQ(offered("samples.csv"), "finger v2-samples-3.csv");
  EXPECT_EQ(offered("film"), "finger v2-film-2");
}

TEST(FileDialogs, AskAboutTheNameThatWillBeWritten) {
  const QTemporaryDir folder;
  for (const char* name : {"sensor.v2.json", "sensor.csv"}) {
    QFile made(folder.filePath(name));
    ASSERT_TRUE(made.open(QIODevice::WriteOnly));
  }
  QString question;
  QTimer look; // says no once; the dialog comes again and is closed
  QObject::connect(&look, &QTimer::timeout, [&] {
    if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
      question = box->text();
      box->button(QMessageBox::No)->click();
    } else if (auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
               dialog != nullptr && !question.isEmpty()) {
      dialog->reject();
    }
  });
  look.start(20);
  const auto saved = [&](const char* typed, const char* proposal, const char* filter) {
    question.clear();
    answerFileDialog(folder.filePath(typed));
    return askFileToSave(nullptr, "Save", proposal, filter);
  };
  EXPECT_TRUE(saved("sensor.v2", "project.json", "Projects (*.json)").isEmpty());
  EXPECT_TRUE(question.contains("sensor.v2.json")) << question.toStdString();
  EXPECT_TRUE(saved("sensor", "samples.csv", "Samples (*.csv *.h5 *.hdf5 *.npz)").isEmpty());
  EXPECT_TRUE(question.contains("sensor.csv")) << question.toStdString();
  EXPECT_EQ(saved("sensor.v3", "project.json", "Projects (*.json)"), folder.filePath("sensor.v3.json"));
  EXPECT_EQ(saved("sensor.h5", "samples.csv", "Samples (*.csv *.h5 *.hdf5 *.npz)"), folder.filePath("sensor.h5"));
  EXPECT_EQ(saved("a.JSON", "project.json", "Projects (*.json)"), folder.filePath("a.JSON"));
  EXPECT_EQ(saved("film.1", "film", ""), folder.filePath("film.1")) << "a folder";
  EXPECT_TRUE(question.isEmpty());
}

TEST(FileDialogs, TakeThePathThatIsTypedAndNotAProposalThatIsThere) {
  const QTemporaryDir folder;
  for (const char* name : {"old.csv", "new.csv"}) {
    QFile made(folder.filePath(name));
    ASSERT_TRUE(made.open(QIODevice::WriteOnly));
  }
  answerFileDialog(folder.filePath("other.csv"));
  EXPECT_EQ(askFileToSave(nullptr, "Save", folder.filePath("old.csv"), "Tables (*.csv)"), folder.filePath("other.csv"));
}

} // namespace
} // namespace palp
