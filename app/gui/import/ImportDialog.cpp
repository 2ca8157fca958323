#include "app/gui/import/ImportDialog.h"

#include "app/gui/import/ImportColumns.h"
#include "app/gui/import/ImportOptions.h"
#include "app/gui/import/ImportWords.h"
#include "app/gui/import/TextFormBar.h"
#include "app/gui/project/FileKind.h"
#include "app/gui/widgets/AccessibleNames.h"
#include "app/gui/widgets/FileDialogs.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/ToolTipWrap.h"
#include "app/gui/widgets/WheelGuard.h"
#include "io/AtomicFile.h"
#include "model/base/Error.h"

#include <QCheckBox>
#include <QDir>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>

#include <algorithm>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr int kVerdictWidth_px = 330, kArraysWidth_px = 200;
constexpr int kProblemLines = 5; ///< that always have room
constexpr int kProgressSteps = 1000;

QString shownPath(const fs::path& path) {
  return QString::fromStdString(path.string());
}

} // namespace

ImportDialog::ImportDialog(const std::vector<fs::path>& files, const SensorDesign& design, QWidget* parent)
    : QDialog(parent), design_(std::make_shared<const SensorDesign>(design)) {
  for (const fs::path& file : files)
    if (fileKind(shownPath(file)) == FileKind::ImportMap)
      map_ = file;
    else
      files_.push_back(file);
  setObjectName("importDialog");
  setWindowTitle(tr("Import measured data"));
  setAttribute(Qt::WA_DeleteOnClose);
  new ToolTipWrap(this);
  new WheelGuard(this);
  build();
  nameControls(*this);
  resize(parent != nullptr ? (parent->size() * 0.94).boundedTo({1280, 820}) : QSize(1180, 760));
  connect(&runner_, &JobRunner::failed, this, &ImportDialog::fail);
  connect(&runner_, &JobRunner::progressed, this,
          [this](double share) { progress_->setValue(static_cast<int>(kProgressSteps * std::max(0.0, share))); });
  connect(&runner_, &JobRunner::finished, this, [this] {
    importing_ = false;
    progress_->setValue(0);
    display();
  });
  proposeFiles();
  read({files_, map_, 0, {}, {}});
  display();
}

void ImportDialog::build() {
  auto* column = new QVBoxLayout(this);
  tables_ = textLabel("importedTables");
  tables_->setMinimumHeight(2 * fontMetrics().lineSpacing());
  tables_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  form_ = new TextFormBar;
  arrays_ = new QListWidget;
  arrays_->setObjectName("importArrays");
  arrays_->setAccessibleName(tr("Arrays of the file"));
  arrays_->setToolTip(tr("Arrays of the file; a click marks the columns of one, to be assigned together"));
  arrays_->setFixedWidth(kArraysWidth_px);
  arrays_->hide();
  columns_ = new ImportColumns;
  options_ = new ImportOptions;
  auto* hint = textLabel("importHint", "hint",
                         tr("Choose what each column is in the row \"Meaning\". Marked heads (drag, or Shift and a "
                            "click) are assigned together."));
  column->addWidget(tables_);
  column->addWidget(form_);
  auto* middle = new QHBoxLayout;
  addTo(*middle, {arrays_, {columns_, 1}, buildVerdict()});
  column->addLayout(middle, 1);
  column->addWidget(hint);
  column->addWidget(options_);
  column->addLayout(buildFiles());
  column->addLayout(buildButtons());
  connect(form_, &TextFormBar::edited, this, [this](const TextForm& form, int tablesOfOneRun) {
    draft_.form = form;
    read({files_, {}, tablesOfOneRun, draft_, opened_});
  });
  connect(arrays_, &QListWidget::itemClicked, this, [this](const QListWidgetItem* item) {
    columns_->markColumns(item->data(Qt::UserRole).toInt(), item->data(Qt::UserRole + 1).toInt());
  });
  connect(columns_, &ImportColumns::assigned, this,
          [this](const std::vector<ColumnPlace>& columns, ColumnMeaning meaning) {
            ImportDraft next = draft_;
            assign(next, opened_->tables, columns, meaning);
            change(next);
          });
  connect(options_, &ImportOptions::edited, this, &ImportDialog::change);
}

QWidget* ImportDialog::buildVerdict() {
  problemLabel_ = textLabel("importProblem", "problem");
  problemLabel_->setAlignment(Qt::AlignTop);
  problemLabel_->setMinimumHeight(kProblemLines * fontMetrics().lineSpacing());
  verdict_ = textLabel("importVerdict");
  verdict_->setAlignment(Qt::AlignTop);
  for (QLabel* label : {problemLabel_, verdict_}) {
    label->setTextFormat(Qt::PlainText);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  }
  auto* words = new QWidget;
  auto* column = new QVBoxLayout(words);
  column->setContentsMargins(6, 0, 6, 0);
  addTo(*column, {problemLabel_, {verdict_, 1}});
  auto* room = new QScrollArea; // of one size, whatever there is to read
  room->setFrameShape(QFrame::NoFrame);
  room->setWidgetResizable(true);
  room->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  room->setFixedWidth(kVerdictWidth_px);
  room->setWidget(words);
  return room;
}

