#include "grid_path_planner/base/yaml_file.h"

#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <cstddef>
#include <sstream>

#include "grid_path_planner/base/files.h"

namespace grid_path_planner::base {
namespace {

// Listens to a first pass over the text, which builds nothing, and ends it where the nesting gets
// too deep or where there is more to hear than the text can say.
class Guard : public YAML::EventHandler {
 public:
  Guard(const std::string& file, std::size_t letters) : file_(file), most_(4 * letters + 64) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { count(mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { count(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                const std::string&) override {
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
  void enter(const YAML::Mark& mark) {
    count(mark);
    if (++depth_ > kDeepestYaml)
      throw InputError(file_, mark.line + 1,
                       "is nested deeper than " + std::to_string(kDeepestYaml) + " levels");
  }
  void count(const YAML::Mark& mark) {
    if (++heard_ > most_) throw InputError(file_, mark.line + 1, "is not YAML");
  }

  const std::string& file_;
  std::size_t most_;
  std::size_t heard_ = 0;
  int depth_ = 0;
};

// The scanner of yaml-cpp 0.6.2 (Ubuntu 20.04) never ends on ":]", wherever it stands outside
// quotes.
void refuseEndlessText(const std::string& text, const std::string& file) {
  const std::size_t at = text.find(":]");
  if (at == std::string::npos) return;
  const auto line = 1 + std::count(text.begin(), text.begin() + at, '\n');
  throw InputError(file, static_cast<int>(line), "is not YAML: ']' right behind ':'");
}

}  // namespace

YAML::Node loadYamlFile(const std::string& file) {
  return parseYaml(readWholeFile(file, kLargestYaml), file);
}

YAML::Node parseYaml(const std::string& text, const std::string& file) {
  checkIsText(text, file);
  refuseEndlessText(text, file);
  // yaml-cpp 0.6.2 fails an assertion where a text ends behind a tag ("!"); this one does not.
  const std::string ended = text + "\n...\n";
  try {
    std::istringstream stream(ended);
    Guard guard(file, ended.size());
    YAML::Parser(stream).HandleNextDocument(guard);
    return YAML::Load(ended);
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

}  // namespace grid_path_planner::base
