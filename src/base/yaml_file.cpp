#include "grid_path_planner/base/yaml_file.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "grid_path_planner/base/text_file.h"

namespace grid_path_planner {
namespace {

bool isBlank(char letter) {
  return letter == ' ' || letter == '\t' || letter == '\r';
}

// Walks over YAML text once and counts open brackets and growing indentation.
class NestingMeasure {
 public:
  NestingMeasure(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  void check() {
    enterLine();
    while (at_ < text_.size()) {
      const char letter = text_[at_];
      if (letter == '\n') {
        ++at_;
        ++line_;
        enterLine();
      } else if ((letter == '"' || letter == '\'') && startsToken()) {
        skipQuoted(letter);
      } else if (letter == '#' && (at_ == 0 || isBlank(text_[at_ - 1]) || text_[at_ - 1] == '\n')) {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      } else {
        countBracket(letter);
        ++at_;
      }
    }
  }

 private:
  bool startsToken() const {
    if (at_ == 0) return true;
    const char before = text_[at_ - 1];
    return isBlank(before) || before == '\n' || before == '[' || before == '{' || before == ',' ||
           before == ':';
  }

  // Every column at which a block of this line begins; "- - x" begins three.
  void enterLine() {
    if (!brackets_.empty()) return;
    std::size_t column = 0;
    while (at_ < text_.size()) {
      while (at_ < text_.size() && isBlank(text_[at_])) ++at_, ++column;
      if (at_ == text_.size() || text_[at_] == '\n' || text_[at_] == '#') return;
      while (!columns_.empty() && columns_.back() >= column) columns_.pop_back();
      columns_.push_back(column);
      refuseIfDeep();
      const bool indicator = (text_[at_] == '-' || text_[at_] == '?') &&
                             (at_ + 1 == text_.size() || isBlank(text_[at_ + 1]));
      if (!indicator) return;
      ++at_, ++column;
    }
  }

  void skipQuoted(char quote) {
    for (++at_; at_ < text_.size() && text_[at_] != quote; ++at_) {
      if (text_[at_] == '\n') ++line_;
      if (quote == '"' && text_[at_] == '\\') ++at_;
    }
    ++at_;
  }

  void countBracket(char letter) {
    if (letter == '[' || letter == '{') {
      brackets_ += letter;
      refuseIfDeep();
    } else if ((letter == ']' || letter == '}') && !brackets_.empty()) {
      // yaml-cpp 0.6.2 does not come back from "{a:]".
      if (brackets_.back() != (letter == ']' ? '[' : '{'))
        throw InputError(
            file_, line_,
            std::string("is not YAML: '") + letter + "' closes '" + brackets_.back() + "'");
      brackets_.pop_back();
    }
  }

  void refuseIfDeep() const {
    if (columns_.size() + brackets_.size() > static_cast<std::size_t>(kDeepestYaml))
      throw InputError(file_, line_,
                       "is nested deeper than " + std::to_string(kDeepestYaml) + " levels");
  }

  const std::string& text_;
  const std::string& file_;
  int line_ = 1;
  std::size_t at_ = 0;
  std::string brackets_;  // those that are open
  std::vector<std::size_t> columns_;
};

}  // namespace

YAML::Node loadYamlFile(const std::string& file) {
  return parseYaml(readWholeFile(file, kLargestYaml), file);
}

YAML::Node parseYaml(const std::string& text, const std::string& file) {
  checkIsText(text, file);
  NestingMeasure(text, file).check();
  try {
    // yaml-cpp 0.6.2 fails an assertion where a text ends behind a tag ("!"); this one does not.
    return YAML::Load(text + "\n...\n");
  } catch (const YAML::Exception& error) {
    if (error.mark.is_null()) throw InputError(file, "is not YAML: " + error.msg);
    throw InputError(file, error.mark.line + 1, "is not YAML: " + error.msg);
  }
}

InputError yamlError(const YAML::Node& node, const std::string& file, const std::string& message) {
  const YAML::Mark mark = node.Mark();
  return mark.is_null() ? InputError(file, message) : InputError(file, mark.line + 1, message);
}

std::string describeYaml(const YAML::Node& node) {
  constexpr std::size_t kShown = 40;
  switch (node.Type()) {
    case YAML::NodeType::Undefined:
    case YAML::NodeType::Null:
      return "nothing";
    case YAML::NodeType::Sequence:
      return "a list";
    case YAML::NodeType::Map:
      return "a mapping";
    case YAML::NodeType::Scalar:
      break;
  }
  std::string text = node.Scalar();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.size() <= kShown ? "'" + text + "'" : "'" + text.substr(0, kShown) + "...'";
}

bool yamlHas(const YAML::Node& parent, const std::string& key, const std::string& file) {
  if (!parent.IsMap())
    throw yamlError(parent, file,
                    "expected a mapping with '" + key + "', got " + describeYaml(parent));
  return static_cast<bool>(parent[key]);
}

YAML::Node yamlNode(const YAML::Node& parent, const std::string& key, const std::string& file,
                    const std::string& expected) {
  if (!yamlHas(parent, key, file))
    throw yamlError(parent, file, "has no '" + key + "' (" + expected + ")");
  return parent[key];
}

}  // namespace grid_path_planner
