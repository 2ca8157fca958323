#include "app/gui/import/ImportDialog.h"

#include "app/gui/document/Document.h"
#include "app/gui/import/ImportColumns.h"
#include "io/AtomicFile.h"
#include "io/SampleFile.h"
#include "tests/app/gui/WindowFixture.h"

#include <QAbstractItemView>
#include <QCheckBox>
#include <QHeaderView>
#include <QLabel>
#include <QMessageBox>
#include <QPointer>
#include <QPushButton>
#include <QTemporaryDir>

namespace palp {
namespace {

namespace fs = std::filesystem;

/// The import of a table of another rig, by mouse.
class ImportWindow : public WindowFixture {
protected:
  fs::path write(const std::string& name, const std::string& content) const {
    const fs::path file = folder() / name;
    writeFile(file, content, true);
    return file;
  }
  [[nodiscard]] fs::path folder() const { return folder_.path().toStdString(); }

  /// The dialog, once it has read and checked the tables.
  void open(const std::vector<fs::path>& files) {
    QStringList names;
    for (const fs::path& file : files) names << QString::fromStdString(file.string());
    window.document().open(names);
    dialog = window.findChild<ImportDialog*>();
    ASSERT_NE(dialog, nullptr);
    ASSERT_TRUE(QTest::qWaitForWindowExposed(dialog));
    answered();
  }
  /// The rows are checked, or what is wrong is shown.
  void answered() {
    EXPECT_TRUE(QTest::qWaitFor([&] { return !problem().isEmpty() || in<QPushButton>("importStart").isEnabled(); },
                                kPatience_ms));
  }
  template <class Widget> Widget& in(const char* name) {
    auto* widget = dialog->findChild<Widget*>(name);
    EXPECT_NE(widget, nullptr) << name;
    return *widget;
  }
  QString problem() { return in<QLabel>("importProblem").text(); }
  QString verdict() { return in<QLabel>("importVerdict").text(); }
  bool ready() { return in<QPushButton>("importStart").isEnabled(); }

  /// Clicks on the meaning of a column and chooses another one.
  void assign(int column, ColumnMeaning meaning) {
    auto& columns = in<ImportColumns>("importColumns");
    const QModelIndex cell = columns.model()->index(0, column);
    columns.scrollTo(cell);
    QTest::mouseClick(columns.viewport(), Qt::LeftButton, {}, columns.visualRect(cell).center());
    const QPointer<QComboBox> box = columns.viewport()->findChild<QComboBox*>("columnMeaning");
    ASSERT_TRUE(QTest::qWaitFor([&] { return box && box->view()->isVisible(); }, kPatience_ms)) << "the list opens";
    const int row = box->findData(static_cast<int>(meaning));
    box->view()->setCurrentIndex(box->model()->index(row, 0));
    QTest::keyClick(box->view(), Qt::Key_Return);
    ASSERT_TRUE(QTest::qWaitFor([&] { return columns.viewport()->findChild<QComboBox*>("columnMeaning") == nullptr; },
                                kPatience_ms));
    EXPECT_EQ(cell.data(Qt::EditRole).toInt(), static_cast<int>(meaning));
  }
  void choose(const char* box, const QString& text) { in<QComboBox>(box).setCurrentText(text); }
  /// What the dialog writes, which is open in the Network scene then.
  void import(const fs::path& samples) {
    in<QLineEdit>("importSamplesFile").setText(QString::fromStdString(samples.string()));
    network.clear();
    QTest::mouseClick(&in<QPushButton>("importStart"), Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms)) << problem().toStdString();
    ASSERT_TRUE(QTest::qWaitFor([&] { return window.findChild<ImportDialog*>() == nullptr; }, kPatience_ms));
    dialog = nullptr;
  }

