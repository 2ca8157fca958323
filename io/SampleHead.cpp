#include "io/SampleHead.h"

#include "io/SampleFile.h"
#include "model/Indenter.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace palp {

namespace {

constexpr int kNewestSamples = 1;
constexpr int kLargestCount = 100000;
constexpr std::size_t kPiece = 4 << 20; // bytes of text that are written together
constexpr const char* kFullSolves = "full solves";
constexpr const char* kSurrogate = "surrogate";
constexpr const char* kSignals = "signals"; ///< no resistances

std::string shown(std::string_view value) {
  return "\"" + std::string(value.substr(0, 60)) + (value.size() > 60 ? "..." : "") + "\"";
}

/// Refuses the value of a key of the head.
[[noreturn]] void refuseKey(const SampleLines& lines, const std::string& key, const std::string& got,
                            const std::string& expected) {
  lines.refuse("head above this line, " + key + ": " + gotExpected(got, expected));
}

/// `# key: value` lines, each key at most once.
class HeadLines {
public:
  HeadLines(const SampleLines& lines, std::map<std::string, std::string> values)
      : lines_(lines), values_(std::move(values)) {}

  std::string text(const std::string& key) {
    const auto found = values_.find(key);
    if (found == values_.end()) lines_.refuse("the head above this line lacks \"# " + key + ": ...\"");
    std::string value = found->second;
    values_.erase(found);
    return value;
  }

  [[nodiscard]] bool has(const std::string& key) const { return values_.contains(key); }

  template <class Number> Number number(const std::string& key, Number largest) {
    const std::string value = text(key);
    Number result{};
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), result);
    const bool whole = error == std::errc() && end == value.data() + value.size();
    if (!whole || !(result >= 0) || result > largest)
      refuseKey(lines_, key, shown(value), "a number from 0 to " + plain(largest));
    return result;
  }

  int count(const std::string& key) {
    const int result = number(key, kLargestCount);
    if (result == 0) refuseKey(lines_, key, "0", "1 or more");
    return result;
  }

  void requireAllUsed() {
    if (!values_.empty())
      lines_.refuse("the head above this line has the unknown key " + shown(values_.begin()->first));
  }

private:
  static std::string plain(double value) { return palp::text(value); }
  static std::string plain(std::uint64_t value) { return std::to_string(value); }
  static std::string plain(int value) { return std::to_string(value); }

  const SampleLines& lines_;
  std::map<std::string, std::string> values_;
};

/// Reads `# key: value`.
void readComment(const SampleLines& lines, const std::string& line, std::map<std::string, std::string>& values) {
  const std::size_t colon = line.find(": ");
  if (line.substr(0, 2) != "# " || colon == std::string::npos)
    lines.refuse("line of the head: " + gotExpected(shown(line), "\"# key: value\""));
  const std::string key = line.substr(2, colon - 2);
  if (!values.emplace(key, line.substr(colon + 2)).second) lines.refuse("key " + key + " appears twice");
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

std::size_t fieldCount(std::string_view line) {
  return static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
}

/// By the head; SampleSet::together() asks the samples, which are not there yet.
bool loadedTogether(const SampleSet& head) {
  return head.origin.areas == "together";
}

SampleOrigin readOrigin(const SampleLines& lines, HeadLines& head) {
  SampleOrigin origin;
  origin.designFingerprint = head.text("design");
  if (head.has("readout")) {
    const std::string readout = head.text("readout");
    origin.readout = kReadouts.find(readout);
    if (!origin.readout) refuseKey(lines, "readout", shown(readout), kReadouts.allowed());
  }
  origin.seed = head.number("seed", ~std::uint64_t{0});
  origin.areas = head.text("areas");
  origin.perArea = head.number("per_area", std::numeric_limits<int>::max());
  if (head.has("touch_range")) origin.touches = head.text("touch_range");
  origin.mesh = head.text("mesh");
  origin.solverTolerance = head.number("solver_tolerance", 1e300);
  const std::string kind = head.text("kind");
  if (kind != kFullSolves && kind != kSurrogate)
    refuseKey(lines, "kind", shown(kind), std::string(kFullSolves) + " or " + kSurrogate);
  origin.surrogate = kind == kSurrogate;
  origin.surrogateError = head.number("surrogate_error", 1e300);
  origin.firstSample = head.number("first_sample", ~std::uint64_t{0});
  if (head.has("readings")) {
    const std::string readings = head.text("readings");
    if (readings != kSignals) refuseKey(lines, "readings", shown(readings), kSignals);
    origin.ofSignals = true;
  }
  if (head.has("made_by")) origin.madeBy = head.text("made_by");
  return origin;
}

/// Sets the rows of the matrices by the existing names.
void readColumns(const SampleLines& lines, const std::string& line, SampleSet& set) {
  const auto rowWires = static_cast<Eigen::Index>(set.rowWires);
  const bool displacements = line.find(",u_r") != std::string::npos;
  const bool resistances = line.find(set.origin.ofSignals ? ",S_r" : ",R_r") != std::string::npos;
  const bool touches = !set.origin.touches.empty(); // with places of their own
  set.times_s.resize(line.starts_with("area,time_s,") ? 1 : 0, 0);
  set.runs.resize(line.starts_with("area,run,") || line.starts_with("area,time_s,run,") ? 1 : 0, 0);
  set.touches.resize(touches ? kTouchRows : 0, 0);
  set.places_mm.resize(!touches && line.find(",x_mm,y_mm,") != std::string::npos ? 2 : 0, 0);
  set.forces_N.resize(loadedTogether(set) ? 3 * set.areaCount : 3, 0);
  set.secondTouch.resize(touches && line.find(",shape_2,") != std::string::npos ? kSecondTouchRows : 0, 0);
  set.displacements_mm.resize(displacements ? 3 * rowWires * set.electrodesPerRowWire : 0, 0);
  set.resistances_ohm.resize(resistances ? rowWires * set.columnWires : 0, 0);
  // First the number, so that a head with sizes beyond reason is refused before all their names are made.
  const std::size_t count = fieldCount(line);
  if (count != sampleFields(set))
    lines.refuse("columns: " + gotExpected(std::to_string(count), std::to_string(sampleFields(set)) + " by the head"));
  const std::string expected = sampleColumns(set);
  const std::vector<std::string_view> names = split(line);
  const std::vector<std::string_view> wanted = split(expected);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] != wanted[i])
      lines.refuse("column " + std::to_string(i + 1) + " is " + shown(names[i]) + "; by the head it must be " +
                   shown(wanted[i]));
}

