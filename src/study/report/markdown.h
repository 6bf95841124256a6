// Findings as Markdown, for pages that are kept in a repository.
#pragma once

#include <string>

#include "study/report/finding.h"

namespace grid_path_planner::study {

// With what Markdown would take for its own escaped, on one line.
std::string markdown(const std::string& text);

// As a block of code in which each line of the text is a line.
std::string markdownCode(const std::string& text);

// The name of a file as the target of a link.
std::string markdownLink(const std::string& name);

// Heading, sentences and table; tables of more rows than people read are named only.
std::string markdownSection(const Finding& finding);

}  // namespace grid_path_planner::study
