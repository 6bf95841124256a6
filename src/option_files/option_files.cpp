#include "option_files/option_files.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <sstream>

namespace grid_path_planner::option_files {

using base::configName;
using base::decimalText;
using base::InputError;
using base::OptionDescription;
using base::OptionType;

namespace {

constexpr std::size_t kColumns = 120;
const std::string kEnd = "<!-- end -->";

// A number with a decimal point, so that YAML and Python take it for one that need not be whole.
std::string withPoint(std::string number) {
  if (number.find_first_of(".n") == std::string::npos)  // n: of inf and nan
    number.insert(std::min(number.find('e'), number.size()), ".0");
  return number;
}

// 1e6 for 1000000.
std::string limitText(double limit) {
  const std::string text = decimalText(limit);
  const std::size_t zeros = text.size() - 1 - text.find_last_not_of('0');
  if (zeros < 5) return text;
  return text.substr(0, text.size() - zeros) + 'e' + std::to_string(zeros);
}

std::string join(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

// "0..1000 m", the choices, or nothing.
std::string valuesOf(const OptionDescription& option) {
  if (!option.choices.empty()) return join(option.choices, ", ");
  std::vector<std::string> words;
  if (std::isfinite(option.minimum) || std::isfinite(option.maximum))
    words.push_back(limitText(option.minimum) + ".." + limitText(option.maximum));
  if (!option.unit.empty()) words.push_back(option.unit);
  return join(words, " ");
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') out += '\\';
    out += letter;
  }
  return out + '"';
}

// Whether YAML reads the text as a string without quotes.
bool isPlain(const std::string& text) {
  static const std::set<std::string> words = {"true", "false", "yes", "no", "on",
                                              "off",  "null",  "y",   "n"};
  if (text.empty() || std::isalpha(static_cast<unsigned char>(text[0])) == 0) return false;
  std::string lower;
  for (const unsigned char letter : text) {
    if (std::isalnum(letter) == 0 && letter != '_') return false;
    lower += static_cast<char>(std::tolower(letter));
  }
  return words.count(lower) == 0;
}

std::string yamlValue(const OptionDescription& option) {
  if (option.type == OptionType::NUMBER) return withPoint(option.value);
  if (option.type == OptionType::TEXT && !isPlain(option.value)) return quoted(option.value);
  return option.value;
}

// The name's part before the '/', and the one behind it.
std::pair<std::string, std::string> nestedName(const std::string& name) {
  const std::size_t slash = name.find('/');
  if (slash == std::string::npos) return {"", name};
  return {name.substr(0, slash), name.substr(slash + 1)};
}

std::string yamlEntry(const OptionDescription& option) {
  const auto [group, name] = nestedName(option.name);
  return (group.empty() ? "" : "  ") + name + ": " + yamlValue(option);
}

// `entry`, and from `column` on the comment, over as many lines as it needs.
std::string withComment(const std::string& entry, const std::string& comment, std::size_t column) {
  std::string text, line = entry + std::string(column - entry.size(), ' ') + "#";
  std::istringstream words(comment);
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > kColumns) {
      text += line + '\n';
      line = std::string(column, ' ') + "#";
    }
    line += ' ' + word;
  }
  return text + line + '\n';
}

std::string yamlComment(const OptionDescription& option) {
  const std::string values = valuesOf(option);
  return (values.empty() ? "" : "[" + values + "] ") + option.description;
}

bool hasNestedNames(const NodeOptions& node) {
  return std::any_of(node.options.begin(), node.options.end(), [](const OptionDescription& each) {
    return each.name.find('/') != std::string::npos;
  });
}

std::string cfgDefault(const OptionDescription& option) {
  switch (option.type) {
    case OptionType::TRUTH:
      return option.value == "true" ? "True" : "False";
    case OptionType::WHOLE_NUMBER:
      return option.value;
    case OptionType::NUMBER:
      return withPoint(option.value);
    case OptionType::TEXT:
      break;
  }
  return quoted(option.value);
}

const char* cfgType(OptionType type) {
  switch (type) {
    case OptionType::TRUTH:
      return "bool_t";
    case OptionType::WHOLE_NUMBER:
      return "int_t";
    case OptionType::NUMBER:
      return "double_t";
    case OptionType::TEXT:
      break;
  }
  return "str_t";
}

