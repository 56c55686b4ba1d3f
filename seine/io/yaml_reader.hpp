#pragma once

#include <yaml-cpp/yaml.h>

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace seine::io {

class YamlMap;
struct Reading;

/// A closed interval a number must lie in.
struct Range {
  double low;
  double high;
};

/// A value in a YAML file that knows where it stands: every complaint names the file, the line and what the
/// value is.
class YamlValue {
 public:
  /// Parses one document. Throws InputError on a syntax error, more than one document or an empty one.
  /// @param file name for messages
  /// @param reading gets the notes, where it is given; outlives the value
  static YamlValue parse(std::string_view text, const std::string& file, Reading* reading = nullptr);

  /// Throws InputError `file:line: <what> <message>`.
  [[noreturn]] void fail(const std::string& message) const;
  int line() const { return node_.Mark().line + 1; }
  /// Where it stands: `file:line`.
  std::string where() const;
  /// Leaves the note `file:line: <what> <message>`: what is read, and may be a slip all the same.
  void note(const std::string& message) const;

  bool is_null() const { return node_.IsNull(); }
  bool is_map() const { return node_.IsMap(); }
  bool is_list() const { return node_.IsSequence(); }
  const std::string& what() const { return what_; }

  double number(Range range) const;
  /// A number in the range, or `.inf` for "no limit".
  double number_or_infinity(Range range) const;
  /// Radians, or degrees where the text says so, as in `90 deg`.
  double angle(Range range) const;
  /// Such an angle as a heading, from −pi to pi; one of more than a turn leaves a note.
  double heading() const;
  long long integer(long long low, long long high) const;
  /// Non-empty, at most 200 bytes of UTF-8, no control characters.
  std::string text() const;
  std::vector<YamlValue> list(std::size_t least, std::size_t most) const;
  /// `count` numbers, as in [x, y].
  std::vector<double> numbers(std::size_t count, Range range) const;
  /// A map whose keys are all among `keys` and occur once. Anything else fails with the nearest key as a
  /// hint.
  YamlMap map(std::initializer_list<std::string_view> keys) const;
  /// A map with any keys, each once, in the order of the file. In both, what a merge key (`<<: *anchor`, or a
  /// list of them) brings comes after the map's own keys and does not replace them.
  YamlMap open_map() const;

 private:
  friend class YamlMap;
  struct Source {
    std::string file;
    Reading* reading;
  };
  YamlValue(const YAML::Node& node, std::shared_ptr<const Source> source, std::string what)
      : node_(node), source_(std::move(source)), what_(std::move(what)) {}
  YamlMap read_map(const std::initializer_list<std::string_view>* keys) const;
  void expect_known(const std::string& name, int line,
                    const std::initializer_list<std::string_view>* keys) const;
  YamlValue value_of(const std::string& key, const YAML::Node& node) const;
  void add_merged(const YAML::Node& node, std::vector<YAML::Node>& sources, int depth) const;
  const std::string& scalar(const char* expected) const;
  std::string found() const;

  YAML::Node node_;
  std::shared_ptr<const Source> source_;
  std::string what_;  ///< "goal of robot 'car0'": how messages call it
};

/// The entries of a YAML map.
class YamlMap {
 public:
  std::optional<YamlValue> find(std::string_view key) const;
  bool has(std::string_view key) const { return find(key).has_value(); }
  /// Fails when it is missing.
  YamlValue at(std::string_view key) const;
  double number(std::string_view key, Range range, double otherwise) const;
  const std::vector<std::pair<std::string, YamlValue>>& entries() const { return entries_; }
  const YamlValue& self() const { return self_; }

 private:
  friend class YamlValue;
  explicit YamlMap(YamlValue self) : self_(std::move(self)) {}
  YamlValue self_;
  std::vector<std::pair<std::string, YamlValue>> entries_;
};

}  // namespace seine::io
