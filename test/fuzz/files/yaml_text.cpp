#include "fuzz/fuzz_target.h"
#include "grid_path_planner/base/yaml_file.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfYamlTexts() {
  return {"a: 1\nb: [1, 2, {c: d}]\n", "- &x [1, 2]\n- *x\n- !!str 3\n",
          "? a\n: |\n  text\n  more\n", "%YAML 1.2\n---\n'a': \"b\\n\"\n...\n",
          "{a: ~, <<: {b: c}}"};
}

FUZZ_TARGET(yaml_text, seedsOfYamlTexts) {
  mayRefuse([&] {
    const YAML::Node root = base::parseYaml(input, "fuzz.yaml");
    base::describeYaml(root);
    base::yamlValueOr<double>(root, "a", "fuzz.yaml", "a number", 0.0);
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
