#include "grid_path_planner/base/yaml_file.h"

#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <cstddef>
#include <istream>
#include <sstream>
#include <streambuf>
#include <utility>

#include "grid_path_planner/base/files.h"

namespace grid_path_planner::base {
namespace {

// What a tree takes, measured with yaml-cpp 0.6 and 0.7.
constexpr std::size_t kBytesOfNode = 512, kBytesOfAlias = 32;
// The text itself, the copies that the parser makes of it, and what it holds in advance.
constexpr std::size_t kCopiesOfText = 4;

// Listens to a first pass over the text, which builds nothing, and ends it where the nesting gets
// too deep, where there is more to hear than the text can say, or where the tree would be too large.
class Guard : public YAML::EventHandler {
 public:
  Guard(const std::string& file, std::size_t letters, ReadLimits& limits)
      : file_(file), most_(4 * letters + 64), limits_(limits), poll_(limits, file) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { count(mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { count(mark, kBytesOfAlias); }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                const std::string& text) override {
    count(mark, kBytesOfNode + tag.size() + text.size());
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
  void count(const YAML::Mark& mark, std::size_t bytes = kBytesOfNode) {
    if (++heard_ > most_) throw InputError(file_, mark.line + 1, "is not YAML");
    limits_.take(file_, bytes);
    poll_();
  }

  const std::string& file_;
  std::size_t most_;
  ReadLimits& limits_;
  ReadPoll poll_;
  std::size_t heard_ = 0;
  int depth_ = 0;
};

// Hands the text to yaml-cpp in pieces, and ends the reading between two of them: what builds the tree
// asks nobody.
class TextInPieces : public std::streambuf {
 public:
  TextInPieces(std::string& text, const std::string& file, const ReadLimits& limits)
      : file_(file), limits_(limits), next_(text.data()), end_(text.data() + text.size()) {}

 private:
  // yaml-cpp asks the buffer, not the stream, which would keep exceptions for itself.
  int_type underflow() override {
    limits_.goOn(file_);
    if (next_ == end_) return traits_type::eof();
    constexpr std::ptrdiff_t kPiece = 4096;
    char* const begin = next_;
    next_ += std::min(kPiece, end_ - next_);
    setg(begin, begin, next_);
    return traits_type::to_int_type(*begin);
  }

  const std::string& file_;
  const ReadLimits& limits_;
  char* next_;
  char* const end_;
};

// The scanner of yaml-cpp 0.6.2 (Ubuntu 20.04) never ends on ":]", wherever it stands outside
// quotes.
void refuseEndlessText(const std::string& text, const std::string& file) {
  const std::size_t at = text.find(":]");
  if (at == std::string::npos) return;
  const auto line = 1 + std::count(text.begin(), text.begin() + at, '\n');
  throw InputError(file, static_cast<int>(line), "is not YAML: ']' right behind ':'");
}

std::string listOfNames(const std::set<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

YAML::Node loadYamlFile(const std::string& file, ReadLimits limits) {
  return readWithin(file, std::move(limits), [&file](ReadLimits& left) {
    return parseYaml(readWholeFile(file, kLargestYaml, left), file, left);
  });
}

YAML::Node parseYaml(const std::string& text, const std::string& file) {
  return readWithin(file, {}, [&](ReadLimits& limits) { return parseYaml(text, file, limits); });
}

YAML::Node parseYaml(const std::string& text, const std::string& file, ReadLimits& limits) {
  limits.take(file, kCopiesOfText * text.size());
  checkIsText(text, file);
  refuseEndlessText(text, file);
  // yaml-cpp 0.6.2 fails an assertion where a text ends behind a tag ("!"); this one does not.
  std::string ended = text + "\n...\n";
  try {
    std::istringstream first(ended);
    Guard guard(file, ended.size(), limits);
    YAML::Parser(first).HandleNextDocument(guard);
    TextInPieces pieces(ended, file, limits);
    std::istream second(&pieces);
    return YAML::Load(second);
  } catch (const YAML::Exception& error) {
    if (error.mark.is_null()) throw InputError(file, "is not YAML: " + error.msg);
    throw InputError(file, error.mark.line + 1, "is not YAML: " + error.msg);
  }
}

InputError yamlError(const YAML::Node& node, const std::string& file, const std::string& message) {
  const YAML::Mark mark = node.IsDefined() ? node.Mark() : YAML::Mark::null_mark();
  return mark.is_null() ? InputError(file, message) : InputError(file, mark.line + 1, message);
}

std::string describeYaml(const YAML::Node& node) {
  constexpr std::size_t kShown = 40;
  if (!node.IsDefined())
    return "nothing";  // yaml-cpp throws where such a one is asked for its type
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

void checkKeys(const YAML::Node& node, const std::string& what, const std::string& file,
               const std::set<std::string>& known) {
  if (!node.IsMap())
    throw yamlError(node, file, what + " must be a mapping, got " + describeYaml(node));
  std::set<std::string> seen;
  for (const auto& entry : node) {
    const auto key = yamlAs<std::string>(entry.first, "a key", file, "a name");
    if (known.count(key) == 0)
      throw yamlError(entry.first, file,
                      what + " has no '" + key + "'; it has " + listOfNames(known));
    if (!seen.insert(key).second)
      throw yamlError(entry.first, file, what + " has '" + key + "' twice");
  }
}

}  // namespace grid_path_planner::base