QLayout* ImportDialog::buildFiles() {
  ofDesign_ =
      checkBox(tr("The sensor is the open design (%1 x %2 wires, %3 areas)")
                   .arg(design_->rowWires())
                   .arg(design_->columnWires())
                   .arg(design_->areas.count()),
               "importOfDesign", tr("The samples belong to the open design, whose wires and areas they must have"));
  samples_ =
      lineEdit("importSamplesFile", tr("File that the samples are written to: .h5, .npz or .csv"), tr("Samples file"));
  browse_ = pushButton(tr("Browse..."), "importBrowse");
  saveMap_ = checkBox(QString(), "importSaveMap",
                      tr("The meaning of the columns as JSON. It is used when the table is opened again, and by palp "
                         "import --map."));
  useMap_ = pushButton(tr("Use a map..."), "importUseMap", tr("Takes the meaning of the columns from a JSON file"));
  auto* label = new QLabel(tr("Samples file"));
  label->setBuddy(samples_);
  connect(ofDesign_, &QCheckBox::toggled, this, &ImportDialog::check);
  connect(samples_, &QLineEdit::textChanged, this, &ImportDialog::display);
  connect(browse_, &QPushButton::clicked, this, &ImportDialog::browse);
  connect(useMap_, &QPushButton::clicked, this, &ImportDialog::useMap);
  return inColumn({inRow({saveMap_, useMap_, Part::stretch(), ofDesign_}), inRow({label, {samples_, 1}, browse_})});
}

QLayout* ImportDialog::buildButtons() {
  progress_ = new QProgressBar;
  progress_->setObjectName("importProgress");
  progress_->setAccessibleName(tr("Progress of the import"));
  progress_->setRange(0, kProgressSteps);
  progress_->setTextVisible(false);
  auto* cancel = pushButton(tr("Cancel"), "importCancel");
  cancel->setAutoDefault(false);
  import_ = pushButton(tr("Import"), "importStart", tr("Writes the samples and opens them in the Network scene"));
  for (QPushButton* button : {browse_, useMap_, import_}) button->setAutoDefault(false);
  connect(cancel, &QPushButton::clicked, this, &ImportDialog::reject);
  connect(import_, &QPushButton::clicked, this, &ImportDialog::import);
  return inRow({{progress_, 1}, cancel, import_});
}

/// Next to the table, where that can be written.
void ImportDialog::proposeFiles() {
  const QFileInfo table(shownPath(files_.front()));
  const QFileInfo folder(table.absolutePath());
  const QDir place(folder.isWritable() ? folder.filePath() : QDir::homePath());
  QString name = table.completeBaseName() + "-samples";
  for (int k = 2; place.exists(name + ".h5"); ++k) name = QString("%1-samples-%2").arg(table.completeBaseName()).arg(k);
  samples_->setText(place.filePath(name + ".h5"));
  saveMap_->setText(tr("Save the map as %1 next to the table").arg(shownPath(mapFileOf(files_.front()).filename())));
  saveMap_->setChecked(folder.isWritable());
  saveMap_->setEnabled(folder.isWritable());
}

void ImportDialog::read(TablesRequest request) {
  checked_.reset();
  runner_.start(tr("Reading the table"), [this, request = std::move(request)](const std::stop_token& stop, auto&) {
    auto opened = std::make_shared<const OpenedTables>(openTables(request, stop));
    return [this, opened] { take(opened); };
  });
  display();
}

void ImportDialog::take(const std::shared_ptr<const OpenedTables>& opened) {
  opened_ = opened;
  draft_ = opened->draft;
  displayArrays();
  check();
}

void ImportDialog::change(const ImportDraft& draft) {
  draft_ = draft;
  check();
}

ImportRequest ImportDialog::request(const std::string& map) const {
  ImportRequest request{opened_->files};
  request.mapText = map;
  return request;
}

/// By the code that imports.
void ImportDialog::check() {
  checked_.reset();
  if (!opened_) return;
  try {
    const std::string map = mapText(draft_, opened_->tables);
    const auto design = ofDesign_->isChecked() ? design_ : nullptr;
    runner_.start(tr("Checking the rows"),
                  [this, order = request(map), design](const std::stop_token& stop, JobProgress& progress) {
                    ImportRequest ofDesign = order;
                    ofDesign.design = design.get();
                    const Imported result = checkImport(
                        ofDesign, [&](double share) { progress.set(share, "checking the rows"); }, stop);
                    return [this, result] { takeCheck(result); };
                  });
  } catch (const Error& error) {
    runner_.cancel();
    fail(QString::fromStdString(error.what()));
  }
  display();
}

