#pragma once

#include "io/ImportDraft.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// Tables of measured data as the import dialog shows them, with the map that is proposed for them.
struct OpenedTables {
  std::vector<std::filesystem::path> files; ///< all: one recording after the other
  std::vector<TablePreview> tables;         ///< of the first recording
  ImportDraft draft;
  std::vector<std::string> assumed; ///< where the map comes from: sentences
  std::filesystem::path map;        ///< that was read; empty: none

  [[nodiscard]] std::size_t recordings() const { return files.size() / tables.size(); }
};

/// How tables are opened.
struct TablesRequest {
  std::vector<std::filesystem::path> files;
  std::filesystem::path map;          ///< empty: the one next to the first table, if there is one
  int tablesOfOneRun = 0;             ///< 0: as the map states, or by the names of the columns
  std::optional<ImportDraft> draft{}; ///< stays where the tables have the columns of `before`
  std::shared_ptr<const OpenedTables> before{};
};

/// Reads the first rows of the tables and proposes a map: that of the request, or the one next to the first table, or
/// what the names of the columns state. Throws Error where a table cannot be read, Cancelled after a stop request. Work
/// for a job.
OpenedTables openTables(const TablesRequest& request, const std::stop_token& stop);

} // namespace palp
