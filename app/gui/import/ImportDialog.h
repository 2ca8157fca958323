#pragma once

#include "app/gui/import/OpenedTables.h"
#include "app/gui/jobs/JobRunner.h"
#include "io/ImportSamples.h"
#include "model/SensorDesign.h"

#include <QDialog>

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

class QCheckBox;
class QLabel;
class QLayout;
class QLineEdit;
class QListWidget;
class QProgressBar;
class QPushButton;
class QScrollArea;

namespace palp {

class ImportColumns;
class ImportOptions;
class TextFormBar;

/// Imports tables that another rig measured: shows their first rows, takes the meaning of each column, reports at every
/// change what would be imported or why it cannot be, and writes the samples. What is right is decided by
/// importSamples, as for the command line.
class ImportDialog : public QDialog {
  Q_OBJECT

public:
  /// The tables, and perhaps the map for importing them. `design`: that is open.
  ImportDialog(const std::vector<std::filesystem::path>& files, const SensorDesign& design, QWidget* parent);

  void reject() override;

signals:
  /// The samples were written.
  void imported(const std::filesystem::path& samples, std::size_t count);

private:
  void build();
  QLayout* buildFiles();
  QLayout* buildButtons();
  QWidget* buildVerdict();
  void read(TablesRequest request);
  void take(const std::shared_ptr<const OpenedTables>& opened);
  void change(const ImportDraft& draft);
  void check();
  void takeCheck(const Imported& result);
  void import();
  [[nodiscard]] ImportRequest request(const std::string& map) const;
  [[nodiscard]] bool mayReplace(const std::filesystem::path& samples);
  void proposeFiles();
  void browse();
  void useMap();
  void fail(const QString& sentence);
  void display();
  void displayArrays();

  std::vector<std::filesystem::path> files_;
  std::filesystem::path map_; ///< that came with the files, or was chosen; empty: none
  std::shared_ptr<const SensorDesign> design_;
  std::shared_ptr<const OpenedTables> opened_;
  ImportDraft draft_;
  std::optional<Imported> checked_; ///< the draft as it is; none: not complete, or not checked yet
  QString problem_;
  std::filesystem::path confirmed_; ///< may be replaced, as the user has answered
  bool importing_ = false;

  QLabel *tables_ = nullptr, *problemLabel_ = nullptr, *verdict_ = nullptr;
  TextFormBar* form_ = nullptr;
  QListWidget* arrays_ = nullptr;
  ImportColumns* columns_ = nullptr;
  ImportOptions* options_ = nullptr;
  QCheckBox *ofDesign_ = nullptr, *saveMap_ = nullptr;
  QLineEdit* samples_ = nullptr;
  QPushButton *browse_ = nullptr, *useMap_ = nullptr, *import_ = nullptr;
  QProgressBar* progress_ = nullptr;
  JobRunner runner_; ///< the last member: its work ends first
};

} // namespace palp
