#include "grid_path_planner/base/yaml_file.h"

#include <gtest/gtest.h>

#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::base {
namespace {

using test::contains;
using test::errorText;

TEST(YamlFile, ValuesAreReadByKey) {
  const YAML::Node root = parseYaml("resolution: 0.05\nname: site\n", "site.yaml");
  EXPECT_EQ(yamlValue<double>(root, "resolution", "site.yaml", "metres"), 0.05);
  EXPECT_EQ(yamlValue<std::string>(root, "name", "site.yaml", "a name"), "site");
  EXPECT_EQ(yamlValueOr<int>(root, "negate", "site.yaml", "0 or 1", 7), 7);
}

TEST(YamlFile, AValueOfTheWrongTypeIsNamedWithItsLine) {
  const YAML::Node root = parseYaml("a: 1\nresolution: [1, 2]\nb: abc\nc: .nan\nd:\n", "site.yaml");
  const auto read = [&root](const char* key) {
    return errorText([&] { yamlValue<double>(root, key, "site.yaml", "a number of metres"); });
  };
  EXPECT_EQ(read("resolution"), "site.yaml:2: resolution must be a number of metres, got a list");
  EXPECT_EQ(read("b"), "site.yaml:3: b must be a number of metres, got 'abc'");
  EXPECT_EQ(read("c"), "site.yaml:4: c must be a number of metres, got '.nan'");
  EXPECT_TRUE(contains(read("d"), "d must be a number of metres, got nothing"));
  EXPECT_EQ(read("e"), "site.yaml:1: has no 'e' (a number of metres)");
}

TEST(YamlFile, AFileThatIsNoMappingIsRefused) {
  const YAML::Node root = parseYaml("- 1\n- 2\n", "site.yaml");
  EXPECT_EQ(errorText([&] { yamlValue<int>(root, "x", "site.yaml", "a number"); }),
            "site.yaml:1: expected a mapping with 'x', got a list");
}

TEST(YamlFile, BrokenYamlIsNamedWithItsLine) {
  const std::string text = errorText([] { parseYaml("a: 1\nb: [1, 2\nc: 3\n", "site.yaml"); });
  EXPECT_TRUE(contains(text, "site.yaml:")) << text;
  EXPECT_TRUE(contains(text, "is not YAML")) << text;
}

// yaml-cpp 0.6.2 (Ubuntu 20.04) ends the process on some of these.
TEST(YamlFile, TextsThatEndTooEarlyAreReadOrRefused) {
  for (const char* text :
       {"!", "a: !", "!x", "&a", "a: &b", "- !", "[!", "? !", "a: |", "*a", "--- !"})
    errorText([&] { parseYaml(text, "site.yaml"); });
  EXPECT_EQ(parseYaml("a: 1\n---\nb: 2\n", "site.yaml")["a"].as<int>(), 1);
  EXPECT_EQ(parseYaml("a: |\n  b\n", "site.yaml")["a"].Scalar(), "b\n");
}

// yaml-cpp 0.6.2 does not come back from these.
TEST(YamlFile, TextsThatNeverEndTheParserAreRefused) {
  for (const char* text : {"a: 1\nb: {x: 1, y:]2}\n", "a: 1\nb: [0.25:::]\n", "a: 1\nb: [:]\n"})
    EXPECT_EQ(errorText([&] { parseYaml(text, "site.yaml"); }),
              "site.yaml:2: is not YAML: ']' right behind ':'");
  EXPECT_TRUE(contains(errorText([] { parseYaml("a: [1, 2}\n", "site.yaml"); }), "is not YAML"));
}

TEST(YamlFile, BinaryIsNotText) {
  EXPECT_EQ(errorText([] { parseYaml(std::string("a: 1\nb: \0x\n", 11), "site.yaml"); }),
            "site.yaml:2: is not text: byte 0");
}

TEST(YamlFile, FilesThatAreNotThereAreNamed) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(contains(errorText([&] { loadYamlFile(folder.path("none.yaml")); }),
                       "none.yaml: cannot be read: No such file or directory"));
  EXPECT_TRUE(contains(errorText([&] { loadYamlFile(folder.path("")); }), "is a directory"));
  EXPECT_TRUE(contains(errorText([&] { loadYamlFile(folder.write("empty.yaml", "")); }),
                       "empty.yaml: is empty"));
}

// yaml-cpp 0.6 recurses for every level and ends the process where the stack ends.
TEST(YamlFile, DeepNestingIsRefusedBeforeItIsParsed) {
  constexpr int kDeep = 100000;
  std::string dashes, indented;
  for (int level = 0; level < kDeep; ++level) dashes += "- ";
  for (int level = 0; level < 200; ++level) indented += std::string(level, ' ') + "a:\n";
  for (const std::string& text :
       {std::string(kDeep, '['), "a: " + std::string(kDeep, '{'), dashes + "1", indented}) {
    EXPECT_TRUE(contains(errorText([&] { parseYaml(text, "deep.yaml"); }),
                         "is nested deeper than 64 levels"));
  }
}

TEST(YamlFile, ManyShallowListsAreNotDeep) {
  std::string text = "waypoints:\n";
  for (int i = 0; i < 1000; ++i)
    text += "  - name: \"[[\"  # it's {[\n    position: {x: 1, list: [1, [2]]}\n";
  EXPECT_EQ(parseYaml(text, "wide.yaml")["waypoints"].size(), 1000u);
}

TEST(YamlFile, AnEntryThatIsNotThereIsNothing) {
  const YAML::Node map = YAML::Load("{a: 1}");
  EXPECT_EQ(describeYaml(map["b"]), "nothing");
  const std::string error = errorText([&] { throw yamlError(map["b"], "f.yaml", "b is missing"); });
  EXPECT_TRUE(contains(error, "f.yaml: b is missing")) << error;
}

}  // namespace
}  // namespace grid_path_planner::base