void ImportDialog::takeCheck(const Imported& result) {
  checked_ = result;
  problem_.clear();
  display();
}

void ImportDialog::fail(const QString& sentence) {
  problem_ = sentence;
  display();
}

/// One question about all files that exist and were not chosen in a dialog, which asks itself.
bool ImportDialog::mayReplace(const fs::path& samples) {
  QStringList existing;
  if (samples != confirmed_ && fs::exists(samples)) existing << shownPath(samples);
  const fs::path map = mapFileOf(files_.front());
  if (saveMap_->isChecked() && fs::exists(map) && opened_->map != map) existing << shownPath(map);
  return existing.isEmpty() ||
         QMessageBox::question(this, windowTitle(), tr("%1 exists. Replace it?").arg(existing.join(tr(" and "))),
                               QMessageBox::Yes | QMessageBox::No, QMessageBox::No) == QMessageBox::Yes;
}

void ImportDialog::import() {
  const fs::path samples = QFileInfo(samples_->text()).absoluteFilePath().toStdString();
  if (!checked_ || !mayReplace(samples)) return;
  const std::string map = mapText(draft_, opened_->tables);
  const fs::path mapFile = saveMap_->isChecked() ? mapFileOf(files_.front()) : fs::path();
  const auto design = ofDesign_->isChecked() ? design_ : nullptr;
  ImportRequest order = request(map);
  order.output = samples;
  order.force = true;
  importing_ = true;
  problem_.clear();
  runner_.start(
      tr("Importing"),
      [this, order, map, mapFile, design](const std::stop_token& stop, JobProgress& progress) {
        ImportRequest ofDesign = order;
        ofDesign.design = design.get();
        const Imported result = importSamples(
            ofDesign, [&](double share) { progress.set(share, "importing"); }, stop);
        if (!mapFile.empty()) writeFile(mapFile, map, true);
        return [this, samples = order.output, count = result.samples] {
          emit imported(samples, count);
          accept();
        };
      },
      JobRunner::Loss::Work);
  display();
}

/// While it imports, only that is cancelled.
void ImportDialog::reject() {
  if (importing_)
    runner_.cancel();
  else
    QDialog::reject();
}

void ImportDialog::browse() {
  const QString file =
      askFileToSave(this, tr("Samples file"), samples_->text(), tr("Samples (*.h5 *.hdf5 *.npz *.csv)"));
  if (file.isEmpty()) return;
  confirmed_ = QFileInfo(file).absoluteFilePath().toStdString();
  samples_->setText(file);
}

void ImportDialog::useMap() {
  const QString file =
      askFileToOpen(this, tr("Use a map"), tr("Maps (*.json)"), shownPath(files_.front().parent_path()));
  if (file.isEmpty()) return;
  map_ = file.toStdString();
  read({files_, map_, 0, {}, {}});
}

void ImportDialog::displayArrays() {
  arrays_->clear();
  std::size_t before = 0; // columns of the tables before
  for (const TablePreview& table : opened_->tables) {
    for (const TablePreview::Array& array : table.arrays) {
      if (array.columns == 0) continue;
      auto* item = new QListWidgetItem(
          tr("%1: %2 x %3").arg(QString::fromStdString(array.name)).arg(array.rows).arg(array.columns), arrays_);
      item->setData(Qt::UserRole, static_cast<int>(before + array.firstColumn));
      item->setData(Qt::UserRole + 1, static_cast<int>(array.columns));
    }
    before += table.columns.size();
  }
  arrays_->setVisible(arrays_->count() > 0);
}

void ImportDialog::display() {
  if (import_ == nullptr) return; // not built yet
  const bool isText = !opened_ || opened_->tables.front().arrays.empty();
  form_->display(draft_.form, isText, opened_ ? static_cast<int>(opened_->tables.size()) : 1,
                 static_cast<int>(files_.size()));
  if (opened_) {
    tables_->setText(tablesWords(*opened_));
    columns_->display(opened_, draft_);
    options_->display(draft_);
    if (checked_ || !problem_.isEmpty()) verdict_->setText(verdictWords(*opened_, checked_ ? &*checked_ : nullptr));
  }
  problemLabel_->setText(problem_);
  for (QWidget* input : std::initializer_list<QWidget*>{columns_, options_, form_, samples_, browse_, useMap_, arrays_})
    input->setEnabled(!importing_);
  import_->setEnabled(checked_ && !importing_ && !samples_->text().isEmpty());
}

} // namespace palp
