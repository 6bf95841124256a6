// Findings as Markdown, for pages that are kept in a repository.
#pragma once

#include <string>

#include "study/report/finding.h"

namespace grid_path_planner::study {

// With what Markdown would take for its own escaped.
std::string markdown(const std::string& text);

// Heading, sentences and table; tables of more rows than people read are named only.
std::string markdownSection(const Finding& finding);

}  // namespace grid_path_planner::study
