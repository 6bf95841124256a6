// YAML files read so that every mistake in one is told with its file and line.
//
//   const YAML::Node root = loadYamlFile("site.yaml");
//   const auto resolution = yamlValue<double>(root, "resolution", "site.yaml", "metres per cell");
//   const auto frame = yamlValueOr<std::string>(root, "frame_id", "site.yaml", "a name", "map");
//
// yaml-cpp 0.6 recurses for every level of nesting, and some texts it never comes back from. A
// first pass that builds nothing therefore refuses what is nested deeper than kDeepestYaml or makes
// the parser say more than a text of its length can.
//
// A parsed tree takes up to 250 times the memory of its text, which is counted in that first pass
// and refused where it is more than base/read_limits.h allows. Long lists of numbers (the data of a
// map) are therefore read by grid/formats/occupancy_dump.h without one.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <set>
#include <string>
#include <type_traits>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/read_limits.h"

namespace grid_path_planner::base {

constexpr int kDeepestYaml = 64;                           // levels
constexpr std::size_t kLargestYaml = 64u * 1024u * 1024u;  // bytes

// The first document of `file`. Throws InputError for a file that cannot be read (see
// readWholeFile), is not text, is nested too deeply or is not YAML, with the line.
YAML::Node loadYamlFile(const std::string& file, ReadLimits limits = {});

// The same for text that is already in memory; `file` is what errors name. What the tree takes is
// taken of `limits`.
YAML::Node parseYaml(const std::string& text, const std::string& file, ReadLimits& limits);
YAML::Node parseYaml(const std::string& text, const std::string& file);

// An error about `node`, at its line.
InputError yamlError(const YAML::Node& node, const std::string& file, const std::string& message);

// What stands at `node`, in a few words: "'abc'", "a list", "a mapping", "nothing".
std::string describeYaml(const YAML::Node& node);

// The node under `key` of the mapping `parent`. Throws InputError at the parent's line where the
// parent is no mapping or has no such key. `expected` says what should have stood there.
YAML::Node yamlNode(const YAML::Node& parent, const std::string& key, const std::string& file,
                    const std::string& expected);

// Whether the mapping `parent` has `key`. Throws InputError where `parent` is no mapping.
bool yamlHas(const YAML::Node& parent, const std::string& key, const std::string& file);

// Throws InputError with file and line where `node`, which errors call `what`, is no mapping, or has a
// key that is not known, or one twice.
void checkKeys(const YAML::Node& node, const std::string& what, const std::string& file,
               const std::set<std::string>& known);

// The scalar `node` itself as a T; `name` is what the message calls it. Numbers must be finite.
template <class T>
T yamlAs(const YAML::Node& node, const std::string& name, const std::string& file,
         const std::string& expected) {
  try {
    if (!node.IsScalar()) throw YAML::BadConversion(node.Mark());
    const T value = node.as<T>();
    if constexpr (std::is_floating_point_v<T>)
      if (!std::isfinite(value)) throw YAML::BadConversion(node.Mark());
    return value;
  } catch (const YAML::Exception&) {
    throw yamlError(node, file, name + " must be " + expected + ", got " + describeYaml(node));
  }
}

// The value under `key` of the mapping `parent`, which must be there and be a T.
template <class T>
T yamlValue(const YAML::Node& parent, const std::string& key, const std::string& file,
            const std::string& expected) {
  return yamlAs<T>(yamlNode(parent, key, file, expected), key, file, expected);
}

// The same, or `fallback` where there is no such key.
template <class T>
T yamlValueOr(const YAML::Node& parent, const std::string& key, const std::string& file,
              const std::string& expected, const T& fallback) {
  return yamlHas(parent, key, file) ? yamlValue<T>(parent, key, file, expected) : fallback;
}

}  // namespace grid_path_planner::base