void requireArea(const SampleLines& lines, const SampleSet& head, int area) {
  const auto refuse = [&](const std::string& expected) {
    lines.refuse("area: " + gotExpected(std::to_string(area), expected));
  };
  if (loadedTogether(head) && area != -1) refuse("-1: by the head all areas are loaded together");
  if (!loadedTogether(head) && (area < 0 || area >= head.areaCount))
    refuse("0 to " + std::to_string(head.areaCount - 1));
}

/// Whether this row of this part has shapes.
bool isShape(Eigen::MatrixXd SampleSet::*part, Eigen::Index row) {
  return (part == &SampleSet::touches || part == &SampleSet::secondTouch) && row == kTouchShape;
}

/// The number of a shape there.
double readShape(const SampleLines& lines, const std::string& name) {
  const auto shape = indenterShape(name);
  if (!shape) lines.refuse("shape: " + gotExpected(shown(name), indenterShapes()));
  return static_cast<double>(*shape);
}

void append(std::string& text, double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.push_back(',');
  text.append(digits.data(), end);
}

} // namespace

std::string sampleFileHead(const SampleSet& set) {
  const SampleOrigin& origin = set.origin;
  std::string head;
  const auto line = [&head](const char* key, const std::string& value) {
    head += std::string("# ") + key + ": " + value + "\n";
  };
  line("palp_samples", std::to_string(kNewestSamples));
  line("design", origin.designFingerprint);
  if (origin.readout) line("readout", kReadouts.name(*origin.readout));
  line("seed", std::to_string(origin.seed));
  line("areas", origin.areas);
  line("per_area", std::to_string(origin.perArea));
  if (!origin.touches.empty()) line("touch_range", origin.touches);
  line("mesh", origin.mesh);
  line("solver_tolerance", text(origin.solverTolerance));
  line("kind", origin.surrogate ? kSurrogate : kFullSolves);
  line("surrogate_error", text(origin.surrogateError));
  line("first_sample", std::to_string(origin.firstSample));
  if (origin.ofSignals) line("readings", kSignals);
  if (!origin.madeBy.empty()) line("made_by", origin.madeBy);
  line("row_wires", std::to_string(set.rowWires));
  line("electrodes_per_row_wire", std::to_string(set.electrodesPerRowWire));
  line("column_wires", std::to_string(set.columnWires));
  line("area_count", std::to_string(set.areaCount));
  return head + sampleColumns(set) + "\n";
}

