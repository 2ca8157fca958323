#include "io/StudyFile.h"

#include "io/AtomicFile.h"
#include "io/DesignFile.h"
#include "io/StrictJson.h"
#include "model/base/CounterRandom.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/NumberText.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <regex>

namespace palp {

namespace {

constexpr int kNewestStudy = 1;
constexpr double kMostDesigns = 1e6;

/// The entry under a dotted key, or nothing.
Json* entryAt(Json& design, const std::string& key) {
  Json* at = &design;
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    const std::string name = key.substr(begin, end - begin);
    begin = end + 1;
    if (at->is_object() && at->contains(name)) {
      at = &(*at)[name];
      continue;
    }
    const bool number = !name.empty() && name.size() < 7 &&
                        std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!at->is_array() || !number || std::stoul(name) >= at->size()) return nullptr;
    at = &(*at)[std::stoul(name)];
  }
  return at;
}

StudyAxis axisFrom(const JsonPlace& place, Json& design, bool factorial) {
  StudyAxis axis;
  const bool list = place.has("values");
  if (list)
    place.onlyKeys({"key", "values"});
  else if (factorial)
    place.onlyKeys({"key", "from", "to", "count"}, {"scale"});
  else
    place.onlyKeys({"key", "from", "to"}, {"count", "scale"});
  axis.key = place.at("key").string();
  const Json* entry = entryAt(design, axis.key);
  if (entry == nullptr || entry->is_object())
    place.at("key").refuse(
        "a key of the design, its parts separated by dots and list entries by number: \"block_mm.2\"");
  if (list) {
    for (const JsonPlace& value : place.at("values").list()) axis.values.push_back(value.asJson());
    if (axis.values.empty()) place.at("values").refuse("a list of at least one value");
    return axis;
  }
  if (!entry->is_number()) place.at("key").refuse("a number where the values are a range");
  if (place.has("scale")) {
    const std::string scale = place.at("scale").string();
    if (scale != "linear" && scale != "log") place.at("scale").refuse("linear or log");
    axis.logarithmic = scale == "log";
  }
  axis.from = place.at("from").number();
  axis.to = place.at("to").number();
  if (axis.logarithmic && !(axis.from > 0 && axis.to > 0)) place.refuse("from and to above 0 on a logarithmic scale");
  const double apart = axis.logarithmic ? axis.to / axis.from : axis.to - axis.from;
  if (!std::isfinite(apart) || (axis.logarithmic && apart == 0))
    place.refuse("from and to whose difference (or ratio, on a logarithmic scale) is below 1e308");
  if (place.has("count")) axis.count = place.at("count").integer(2, static_cast<int>(kMostDesigns));
  return axis;
}

Json designOf(const JsonPlace& place, const std::filesystem::path& folder) {
  if (!place.isString()) return Json::parse(toJson(readDesign(place)));
  const std::string named = place.string();
  return Json::parse(toJson(named == "paper" ? paperDesign() : loadDesign(folder / named)));
}

/// Dotted keys of all numbers below an entry.
void listNumbers(const Json& entry, const std::string& key, std::vector<std::string>& keys) {
  if (entry.is_number()) keys.push_back(key);
  if (!entry.is_structured()) return;
  std::size_t i = 0;
  for (const auto& [name, value] : entry.items())
    listNumbers(value, (key.empty() ? "" : key + ".") + (entry.is_array() ? std::to_string(i++) : name), keys);
}

double rangeValue(const StudyAxis& axis, double share) {
  if (axis.logarithmic) return axis.from * std::pow(axis.to / axis.from, share);
  return axis.from + share * (axis.to - axis.from);
}

std::string asNumber(const StudyAxis& axis, double share) {
  if (share <= 0) return text(axis.from);
  return text(share >= 1 ? axis.to : rangeValue(axis, share));
}

/// Numbers 0..count-1 in a random order of this axis (Fisher and Yates's shuffle).
std::vector<std::size_t> shuffled(std::size_t count, std::uint64_t seed, std::uint64_t axis) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = count; i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(uniformAt(seed, axis, i, 0) * static_cast<double>(i))]);
  return order;
}

} // namespace

std::size_t StudyPlan::designs() const {
  if (hypercube > 0) return static_cast<std::size_t>(hypercube);
  std::size_t all = 1;
  for (const StudyAxis& axis : axes)
    all *= axis.values.empty() ? static_cast<std::size_t>(axis.count) : axis.values.size();
  return all;
}

bool StudyPlan::computes(StudyQuantity quantity) const {
  return std::find(quantities.begin(), quantities.end(), quantity) != quantities.end();
}

