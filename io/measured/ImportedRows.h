#pragma once

// Private to io.

#include "io/measured/ImportMap.h"
#include "io/measured/MeasuredTable.h"

#include <Eigen/Core>

#include <memory>
#include <stop_token>

namespace palp {

/// One sample as a map reads it, in ohm (or as measured, of signals), N, mm and s.
struct ImportedRow {
  Eigen::VectorXd readings;
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  Eigen::Vector2d place_mm = Eigen::Vector2d::Zero();
  double area = 0; ///< as written, counted from 0
  double run = 0;  ///< of the map's column
  double time_s = 0;
};

/// What happened besides rows.
struct ImportedCounts {
  std::size_t outsideClock = 0; ///< rows at times for which another clock has no values
  std::size_t inGaps = 0;       ///< rows between two values too far apart
};

/// The rows of one run: of one table, of tables that have the same rows, or of tables with clocks of their own, whose
/// values are interpolated.
class ImportedRows {
public:
  /// Opens the tables and finds the map's columns. Throws Error: map, column, and the columns that there are; Cancelled
  /// where a table of another clock is loaded.
  ImportedRows(const ImportMap& map, const std::string& mapFile, std::vector<std::filesystem::path> tables,
               const std::stop_token& stop);
  ~ImportedRows();

  /// The next row; false at the end. `problems` gets what is wrong with it, each beginning with table and line; the row
  /// is of no use then.
  bool next(ImportedRow& row, std::vector<std::string>& problems);
  [[nodiscard]] double share() const;
  /// Where the last row is: "table.csv, line 12".
  [[nodiscard]] std::string where() const;
  /// Columns of the tables that the map does not name.
  [[nodiscard]] std::size_t unusedColumns() const;
  [[nodiscard]] const ImportedCounts& counts() const { return counts_; }
  /// How the tables were read, and rates of clocks: sentences.
  [[nodiscard]] std::vector<std::string> notes() const;

private:
  struct Table;
  struct Group;
  struct Series;

  Table& table(int index);
  std::size_t add(Table& table, const ColumnName& column, ChosenColumn::As as);
  void addGroup(Group& group, const ImportedGroup& source, Quantity quantity, const char* key);
  double unitFactor(Table& table, const ImportedGroup& group, Quantity quantity, const char* key);
  double clockFactor(Table& table, const ImportedClock& clock);
  void loadSeries(Group& group, const std::stop_token& stop);
  bool interpolate(Group& group, double time_s);
  void take(const Group& group, double* to, std::vector<std::string>& problems) const;
  void resistances(Eigen::VectorXd& readings, std::vector<std::string>& problems) const;
  [[nodiscard]] bool nextOfTables(std::vector<std::string>& problems);
  [[noreturn]] void refuseColumn(const Table& table, const ColumnName& column) const;

  const ImportMap& map_;
  std::string mapFile_;
  std::vector<std::unique_ptr<Table>> tables_; ///< of which rows are read together
  std::vector<std::filesystem::path> files_;
  std::unique_ptr<Group> readings_, forces_, places_, area_, rotation_;
  std::size_t run_ = 0, time_ = 0; ///< columns chosen of the readings' table
  double timeFactor_ = 1;
  ImportedCounts counts_;
};

} // namespace palp