std::string sampleColumns(const SampleSet& set) {
  std::string names = "area";
  if (set.times_s.rows() > 0) names += ",time_s";
  if (set.runs.rows() > 0) names += ",run";
  if (set.touches.rows() > 0) names += ",shape,size_mm,friction,x_mm,y_mm";
  if (set.places_mm.rows() > 0) names += ",x_mm,y_mm";
  if (set.forces_N.rows() == 3) {
    names += ",fx_N,fy_N,fz_N";
  } else {
    for (int a = 0; a < set.areaCount; ++a)
      for (const char axis : {'x', 'y', 'z'}) names += ",a" + std::to_string(a) + "_f" + axis + "_N";
  }
  if (set.secondTouch.rows() > 0) names += ",shape_2,size_2_mm,friction_2,x_2_mm,y_2_mm,fx_2_N,fy_2_N,fz_2_N";
  for (int r = 0; r < set.rowWires && set.displacements_mm.rows() > 0; ++r)
    for (int e = 0; e < set.electrodesPerRowWire; ++e)
      for (const char axis : {'x', 'y', 'z'})
        names += ",u_r" + std::to_string(r) + "_e" + std::to_string(e) + "_" + axis + "_mm";
  for (int r = 0; r < set.rowWires && set.resistances_ohm.rows() > 0; ++r)
    for (int c = 0; c < set.columnWires; ++c)
      names += (set.origin.ofSignals ? ",S_r" : ",R_r") + std::to_string(r) + "_c" + std::to_string(c) +
               (set.origin.ofSignals ? "" : "_ohm");
  return names;
}

bool SampleLines::next(std::string& line, bool cutOffIsTheEnd) {
  if (!std::getline(stream_, line)) return false;
  ++line_;
  if (stream_.eof()) { // no line end: its last number may lack digits
    if (cutOffIsTheEnd) return false;
    refuse("cut off in the middle of the line; each line must end with a line break");
  }
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return true;
}

void SampleLines::refuse(const std::string& sentence) const {
  throw Error(file_ + ", line " + std::to_string(line_) + ": " + sentence);
}

SampleSet readSampleHead(SampleLines& lines) {
  std::map<std::string, std::string> values;
  std::string line;
  while (lines.next(line) && !line.empty() && line[0] == '#') readComment(lines, line, values);
  if (values.empty() && line.starts_with('{'))
    lines.refuse("the file contains JSON instead of samples; check for swapped file names");
  HeadLines head(lines, std::move(values));
  const int version = head.number("palp_samples", kLargestCount);
  if (version != kNewestSamples)
    lines.refuse("version: " + gotExpected(std::to_string(version), "1, the version that this Palp reads"));
  SampleSet set;
  set.origin = readOrigin(lines, head);
  set.rowWires = head.count("row_wires");
  set.electrodesPerRowWire = head.count("electrodes_per_row_wire");
  set.columnWires = head.count("column_wires");
  set.areaCount = head.count("area_count");
  head.requireAllUsed();
  readColumns(lines, line, set);
  return set;
}

std::size_t sampleFields(const SampleSet& head) {
  std::size_t fields = 1;
  for (const auto part : kSampleParts) fields += static_cast<std::size_t>((head.*part).rows());
  return fields;
}

void readSampleLine(const SampleLines& lines, std::string_view line, SampleSet& set, Eigen::Index column) {
  const std::size_t count = fieldCount(line);
  if (count != sampleFields(set))
    lines.refuse("fields: " + gotExpected(std::to_string(count), std::to_string(sampleFields(set)) + " by the head"));
  const char* next = line.data();
  const char* const end = line.data() + line.size();
  std::size_t field = 0;
  const auto read = [&](auto& value) {
    const auto [stop, error] = std::from_chars(next, end, value);
    if (error != std::errc() || (stop != end && *stop != ','))
      lines.refuse("field " + std::to_string(field + 1) + ": " +
                   gotExpected(shown(split(line)[field]), "a number (the area: a whole number)"));
    next = stop + 1;
    ++field;
  };
  read(set.area(column));
  requireArea(lines, set, set.area(column));
  for (const auto part : kSampleParts)
    for (Eigen::Index row = 0; row < (set.*part).rows(); ++row) {
      if (isShape(part, row)) {
        const char* const stop = std::find(next, end, ',');
        (set.*part)(row, column) = readShape(lines, std::string(next, stop));
        next = stop == end ? end : stop + 1;
        ++field;
        continue;
      }
      double& value = (set.*part)(row, column);
      read(value);
      if (!std::isfinite(value))
        lines.refuse("field " + std::to_string(field) + ": " + gotExpected(value, "", "a finite number"));
    }
}

void writeSampleLines(const SampleSet& set, const std::function<void(const std::string&)>& write) {
  std::string text;
  for (Eigen::Index i = 0; i < set.size(); ++i) {
    text += std::to_string(set.area(i));
    for (const auto part : kSampleParts)
      for (Eigen::Index row = 0; row < (set.*part).rows(); ++row) {
        if (isShape(part, row))
          text += "," + shapeName(static_cast<IndenterShape>((set.*part)(row, i)));
        else
          append(text, (set.*part)(row, i));
      }
    text.push_back('\n');
    if (i + 1 < set.size() && text.size() < kPiece) continue;
    write(text);
    text.clear();
  }
}

} // namespace palp
