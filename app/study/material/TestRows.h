#pragma once

#include "model/RubberLaw.h"

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace palp {

/// One point of a test of incompressible rubber (TestMode): the stretch of the driven direction, 1 at rest, and its
/// nominal stress, force over the area at rest.
struct TestRow {
  TestMode mode = TestMode::Uniaxial;
  double stretch = 1;
  double stress_MPa = 0;
  double weight = 1; ///< of its squared residual
};

/// Reads a test as CSV with a header: `stretch`, `strain` or `strain_percent` (change of length over length at rest);
/// `stress_MPa`, `stress_kPa` or `stress_Pa` (nominal, negative in compression); and, if wanted, `mode` and `weight`.
/// Fields are separated by commas, semicolons or tabs; lines that begin with # are skipped. Rows without a `mode` get
/// `mode`. Throws Error with file, line, value and what is expected.
std::vector<TestRow> parseTestRows(std::string_view csv, const std::string& file, TestMode mode);

/// The same of a file. Throws Error.
std::vector<TestRow> readTestRows(const std::filesystem::path& path, TestMode mode);

} // namespace palp