  ImportDialog* dialog = nullptr;

private:
  QTemporaryDir folder_;
};

/// Twelve rows; the force has a name that no program would guess.
std::string foreignTable() {
  std::string table = "Rig of the cellar\nt_ms;ch1;ch2;Druck\n";
  for (int k = 0; k < 12; ++k)
    table += std::to_string(k) + ";" + std::to_string(k) + ",5;" + std::to_string(3 * k % 7) + ",25;-" +
             std::to_string(k % 5) + ",5\n";
  return table;
}

TEST_F(ImportWindow, ADroppedTableIsImportedByMouseAndItsMapGivesTheSameSamplesToTheCommandLine) {
  const fs::path table = write("rig.csv", foreignTable());
  dropOn(window, QString::fromStdString(table.string()));
  dialog = window.findChild<ImportDialog*>();
  ASSERT_NE(dialog, nullptr);
  answered();
  EXPECT_EQ(problem(), "no column is a force or a position yet");
  EXPECT_FALSE(ready());
  EXPECT_TRUE(verdict().contains("2 readings: ch1 to ch2, signals")) << verdict().toStdString();
  const QString what = in<QLabel>("importedTables").text();
  EXPECT_TRUE(what.contains("separator semicolon, decimal comma, names in line 2")) << what.toStdString();
  EXPECT_TRUE(what.contains("Rig of the cellar")) << what.toStdString();
  assign(3, ColumnMeaning::Fz);
  ASSERT_TRUE(QTest::qWaitFor([&] { return problem().contains("forces: has no \"unit\""); }, kPatience_ms))
      << problem().toStdString();
  choose("forceUnit", "mN");
  ASSERT_TRUE(QTest::qWaitFor([&] { return ready(); }, kPatience_ms)) << problem().toStdString();
  EXPECT_EQ(problem(), QString());
  EXPECT_TRUE(verdict().contains("12 samples")) << verdict().toStdString();
  EXPECT_TRUE(verdict().contains("Fz -0.0045 to -0.0005 N")) << verdict().toStdString();

  const fs::path file = folder() / "mine.csv", again = folder() / "again.csv";
  import(file);
  EXPECT_EQ(window.currentScene().objectName(), "network");
  EXPECT_EQ(network.samples()->training.size() + network.samples()->test.size(), 12);
  EXPECT_TRUE(network.samples()->training.origin.ofSignals);
  EXPECT_DOUBLE_EQ(network.samples()->training.forces_N(2, 1), -1.5e-3);
  const fs::path map = folder() / "rig.csv.map.json";
  ASSERT_TRUE(fs::exists(map));
  importSamples({{table}, map, nullptr, again}, {}, {});
  EXPECT_EQ(readFile(again), readFile(file));

  open({table}); // with the map that is next to it
  EXPECT_TRUE(ready()) << problem().toStdString();
  EXPECT_TRUE(verdict().contains("rig.csv.map.json")) << verdict().toStdString();
  dialog->reject();
}

TEST_F(ImportWindow, ABrokenTableIsRefusedInTheWordsOfTheCommandLine) {
  const fs::path table = write("broken.csv", "ch1,ch2,Fz_N\n1,2,-3\n1,off,-2\n2,3,-1\n4,1,-2\n");
  open({table});
  std::string said;
  try {
    importSamples({{table}, {}, nullptr, folder() / "never.csv"}, {}, {});
  } catch (const std::exception& error) {
    said = error.what();
  }
  EXPECT_NE(said.find("line 3: column ch2: got \"off\""), std::string::npos) << said;
  EXPECT_EQ(problem().toStdString(), said);
  EXPECT_FALSE(ready());
  QTest::mouseClick(&in<QCheckBox>("leaveOutBadRows"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return ready(); }, kPatience_ms)) << problem().toStdString();
  EXPECT_TRUE(verdict().contains("3 samples; 1 rows left out")) << verdict().toStdString();
  EXPECT_FALSE(fs::exists(folder() / "never.csv"));
  dialog->reject();
}

