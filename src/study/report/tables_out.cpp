#include <nlohmann/json.hpp>

#include "study/report/report.h"

namespace grid_path_planner::study {
namespace {

using nlohmann::json;

json jsonOf(const Table& table) {
  json rows = json::array();
  for (const auto& row : table.rows) {
    json object = json::object();
    for (std::size_t i = 0; i < row.size(); ++i)
      object[table.columns[i]] = row[i].number ? json(*row[i].number) : json(row[i].text);
    rows.push_back(object);
  }
  return rows;
}

}  // namespace

std::string jsonReport(const StudyData& data, const std::vector<Finding>& findings,
                       const std::vector<StudyFailure>& failures) {
  json report = {{"title", data.study().title}, {"maps", json::array()},
                 {"variants", json::array()},   {"settings", json::array()},
                 {"findings", json::array()},   {"failures", json::array()},
                 {"runs", json::array()}};
  for (const StudyMap& map : data.study().maps)
    report["maps"].push_back({{"name", map.name}, {"file", map.file}});
  for (const StudyVariant& variant : data.study().variants)
    report["variants"].push_back(variant.label);
  for (const StudySetting& setting : data.study().settings)
    report["settings"].push_back(setting.label);
  for (const Finding& finding : findings)
    report["findings"].push_back({{"question", finding.question},
                                  {"answers", finding.answers},
                                  {"table", jsonOf(finding.table)}});
  for (const StudyFailure& failure : failures)
    report["failures"].push_back({{"unit", failure.unit}, {"reason", failure.reason}});
  for (const StudyRun& run : data.runs()) report["runs"].push_back(json::parse(lineOf(run)));
  return report.dump(1, ' ', false, json::error_handler_t::replace) + '\n';
}

}  // namespace grid_path_planner::study
