// Parts of a report as HTML, and the page that holds them: one file that needs no network.
#pragma once

#include <string>
#include <vector>

#include "study/report/finding.h"

namespace grid_path_planner::study {

// A sortable table in a frame of these classes of style: "wide", "wide tall".
std::string tableHtml(const Table& table, const std::string& frame);

// A chart or picture (SVG) with its caption and the command that made it; "" without one.
std::string figureHtml(const std::string& svg, const std::string& caption,
                       const std::string& command);

// A section: question, answers, charts (HTML), table.
std::string findingHtml(const Finding& finding, const std::string& charts);

// "<li><b>20</b> flights</li>"
std::string fact(std::size_t number, const std::string& singular);

// The first answer of each finding, with a link to it.
std::string firstAnswersHtml(const std::vector<Finding>& findings);

struct PageLink {
  std::string name;  // of the anchor, after "about-"
  std::string text;
};
inline PageLink linkTo(const Finding& finding) {
  return {finding.table.name, finding.question};
}

struct ReportPage {
  std::string title;
  std::string command;  // that made it
  std::string origin;   // more about that, HTML
  std::string summary;  // HTML
  std::vector<PageLink> links;
  std::string main;  // HTML
};

// `pictures`: JSON for the script's viewer of maps (report_pictures.h); {"pictures": []} for none.
std::string pageHtml(const ReportPage& page, const std::string& pictures);

}  // namespace grid_path_planner::study