TEST_F(ImportWindow, MarkedColumnsAreAssignedTogether) {
  const fs::path table = write("plain.txt", "1 2 3 4\n2 3 1 5\n3 1 2 4\n4 4 2 5\n");
  open({table});
  auto& columns = in<ImportColumns>("importColumns");
  const auto head = [&](int column, Qt::KeyboardModifiers modifiers) {
    QTest::mouseClick(columns.horizontalHeader()->viewport(), Qt::LeftButton, modifiers,
                      {columns.horizontalHeader()->sectionViewportPosition(column) + 30, 5});
  };
  head(0, {});
  head(2, Qt::ShiftModifier);
  assign(1, ColumnMeaning::Reading);
  for (const int column : {0, 1, 2})
    EXPECT_EQ(columns.model()->index(0, column).data().toString(), "Reading") << column;
  EXPECT_EQ(columns.model()->index(0, 3).data().toString(), "Leave out");
  assign(3, ColumnMeaning::Fx); // which is not marked
  EXPECT_EQ(columns.model()->index(0, 2).data().toString(), "Reading");
  choose("forceUnit", "N");
  ASSERT_TRUE(QTest::qWaitFor([&] { return ready(); }, kPatience_ms)) << problem().toStdString();
  QTest::mouseClick(&in<QCheckBox>("importOfDesign"), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return problem().contains("row-wires; the design has"); }, kPatience_ms))
      << problem().toStdString();
  EXPECT_FALSE(ready());
  dialog->reject();
}

TEST_F(ImportWindow, TwoTablesOfOneRecordingAreJoinedAndFurtherOnesAreRuns) {
  const fs::path channels = write("channels.csv", "ch1,ch2\n1,2\n2,3\n3,1\n4,2\n5,1\n"),
                 forces =
                     write("forces.csv", "fx,fy,fz,x,y\n1,2,-3,1,1\n2,1,-4,1,2\n1,1,-5,2,1\n1,2,-2,2,2\n0,1,-1,3,3\n");
  open({channels, forces});
  EXPECT_TRUE(ready()) << problem().toStdString();
  EXPECT_TRUE(verdict().contains("5 samples")) << verdict().toStdString();
  import(folder() / "joined.h5");
  EXPECT_EQ(network.samples()->training.places_mm.rows(), 2);

  const fs::path day1 = write("day1.csv", "ch1,Fz_N\n1,-2\n2,-3\n3,-4\n"),
                 day2 = write("day2.csv", "ch1,Fz_N\n1,-1\n2,-3\n");
  open({day1, day2});
  EXPECT_TRUE(verdict().contains("5 samples in 2 runs")) << verdict().toStdString();
  dialog->reject();
}

TEST_F(ImportWindow, TheFormOfTheTextCanBeCorrectedAndOtherFilesAreNamedForWhatTheyAre) {
  const fs::path table = write("table.csv", "Rig;7\nch1;Fz\n1;-2\n2;-3\n3;-1\n");
  open({table});
  in<QSpinBox>("importNamesLine").setValue(1);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return in<ImportColumns>("importColumns").model()->headerData(0, Qt::Horizontal).toString() == "Rig"; },
      kPatience_ms));
  dialog->reject();
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.findChild<ImportDialog*>() == nullptr; }, kPatience_ms));

  QString said;
  QTimer closer;
  QObject::connect(&closer, &QTimer::timeout, &closer, [&] {
    if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
      said = box->text();
      box->close();
    }
  });
  closer.start(20);
  const fs::path sheet = write("sheet.csv", std::string("\x1f\x8b\x08\x00", 4) + "...");
  dropOn(window, QString::fromStdString(sheet.string()));
  EXPECT_TRUE(said.contains("is compressed by gzip")) << said.toStdString();
  EXPECT_EQ(window.findChild<ImportDialog*>(), nullptr);
}

} // namespace
} // namespace palp
