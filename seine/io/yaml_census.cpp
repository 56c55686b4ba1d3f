#include "seine/io/yaml_census.hpp"

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <sstream>

#include "seine/io/message.hpp"

namespace seine::io {
namespace {

constexpr int kDeepest = 40;  // levels; a scenario has seven
constexpr int kMostValues =
    1'200'000;  // a scenario at its largest; the library takes some 400 bytes for each

/// Counts levels and values, builds nothing.
class DepthHandler final : public YAML::EventHandler {
 public:
  explicit DepthHandler(const std::string& file) : file_(file) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { count(mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { count(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t, const std::string&) override {
    count(mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    enter(mark);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    enter(mark);
  }
  void OnMapEnd() override { --depth_; }

 private:
  void count(const YAML::Mark& mark) {
    if (++values_ > kMostValues)
      throw complaint(file_, mark.line + 1, joined("has more than ", kMostValues, " values up to here"));
  }
  void enter(const YAML::Mark& mark) {
    count(mark);
    if (++depth_ > kDeepest) throw complaint(file_, mark.line + 1, "is nested too deeply");
  }

  const std::string& file_;
  int depth_ = 0;
  int values_ = 0;
};

// What no file of ours has and the library takes long over.
void expect_ordinary(std::string_view text, const std::string& file) {
  constexpr std::size_t kLongestWord = 4096, kLongestRun = 4096,
                        kLongestLine = std::size_t{1} << 20;  // bytes
  const auto parts = [](char c) {
    return std::string_view(" \n\r\t,:[]{}").find(c) != std::string_view::npos;
  };
  std::size_t word = 0, run = 0, in_line = 0;
  int line = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    word = parts(c) ? 0 : word + 1;
    run = i > 0 && text[i - 1] == c ? run + 1 : 1;
    in_line = c == '\n' ? 0 : in_line + 1;
    if (word > kLongestWord)
      throw complaint(file, line, joined("has a word of more than ", kLongestWord, " bytes"));
    if (run > kLongestRun)
      throw complaint(file, line, joined("has one character more than ", kLongestRun, " times in a row"));
    if (in_line > kLongestLine)
      throw complaint(file, line, joined("has a line of more than ", kLongestLine, " bytes"));
    line += c == '\n' ? 1 : 0;
  }
}

}  // namespace

std::string yaml_complaint(const std::string& said) {
  std::string shown = said.substr(0, 80);
  for (char& c : shown) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte > 0x7e) c = '?';  // of a character beyond ASCII the library shows but one byte
  }
  return joined("is not valid YAML: ", shown);
}

void expect_one_shallow_document(std::string_view text, const std::string& file) {
  expect_ordinary(text, file);
  try {
    std::istringstream stream{std::string(text)};
    YAML::Parser parser(stream);
    DepthHandler handler(file);
    if (!parser.HandleNextDocument(handler)) throw complaint(file, 1, "is empty, expected YAML");
    // Not YAML::LoadAll: in version 0.7 it finds endless empty documents in a text that begins with a comma.
    if (parser) throw complaint(file, 1, "goes on after its first YAML document, expected one");
  } catch (const YAML::DeepRecursion& error) {
    throw complaint(file, error.mark.line + 1, "is nested too deeply");
  } catch (const YAML::Exception& error) {
    throw complaint(file, error.mark.line + 1, yaml_complaint(error.msg));
  }
}

}  // namespace seine::io