std::string cfgEntry(const OptionDescription& option) {
  const std::string name = configName(option.name);
  const std::string values = option.choices.empty() ? valuesOf(option) : "";
  const std::string description = option.description + (values.empty() ? "" : " [" + values + "]");
  std::string entry = "gen.add(" + quoted(name) + ", " + cfgType(option.type) + ", 0, " +
                      quoted(description) + ", " + cfgDefault(option);
  if (!option.choices.empty()) {
    std::vector<std::string> choices;
    for (const std::string& choice : option.choices) choices.push_back(quoted(choice));
    entry += ",\n        edit_method=choices(" + quoted(name) + ", [" + join(choices, ", ") + "])";
  }
  return entry + ")\n";
}

std::string tableRow(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += cell.empty() ? " |" : " " + cell + " |";
  return row;
}

std::string code(const std::string& text) {
  return "`" + text + "`";
}

}  // namespace

std::string yamlOf(const NodeOptions& node) {
  std::string text =
      "# Parameters of " + node.node +
      " with their defaults. Each can be changed while the node runs (rqt_reconfigure) but where\n"
      "# it says so; what is out of limits or contradictory is refused, never clamped.\n";
  if (hasNestedNames(node))
    text += "# In rqt_reconfigure a parameter of a group, sensor_model/hit, is sensor_model_hit.\n";
  text += "# Generated from the options in the source code by option_files; do not edit.\n";
  std::size_t column = 0;
  for (const OptionDescription& option : node.options)
    column = std::max(column, yamlEntry(option).size() + 2);
  std::string group;
  for (const OptionDescription& option : node.options) {
    if (&option == &node.options.front() || !option.heading.empty()) text += '\n';
    if (!option.heading.empty()) text += "# ---- " + option.heading + '\n';
    const std::string its_group = nestedName(option.name).first;
    if (its_group != group && !its_group.empty()) text += its_group + ":\n";
    group = its_group;
    text += withComment(yamlEntry(option), yamlComment(option), column);
  }
  return text;
}

std::string cfgOf(const NodeOptions& node) {
  std::string text =
      "#!/usr/bin/env python3\n"
      "# Generated from the options in the source code by option_files; do not edit. There is no\n"
      "# min and max here: dynamic_reconfigure would clamp to them without a word.\n"
      "from dynamic_reconfigure.parameter_generator_catkin import *\n\n"
      "gen = ParameterGenerator()\n\n\n"
      "def choices(name, values):\n"
      "    return gen.enum([gen.const(name + \"_\" + value, str_t, value, value)"
      " for value in values], name)\n\n\n";
  for (const OptionDescription& option : node.options) text += cfgEntry(option);
  return text + "\nexit(gen.generate(\"grid_path_planner\", " + quoted(node.node) + ", " +
         quoted(node.config) + "))\n";
}

std::string tableOf(const NodeOptions& node) {
  std::string text = tableRow({"parameter", "default", "values", ""}) + "\n|---|---|---|---|";
  for (const OptionDescription& option : node.options) {
    if (!option.heading.empty())
      text += '\n' + tableRow({"**" + option.heading + "**", "", "", ""});
    text += '\n' + tableRow({code(option.name), code(yamlValue(option)), valuesOf(option),
                             option.description});
  }
  return text;
}

std::string withTables(const std::string& page, const std::vector<NodeOptions>& nodes) {
  const std::string opening = "<!-- parameters: ", closing = " -->";
  std::string made;
  std::size_t done = 0;
  while (true) {
    const std::size_t at = page.find(opening, done);
    if (at == std::string::npos) return made + page.substr(done);
    const std::size_t name_at = at + opening.size();
    const std::size_t name_end = page.find(closing, name_at);
    const std::size_t end_at = page.find(kEnd, name_at);
    if (name_end == std::string::npos || end_at == std::string::npos || name_end > end_at)
      throw InputError("the table behind '" + page.substr(at, 40) + "' has no " + kEnd);
    const std::string name = page.substr(name_at, name_end - name_at);
    const auto node = std::find_if(nodes.begin(), nodes.end(),
                                   [&name](const NodeOptions& each) { return each.node == name; });
    if (node == nodes.end()) throw InputError("there is no node '" + name + "'");
    made += page.substr(done, name_end + closing.size() - done) + '\n' + tableOf(*node) + '\n';
    done = end_at;
  }
}

std::string withText(const std::string& page, const std::string& opening, const std::string& text) {
  const std::size_t at = page.find(opening);
  if (at == std::string::npos) return page;
  const std::size_t end = page.find(kEnd, at);
  if (end == std::string::npos)
    throw InputError("what stands behind '" + opening + "' has no " + kEnd);
  return page.substr(0, at + opening.size()) + '\n' + text + '\n' + page.substr(end);
}

}  // namespace grid_path_planner::option_files
