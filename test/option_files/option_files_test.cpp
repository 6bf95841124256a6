#include "option_files/option_files.h"

#include <gtest/gtest.h>

#include <sstream>

#include "grid_path_planner/base/yaml_file.h"
#include "support/error_text.h"

namespace grid_path_planner::option_files {

using base::describeOptions;
using base::OptionInfo;
using base::parseYaml;

namespace {

using test::errorText;

enum class Colour { RED, GREEN };
const std::vector<std::pair<const char*, Colour>>& choicesOf(Colour) {
  static const std::vector<std::pair<const char*, Colour>> choices = {{"red", Colour::RED},
                                                                      {"green", Colour::GREEN}};
  return choices;
}

const std::vector<std::string>& toolNames() {
  static const std::vector<std::string> names = {"brush", "roller"};
  return names;
}

struct PaintOptions {
  std::string tool = "roller";
  double width = 2.0;
  int layers = 2;
  bool glossy = false;
  std::string name;
  Colour colour = Colour::GREEN;
};

template <class Visitor>
void visitOptions(PaintOptions& o, Visitor&& visit) {
  visit("tool", o.tool, OptionInfo{"What it is done with", ""}.under("Tools").oneOf(toolNames));
  visit("brush/width", o.width, OptionInfo{"Width; wider: faster", "m", 0.001, 2e6});
  visit("brush/layers", o.layers, OptionInfo{"How many layers", "", 1, 10});
  visit("glossy", o.glossy, OptionInfo{"Whether the painter's work shines", ""}.under("Looks"));
  visit("name", o.name, OptionInfo{"What is painted", ""});
  visit("colour", o.colour, OptionInfo{"Colour of the paint", ""});
}

NodeOptions painter(const PaintOptions& options = {}) {
  return {"painter", "Painter", describeOptions(options)};
}

// Behind the comment at its head.
std::string bodyOf(const std::string& yaml) {
  return yaml.substr(yaml.find("\n\n") + 2);
}

TEST(OptionFiles, YamlHasAHeadingAGroupAndACommentForEach) {
  EXPECT_EQ(bodyOf(yamlOf(painter())),
            "# ---- Tools\n"
            "tool: roller   # [brush, roller] What it is done with\n"
            "brush:\n"
            "  width: 2.0   # [0.001..2e6 m] Width; wider: faster\n"
            "  layers: 2    # [1..10] How many layers\n"
            "\n"
            "# ---- Looks\n"
            "glossy: false  # Whether the painter's work shines\n"
            "name: \"\"       # What is painted\n"
            "colour: green  # [red, green] Colour of the paint\n");
}

TEST(OptionFiles, LongCommentsGoOnBelow) {
  NodeOptions node = painter();
  std::string words;
  for (int i = 0; i < 60; ++i) words += (i == 0 ? "word" : " word");
  node.options[3].description = words;
  std::istringstream lines(yamlOf(node));
  int of_words = 0;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 120u) << line;
    if (line.find(" word") == std::string::npos) continue;
    ++of_words;
    EXPECT_EQ(line.find('#'), 15u) << line;
  }
  EXPECT_EQ(of_words, 3);
}

TEST(OptionFiles, YamlReadsBackWhatItSays) {
  for (const char* name : {"", "a", "8", "1.5", "true", "No", "null", "~", "a: b", "#", "a #b",
                           "say \"x\"", "back\\slash", "- x", "/tmp/file.yaml", "-inf"}) {
    PaintOptions options;
    options.name = name;
    options.width = 1e-7;
    const YAML::Node root = parseYaml(yamlOf(painter(options)), "painter.yaml");
    EXPECT_EQ(root["name"].as<std::string>(), name);
    EXPECT_EQ(root["brush"]["width"].as<double>(), 1e-7);
    EXPECT_EQ(root["brush"]["layers"].as<int>(), 2);
    EXPECT_FALSE(root["glossy"].as<bool>());
  }
  PaintOptions options;
  options.name = "8";
  EXPECT_NE(yamlOf(painter(options)).find("name: \"8\""), std::string::npos)
      << "else rosparam reads a number";
}

TEST(OptionFiles, CfgHasEveryOptionWithItsDefaultAndNoLimits) {
  const std::string cfg = cfgOf(painter());
  const std::string from = cfg.substr(cfg.find("gen.add("));
  EXPECT_EQ(from,
            "gen.add(\"tool\", str_t, 0, \"What it is done with\", \"roller\",\n"
            "        edit_method=choices(\"tool\", [\"brush\", \"roller\"]))\n"
            "gen.add(\"brush_width\", double_t, 0, \"Width; wider: faster [0.001..2e6 m]\", 2.0)\n"
            "gen.add(\"brush_layers\", int_t, 0, \"How many layers [1..10]\", 2)\n"
            "gen.add(\"glossy\", bool_t, 0, \"Whether the painter's work shines\", False)\n"
            "gen.add(\"name\", str_t, 0, \"What is painted\", \"\")\n"
            "gen.add(\"colour\", str_t, 0, \"Colour of the paint\", \"green\",\n"
            "        edit_method=choices(\"colour\", [\"red\", \"green\"]))\n"
            "\n"
            "exit(gen.generate(\"grid_path_planner\", \"painter\", \"Painter\"))\n");
}

const char* const kTable =
    "| parameter | default | values | |\n"
    "|---|---|---|---|\n"
    "| **Tools** | | | |\n"
    "| `tool` | `roller` | brush, roller | What it is done with |\n"
    "| `brush/width` | `2.0` | 0.001..2e6 m | Width; wider: faster |\n"
    "| `brush/layers` | `2` | 1..10 | How many layers |\n"
    "| **Looks** | | | |\n"
    "| `glossy` | `false` | | Whether the painter's work shines |\n"
    "| `name` | `\"\"` | | What is painted |\n"
    "| `colour` | `green` | red, green | Colour of the paint |";

TEST(OptionFiles, Table) {
  EXPECT_EQ(tableOf(painter()), kTable);
}

TEST(OptionFiles, TablesStandBetweenTheirMarks) {
  const std::string head = "Text\n<!-- parameters: painter -->\n", tail = "\n<!-- end -->\nMore\n";
  const std::string page = head + kTable + tail;
  EXPECT_EQ(withTables(head + "old\nrows" + tail, {painter()}), page);
  EXPECT_EQ(withTables(page + page, {painter()}), page + page);
  EXPECT_EQ(withTables("no table\n<!-- end -->", {painter()}), "no table\n<!-- end -->");
}

TEST(OptionFiles, AMarkWithoutAnEndOrANodeIsRefused) {
  const auto refusal = [](const std::string& page) {
    return errorText([&] { withTables(page, {painter()}); });
  };
  EXPECT_EQ(refusal("<!-- parameters: painter -->\n"),
            "the table behind '<!-- parameters: painter -->\n' has no <!-- end -->");
  EXPECT_EQ(refusal("<!-- parameters: printer -->\n<!-- end -->"), "there is no node 'printer'");
}

TEST(OptionFiles, ATextStandsBehindItsLine) {
  EXPECT_EQ(withText("a\n<!-- inputs -->\nold\n<!-- end -->\nz\n", "<!-- inputs -->", "new"),
            "a\n<!-- inputs -->\nnew\n<!-- end -->\nz\n");
  EXPECT_EQ(withText("a\n", "<!-- inputs -->", "new"), "a\n");
  EXPECT_NE(errorText([] { withText("<!-- inputs -->", "<!-- inputs -->", ""); }), "");
}

}  // namespace
}  // namespace grid_path_planner::option_files