std::vector<std::string> StudyPlan::values(std::size_t i) const {
  std::vector<std::string> result;
  std::size_t rest = i;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const StudyAxis& axis = axes[a];
    if (hypercube > 0) {
      const double stratum = static_cast<double>(strata[a][i]);
      const double share = (stratum + uniformAt(seed, a, i, 1)) / hypercube; // one point in each stratum of each axis
      const auto count = static_cast<double>(axis.values.size());
      result.push_back(axis.values.empty() ? text(rangeValue(axis, share))
                                           : axis.values[static_cast<std::size_t>(share * count)]);
      continue;
    }
    const std::size_t count = axis.values.empty() ? static_cast<std::size_t>(axis.count) : axis.values.size();
    const std::size_t k = rest % count; // the first axis runs fastest
    rest /= count;
    result.push_back(axis.values.empty() ? asNumber(axis, static_cast<double>(k) / static_cast<double>(count - 1))
                                         : axis.values[k]);
  }
  return result;
}

SensorDesign StudyPlan::at(std::size_t i) const {
  Json varied = Json::parse(design);
  const std::vector<std::string> chosen = values(i);
  for (std::size_t a = 0; a < axes.size(); ++a) *entryAt(varied, axes[a].key) = Json::parse(chosen[a]);
  return parseDesign(jsonText(varied), "design " + std::to_string(i));
}

StudyPlan loadStudy(const std::filesystem::path& path) {
  return parseStudy(readFile(path), path.string(), path.parent_path());
}

