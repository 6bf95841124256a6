#include "study/report/results_page.h"

#include <algorithm>
#include <sstream>

namespace grid_path_planner::study {
namespace {

constexpr std::size_t kMostRows = 120;
constexpr std::size_t kMostSentences = 12;

// With what Markdown would take for its own escaped.
std::string markdown(const std::string& text) {
  std::string out;
  for (const char letter : text) {
    if (letter == '|' || letter == '*' || letter == '<') out += '\\';
    out += letter;
  }
  return out;
}

std::string markdownTable(const Table& table) {
  std::string head = "|", line = "|", rows;
  for (const std::string& column : table.columns) {
    head += ' ' + markdown(column) + " |";
    line += "---|";
  }
  for (const auto& row : table.rows) {
    rows += '|';
    for (const TableCell& cell : row) rows += ' ' + markdown(cell.text) + " |";
    rows += '\n';
  }
  return head + '\n' + line + '\n' + rows;
}

std::string sectionOf(const Finding& finding) {
  std::string section = "\n## " + finding.question + "\n\n";
  const std::size_t shown = std::min(finding.answers.size(), kMostSentences);
  for (std::size_t i = 0; i < shown; ++i) section += "- " + markdown(finding.answers[i]) + '\n';
  if (shown < finding.answers.size())
    section +=
        "- and " + std::to_string(finding.answers.size() - shown) + " more, in report.html\n";
  section += (shown > 0 ? "\n" : "") + markdown(finding.table.caption) + "\n\n";
  if (finding.table.rows.size() <= kMostRows) return section + markdownTable(finding.table);
  return section + std::to_string(finding.table.rows.size()) + " rows, in `" + finding.table.name +
         ".csv` of the command's folder.\n";
}

std::string picture(const std::string& what, const std::string& name) {
  return name.empty() ? "" : "\n![" + what + "](" + name + ")\n";
}

}  // namespace

std::string resultsPage(const StudyData& data, const std::vector<Finding>& findings,
                        const ResultsOrigin& origin, const std::string& times_picture,
                        const std::string& paths_picture) {
  std::ostringstream page;
  page << "# Results: " << markdown(data.study().title) << "\n\nWritten on " << origin.date
       << ", with the runs of commit " << (origin.commit.empty() ? "(not told)" : origin.commit)
       << " by\n\n    " << origin.command
       << "\n\nDo not edit: the command writes it anew. Times are of one machine at one time; "
          "everything else is the same wherever it runs. "
       << shownNumber(static_cast<double>(data.runs().size()), 9)
       << " runs. Where figures were published, they are those of "
       << (data.study().published.source.empty() ? "nobody" : data.study().published.source)
       << ".\n"
       << picture("Planning time of each program over the number of cells", times_picture)
       << picture("A path through blocks that stayed unfilled, and the same with them filled",
                  paths_picture);
  for (const Finding& finding : findings) page << sectionOf(finding);
  return page.str();
}

}  // namespace grid_path_planner::study
