#include "seine/io/yaml_reader.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_set>

#include "seine/geom/pose2.hpp"
#include "seine/io/message.hpp"
#include "seine/io/number_text.hpp"
#include "seine/io/reading.hpp"
#include "seine/io/suggestion.hpp"
#include "seine/io/utf8.hpp"
#include "seine/io/yaml_census.hpp"

namespace seine::io {
namespace {

constexpr const char* kWholeFile = "the file";  // what the root is called
constexpr std::string_view kMerge = "<<";       // YAML 1.1's merge key

/// `text` cut to a length that fits a message, control bytes as '?'.
std::string excerpt(std::string_view text) {
  return printable(text, 40);
}

std::string range_text(Range range) {
  return joined("from ", number_text(range.low), " to ", number_text(range.high));
}

}  // namespace

YamlValue YamlValue::parse(std::string_view text, const std::string& file, Reading* reading) {
  expect_one_shallow_document(text, file);
  try {
    const YAML::Node root = YAML::Load(std::string(text));
    if (root.IsNull()) throw complaint(file, 1, "is empty, expected YAML");
    return {root, std::make_shared<const Source>(Source{file, reading}), kWholeFile};
  } catch (const YAML::Exception& error) {
    throw complaint(file, error.mark.line + 1, yaml_complaint(error.msg));
  }
}

void YamlValue::fail(const std::string& message) const {
  throw complaint(source_->file, line(), what_ + " " + message);
}

std::string YamlValue::where() const {
  return joined(source_->file, ":", line());
}

void YamlValue::note(const std::string& message) const {
  if (source_->reading != nullptr)
    source_->reading->notes.push_back(joined(where(), ": ", what_, " ", message));
}

std::string YamlValue::found() const {
  if (node_.IsScalar()) return joined("'", excerpt(node_.Scalar()), "'");
  if (node_.IsNull()) return "nothing";
  return node_.IsSequence() ? "a list" : "a map";
}

const std::string& YamlValue::scalar(const char* expected) const {
  if (!node_.IsScalar()) fail(joined("is ", found(), ", expected ", expected));
  return node_.Scalar();
}

double YamlValue::number(Range range) const {
  const std::string& text = scalar("a number");
  const std::optional<double> value = parse_number(text);
  if (!value) fail(joined("is ", found(), ", expected a finite number"));
  if (!(range.low <= *value && *value <= range.high))
    fail(joined("is ", excerpt(text), ", expected ", range_text(range)));
  return *value;
}

double YamlValue::number_or_infinity(Range range) const {
  if (node_.IsScalar() && (node_.Scalar() == ".inf" || node_.Scalar() == "+.inf")) {
    return std::numeric_limits<double>::infinity();
  }
  return number(range);
}

double YamlValue::angle(Range range) const {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const std::string_view text = scalar("an angle");
  std::string_view digits = text;
  for (const std::string_view unit : {"degrees", "degree", "deg", "\u00b0"}) {
    if (!digits.ends_with(unit)) continue;
    digits.remove_suffix(unit.size());
    digits.remove_suffix(digits.size() - (digits.find_last_not_of(' ') + 1));
    break;
  }
  const std::optional<double> value = parse_number(digits);
  if (!value) fail(joined("is ", found(), ", expected an angle in radians, or in degrees as in '90 deg'"));
  const double angle = digits.size() < text.size() ? *value * kDegree : *value;
  if (!(range.low <= angle && angle <= range.high)) {
    fail(joined(
        "is ", excerpt(text), ", expected ", range_text(range), " rad",
        digits.size() == text.size() ? joined("; degrees are written '", excerpt(text), " deg'") : ""));
  }
  return angle;
}

double YamlValue::heading() const {
  const double given = angle({-1e4, 1e4});
  const bool in_radians = parse_number(node_.Scalar()).has_value();
  if (in_radians && std::abs(given) > 2.0 * std::numbers::pi + 1e-6)
    note(joined("is ", excerpt(node_.Scalar()), " rad, more than a turn: degrees are written '",
                excerpt(node_.Scalar()), " deg'"));
  return geom::wrap_angle(given);
}

long long YamlValue::integer(long long low, long long high) const {
  const std::optional<long long> value = parse_integer(scalar("a whole number"));
  if (!value) fail(joined("is ", found(), ", expected a whole number"));
  if (*value < low || *value > high) {
    fail(joined("is ", found(), ", expected ", low, " to ", high));
  }
  return *value;
}

std::string YamlValue::text() const {
  const std::string& value = scalar("a text");
  if (value.empty()) fail("is empty, expected a text");
  if (value.size() > 200) fail("is too long, expected at most 200 bytes");
  if (!is_utf8(value)) fail("is not UTF-8, expected text in that encoding");
  for (const char c : value) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      fail("has control characters, expected plain text");
  }
  return value;
}

