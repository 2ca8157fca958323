#pragma once

#include "model/base/NamedEnum.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace palp {

/// How a text table is read, where it is not to be detected.
struct TextForm {
  char separator = 0; ///< , ; tab or blank; 0: detected
  char decimal = 0;   ///< . or ,; 0: detected
  int namesLine = -1; ///< from 1; 0: no names; -1: detected
  int firstLine = 0;  ///< of the rows, from 1; 0: detected
  bool operator==(const TextForm&) const = default;
};

/// The begin of a measured table, to be looked at while a map is made.
struct TablePreview {
  struct Column {
    std::string name; ///< empty if it has none
    std::string unit; ///< as the table states it, "kohm"; empty if it states none that is known
    bool date = false;
  };
  struct Array {
    std::string name;
    std::uint64_t rows = 0;
    std::size_t firstColumn = 0, columns = 0;
  };
  std::filesystem::path file;
  std::string form;                ///< how the text is read; empty for arrays
  std::vector<std::string> before; ///< the first lines above the table
  std::vector<Column> columns;
  std::vector<Array> arrays;                  ///< of NPZ, HDF5 and MAT files; empty for text
  std::vector<std::vector<std::string>> rows; ///< the first ones, a text for each column
};

/// Reads the names of the columns and the first rows. Throws Error if the file is not a table.
TablePreview previewTable(const std::filesystem::path& file, const TextForm& form, std::size_t rows = 25);

/// Why a file is not a table, by its first bytes: "is an Excel file (xlsx); save the sheet as CSV". Empty if it may be
/// one.
std::string whyNoTable(const std::filesystem::path& file);

/// The map that the names of the columns state, as far as they do (ImportSamples.h).
struct GuessedMap;
GuessedMap guessPartOfMap(const std::vector<TablePreview>& tables);

/// What a column of a measured table is.
enum class ColumnMeaning {
  LeftOut,
  Reading,
  Fx,
  Fy,
  Fz,
  X,
  Y,
  Time,         ///< of the readings
  ForceTime,    ///< clock of the forces, where they have their own
  PositionTime, ///< the same of the positions
  Run,
  Area,
  RotationX, ///< components of the rotation vector of the force sensor
  RotationY,
  RotationZ
};
inline constexpr NamedEnum kColumnMeanings(
    "meaning",
    std::array{std::pair{ColumnMeaning::LeftOut, "Leave out"}, std::pair{ColumnMeaning::Reading, "Reading"},
               std::pair{ColumnMeaning::Fx, "Fx"}, std::pair{ColumnMeaning::Fy, "Fy"},
               std::pair{ColumnMeaning::Fz, "Fz"}, std::pair{ColumnMeaning::X, "x"}, std::pair{ColumnMeaning::Y, "y"},
               std::pair{ColumnMeaning::Time, "Time"}, std::pair{ColumnMeaning::Run, "Run"},
               std::pair{ColumnMeaning::Area, "Area"}, std::pair{ColumnMeaning::ForceTime, "Time of forces"},
               std::pair{ColumnMeaning::PositionTime, "Time of positions"},
               std::pair{ColumnMeaning::RotationX, "Rotation x"}, std::pair{ColumnMeaning::RotationY, "Rotation y"},
               std::pair{ColumnMeaning::RotationZ, "Rotation z"}});

/// A column of one of the tables, both from 0.
struct ColumnPlace {
  std::size_t table = 0, column = 0;
  auto operator<=>(const ColumnPlace&) const = default;
};

/// What the readings are.
enum class ReadingKind { Signal, Resistance, Code, DividerLow, DividerHigh };

/// An import map (resources/docs/formats.md, Import) while it is made: the meaning of each column, and what holds for
/// all readings, forces, positions and times. What it cannot express (factors, offsets, areas by position) stays as in
/// the map that it was made from, as long as the columns concerned keep their meaning.
struct ImportDraft {
  TextForm form;
  int tables = 1;                                   ///< of one recording, as the map states it
  std::vector<std::vector<ColumnMeaning>> meanings; ///< of each table's columns
  std::vector<ColumnPlace> readingOrder;            ///< of the map; further readings follow as they are in the tables
  ReadingKind kind = ReadingKind::Signal;
  std::string readingUnit;                ///< of resistances: as maps name them; of signals: any text
  double ohmPerCode = 1, zero_ohm = 0;    ///< of codes
  double fullScale = 1, resistor_ohm = 1; ///< of dividers
  int rowWires = 1;
  std::string forceUnit, positionUnit, timeUnit; ///< empty: as the tables state them
  bool degrees = false;                          ///< unit of the rotation vector, else radians
  std::array<bool, 3> inverted{};                ///< forces whose sign is turned
  int areaCount = 1, firstArea = 0;
  bool leaveOutBadRows = false;
  std::string base = R"({"palp_import": 1})"; ///< the map that it was made from

  [[nodiscard]] ColumnMeaning meaning(ColumnPlace place) const { return meanings[place.table][place.column]; }
  bool operator==(const ImportDraft&) const = default;
};

/// The draft of a map as JSON, complete or not, for tables of one recording. Throws Error: key, value, and what is
/// expected.
ImportDraft importDraft(const std::string& mapText, const std::vector<TablePreview>& tables);

/// Gives columns a meaning. Forces that are assigned together are summed; other columns that had the meaning lose it,
/// except readings. Units that the tables state replace chosen ones.
void assign(ImportDraft& draft, const std::vector<TablePreview>& tables, const std::vector<ColumnPlace>& columns,
            ColumnMeaning meaning);

/// The map as JSON, to be read by importSamples. Throws Error with what is still missing.
std::string mapText(const ImportDraft& draft, const std::vector<TablePreview>& tables);

/// Units that a map can state: of resistances and conductances, forces, positions and times.
std::vector<std::string> resistanceUnits();
std::vector<std::string> forceUnits();
std::vector<std::string> lengthUnits();
std::vector<std::string> timeUnits();

/// Where the map of a table is looked for and offered to be saved: TABLE.map.json next to it.
std::filesystem::path mapFileOf(const std::filesystem::path& table);

/// How many tables belong to one recording, by their columns: tables that repeat those of the first begin another one.
std::size_t tablesOfOneRun(const std::vector<TablePreview>& tables);

} // namespace palp
