#include "study/file/figures_reader.h"

#include "study/study_yaml.h"

namespace grid_path_planner::study {

using base::describeYaml, base::yamlAs, base::yamlError, base::yamlValue, base::yamlValueOr;

namespace {

class FiguresReader {
 public:
  explicit FiguresReader(const StudyNodes& nodes) : file_(nodes.file()) {}

  PublishedFigures read(const YAML::Node& node) {
    checkKeys(node, "published", file_,
              {"source", "group", "planner", "time_s", "cells", "border_cells", "other_group",
               "other_cells", "shortest_percent", "alone_percent", "crossing", "conclusions"});
    PublishedFigures figures;
    figures.source = yamlValue<std::string>(node, "source", file_, "who published them");
    figures.group = yamlValueOr<std::string>(node, "group", file_, "a group of pairs", "");
    figures.planner = yamlValueOr<std::string>(node, "planner", file_, "a planner", "");
    figures.time_s = byKernel<std::string, double>(node, "time_s");
    figures.border_cells = byKernel<int, std::string>(node, "border_cells");
    figures.cells = cellsOf(node);
    figures.other_group = yamlValueOr<std::string>(node, "other_group", file_, "a group", "");
    figures.other_cells = byKernel<int, std::string>(node, "other_cells");
    figures.shortest_percent = mapped<double>(node, "shortest_percent");
    figures.alone_percent = mapped<double>(node, "alone_percent");
    figures.crossing = mapped<std::string>(node, "crossing");
    figures.conclusions = yamlValueOr<bool>(node, "conclusions", file_, "true or false", false);
    return figures;
  }

 private:
  // A mapping of names under `key`; empty without one.
  template <class Value>
  std::map<std::string, Value> mapped(const YAML::Node& node, const char* key) const {
    if (!node[key]) return {};
    return mappingOf<std::string, Value>(node[key], key, file_);
  }

  template <class Key, class Value>
  std::map<Key, std::map<int, Value>> byKernel(const YAML::Node& node, const char* key) const {
    std::map<Key, std::map<int, Value>> figures;
    if (!node[key]) return figures;
    if (!node[key].IsMap())
      throw yamlError(node[key], file_,
                      std::string(key) + " must be a mapping, got " + describeYaml(node[key]));
    for (const auto& entry : node[key])
      figures[yamlAs<Key>(entry.first, key, file_, "what the figures are of")] =
          mappingOf<int, Value>(entry.second, key, file_);
    return figures;
  }

  std::map<int, std::map<int, PublishedCells>> cellsOf(const YAML::Node& node) const {
    std::map<int, std::map<int, PublishedCells>> cells;
    for (const auto& query : byKernel<int, std::string>(node, "cells"))
      for (const auto& figure : query.second)
        cells[query.first][figure.first] = publishedCells(figure.second);
    return cells;
  }

  const std::string& file_;
};

}  // namespace

PublishedFigures readFigures(const YAML::Node& node, const StudyNodes& nodes) {
  return FiguresReader(nodes).read(node);
}

// "164/165/196", where "?" stands for a figure that is missing; anything else is text alone.
PublishedCells publishedCells(const std::string& text) {
  PublishedCells cells;
  cells.text = text;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find('/', begin);
    const std::string part = text.substr(begin, end - begin);
    const bool number = !part.empty() && part.size() < 8 &&
                        part.find_first_not_of("0123456789") == std::string::npos;
    cells.figures.push_back(number ? std::stoi(part) : 0);
    if (end == std::string::npos) break;
    begin = end + 1;
  }
  return cells;
}

}  // namespace grid_path_planner::study