std::vector<YamlValue> YamlValue::list(std::size_t least, std::size_t most) const {
  if (!node_.IsSequence()) fail(joined("is ", found(), ", expected a list"));
  if (node_.size() < least || node_.size() > most) {
    fail(joined(
        "has ", node_.size(), " entries, expected ",
        (least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most))));
  }
  std::vector<YamlValue> values;
  values.reserve(node_.size());
  for (const YAML::Node& entry : node_) {
    values.push_back({entry, source_, joined("entry ", values.size() + 1, " of ", what_)});
  }
  return values;
}

std::vector<double> YamlValue::numbers(std::size_t count, Range range) const {
  std::vector<double> result;
  for (const YamlValue& value : list(count, count)) result.push_back(value.number(range));
  return result;
}

YamlMap YamlValue::map(std::initializer_list<std::string_view> keys) const {
  return read_map(&keys);
}

YamlMap YamlValue::open_map() const {
  return read_map(nullptr);
}

YamlMap YamlValue::read_map(const std::initializer_list<std::string_view>* keys) const {
  if (!node_.IsMap()) fail(joined("is ", found(), ", expected a map of 'key: value'"));
  YamlMap map(*this);
  std::unordered_set<std::string> seen;
  std::vector<YAML::Node> merged;
  for (const auto& entry : node_) {
    const std::string& name = YamlValue(entry.first, source_, joined("a key of ", what_)).scalar("a text");
    const int line = entry.first.Mark().line + 1;
    if (name != kMerge) expect_known(name, line, keys);
    if (!seen.insert(name).second)
      throw complaint(source_->file, line, joined("key '", excerpt(name), "' stands twice in ", what_));
    if (name == kMerge)
      add_merged(entry.second, merged, 0);
    else
      map.entries_.emplace_back(name, value_of(name, entry.second));
  }
  // What stands in the map itself comes first, then the maps it merges, the earlier before the later.
  for (const YAML::Node& source : merged) {
    for (const auto& entry : source) {
      const std::string& name = YamlValue(entry.first, source_, joined("a key of ", what_)).scalar("a text");
      if (name == kMerge || !seen.insert(name).second) continue;
      expect_known(name, entry.first.Mark().line + 1, keys);
      map.entries_.emplace_back(name, value_of(name, entry.second));
    }
  }
  return map;
}

void YamlValue::expect_known(const std::string& name, int line,
                             const std::initializer_list<std::string_view>* keys) const {
  if (keys == nullptr || std::find(keys->begin(), keys->end(), name) != keys->end()) return;
  if (what_ == kWholeFile && name.starts_with("x-")) return;  // a place for anchors
  throw complaint(source_->file, line,
                  joined("unknown key '", excerpt(name), "' in ", what_, did_you_mean(name, {*keys})));
}

YamlValue YamlValue::value_of(const std::string& key, const YAML::Node& node) const {
  const bool top = what_ == kWholeFile;
  return {node, source_, joined("'", excerpt(key), "'", (top ? "" : joined(" of ", what_)))};
}

/// What a merge key names: a map or a list of maps, each followed by what it merges itself.
void YamlValue::add_merged(const YAML::Node& node, std::vector<YAML::Node>& sources, int depth) const {
  constexpr int kDeepest = 20;
  constexpr std::size_t kMost = 1000;  // maps that merge each other twice over would grow without end
  const YamlValue value(node, source_, joined("'<<' of ", what_));
  if (depth > kDeepest || sources.size() > kMost) value.fail("merges too many maps");
  if (node.IsSequence()) {
    for (const YAML::Node& entry : node) add_merged(entry, sources, depth + 1);
    return;
  }
  if (!node.IsMap()) value.fail(joined("is ", value.found(), ", expected a map or a list of maps to merge"));
  sources.push_back(node);
  for (const auto& entry : node)
    if (entry.first.IsScalar() && entry.first.Scalar() == kMerge)
      add_merged(entry.second, sources, depth + 1);
}

std::optional<YamlValue> YamlMap::find(std::string_view key) const {
  const auto entry =
      std::find_if(entries_.begin(), entries_.end(), [&](const auto& e) { return e.first == key; });
  return entry == entries_.end() ? std::nullopt : std::optional(entry->second);
}

YamlValue YamlMap::at(std::string_view key) const {
  std::optional<YamlValue> value = find(key);
  if (!value) self_.fail(joined("has no '", key, "', which is required"));
  return *value;
}

double YamlMap::number(std::string_view key, Range range, double otherwise) const {
  const std::optional<YamlValue> value = find(key);
  return value ? value->number(range) : otherwise;
}

}  // namespace seine::io