StudyPlan parseStudy(const std::string& content, const std::string& name, const std::filesystem::path& folder) {
  const Json json = parseJson(content, name);
  const JsonPlace root(json, name);
  formatVersion(root, "palp_study", kNewestStudy);
  root.onlyKeys({"palp_study", "design", "vary", "compute"},
                {"latin_hypercube", "seed", "noise", "decoders", "per_area", "mesh_size_mm", "mapped", "program"});
  StudyPlan plan;
  Json design = designOf(root.at("design"), folder);
  plan.design = jsonText(design);
  if (root.has("latin_hypercube") && !root.at("latin_hypercube").isNull())
    plan.hypercube = root.at("latin_hypercube").integer(2, static_cast<int>(kMostDesigns));
  double designs = 1;
  for (const JsonPlace& place : root.at("vary").list()) {
    plan.axes.push_back(axisFrom(place, design, plan.hypercube == 0));
    const StudyAxis& axis = plan.axes.back();
    designs *= axis.values.empty() ? axis.count : static_cast<double>(axis.values.size());
    for (std::size_t a = 0; a + 1 < plan.axes.size(); ++a)
      if (plan.axes[a].key == axis.key) place.at("key").refuse("each key once");
  }
  if (plan.axes.empty()) root.at("vary").refuse("a list of at least one key that varies");
  if (plan.hypercube == 0 && designs > kMostDesigns)
    root.at("vary").refuse("at most 1e6 designs, not " + shortText(designs) + ", or latin_hypercube");
  if (root.has("seed")) plan.seed = static_cast<std::uint64_t>(root.at("seed").integer(0, 2'147'483'647));
  for (const JsonPlace& place : root.at("compute").list()) {
    const StudyQuantity quantity = place.named(kStudyQuantities);
    if (plan.computes(quantity)) place.refuse("each once");
    plan.quantities.push_back(quantity);
  }
  if (plan.quantities.empty()) root.at("compute").refuse("a list of " + kStudyQuantities.allowed());
  if (root.has("noise")) plan.noise = root.at("noise").number(1e-9, 0.5);
  if (root.has("per_area")) plan.perArea = root.at("per_area").integer(5, 100000);
  if (root.has("decoders"))
    for (const JsonPlace& place : root.at("decoders").list()) {
      const DecoderKind kind = place.named(kDecoderKinds);
      if (!traits(kind).ofAreas) place.refuse("a decoder of forces on areas");
      if (std::find(plan.decoders.begin(), plan.decoders.end(), kind) != plan.decoders.end()) place.refuse("each once");
      plan.decoders.push_back(kind);
    }
  for (std::size_t a = 0; a < plan.axes.size() && plan.hypercube > 0; ++a)
    plan.strata.push_back(shuffled(plan.designs(), plan.seed, a));
  if (plan.computes(StudyQuantity::Decoders) && plan.decoders.empty()) plan.decoders = {DecoderKind::Rbf};
  if (root.has("mesh_size_mm") && !root.at("mesh_size_mm").isNull())
    plan.meshSize_mm = root.at("mesh_size_mm").number(1e-3, 1e3);
  if (root.has("mapped") && !root.at("mapped").isNull()) {
    if (plan.meshSize_mm) root.at("mapped").refuse("either mapped or mesh_size_mm");
    const std::vector<double> cells = root.at("mapped").numbers(3);
    plan.mapped.emplace();
    for (std::size_t d = 0; d < 3; ++d) {
      if (!(cells[d] >= 1 && cells[d] <= 200 && cells[d] == std::floor(cells[d])))
        root.at("mapped").refuse("three whole numbers from 1 to 200");
      (*plan.mapped)[d] = static_cast<int>(cells[d]);
    }
  }
  return plan;
}

std::vector<std::string> studyKeys(const SensorDesign& design) {
  std::vector<std::string> keys;
  listNumbers(Json::parse(toJson(design)), {}, keys);
  return keys;
}

double studyNumber(const SensorDesign& design, const std::string& key) {
  Json json = Json::parse(toJson(design));
  const Json* entry = entryAt(json, key);
  if (entry == nullptr || !entry->is_number())
    throw Error(
        "key: " +
        gotExpected(quotedText(key), "the key of a number of the design, its parts separated by dots: \"block_mm.2\""));
  return entry->get<double>();
}

StudyAxis studyAxis(const std::string& key, const std::string& words) {
  const auto refuse = [&]() -> void {
    throw Error(key + ": " +
                gotExpected(quotedText(words), "a range like 3..6 x 4, 3..6 x 4 log, or a list like 3, 4.5, 6"));
  };
  StudyAxis axis;
  axis.key = key;
  if (words.find("..") == std::string::npos) {
    const Json list = parseJson("[" + words + "]", key);
    for (const JsonPlace& value : JsonPlace(list, key).list()) axis.values.push_back(value.asJson());
    if (axis.values.empty()) refuse();
    return axis;
  }
  static const std::regex range(
      R"(\s*([-+]?[0-9]+\.?[0-9]*(?:[eE][-+]?[0-9]+)?)\s*\.\.\s*([-+]?[0-9]+\.?[0-9]*(?:[eE][-+]?[0-9]+)?))"
      R"((?:\s*x\s*([0-9]{1,7}))?(\s+log)?\s*)");
  std::smatch parts;
  if (!std::regex_match(words, parts, range)) refuse();
  const auto from = numberIn(parts.str(1)), to = numberIn(parts.str(2));
  if (!from || !to) refuse();
  axis.from = *from;
  axis.to = *to;
  axis.count = parts[3].matched ? std::stoi(parts.str(3)) : 0;
  axis.logarithmic = parts[4].matched;
  return axis;
}

std::string studyWords(const StudyAxis& axis) {
  if (axis.values.empty())
    return text(axis.from) + ".." + text(axis.to) + (axis.count > 0 ? " x " + std::to_string(axis.count) : "") +
           (axis.logarithmic ? " log" : "");
  std::string words;
  for (const std::string& value : axis.values) words += (words.empty() ? "" : ", ") + value;
  return words;
}

std::string toJson(const StudyPlan& plan, const std::string& program) {
  Json json{{"palp_study", kNewestStudy}, {"design", Json::parse(plan.design)}, {"seed", plan.seed},
            {"noise", plan.noise},        {"per_area", plan.perArea},           {"vary", Json::array()},
            {"compute", Json::array()},   {"decoders", Json::array()}};
  if (plan.hypercube > 0) json["latin_hypercube"] = plan.hypercube;
  for (const StudyAxis& axis : plan.axes) {
    Json entry{{"key", axis.key}};
    if (axis.values.empty()) {
      entry["from"] = axis.from;
      entry["to"] = axis.to;
      if (axis.count > 0) entry["count"] = axis.count;
      if (axis.logarithmic) entry["scale"] = "log";
    }
    for (const std::string& value : axis.values) entry["values"].push_back(Json::parse(value));
    json["vary"].push_back(std::move(entry));
  }
  for (const StudyQuantity quantity : plan.quantities) json["compute"].push_back(kStudyQuantities.name(quantity));
  for (const DecoderKind kind : plan.decoders) json["decoders"].push_back(kDecoderKinds.name(kind));
  if (plan.meshSize_mm) json["mesh_size_mm"] = *plan.meshSize_mm;
  if (plan.mapped) json["mapped"] = *plan.mapped;
  if (!program.empty()) json["program"] = program;
  return jsonText(json, 1) + "\n";
}

} // namespace palp
