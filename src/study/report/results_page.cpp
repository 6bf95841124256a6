#include "study/report/results_page.h"

#include <sstream>

#include "study/report/markdown.h"

namespace grid_path_planner::study {
namespace {

std::string picture(const std::string& what, const std::string& name) {
  return name.empty() ? "" : "\n![" + what + "](" + markdownLink(name) + ")\n";
}

}  // namespace

std::string resultsPage(const StudyData& data, const std::vector<Finding>& findings,
                        const ResultsOrigin& origin, const std::string& times_picture,
                        const std::string& paths_picture) {
  std::ostringstream page;
  page << "# Results: " << markdown(data.study().title) << "\n\nWritten on " << origin.date
       << ", with the runs of commit "
       << (origin.commit.empty() ? "(not told)" : markdown(origin.commit)) << " by\n\n"
       << markdownCode(origin.command)
       << "\n\nDo not edit: the command writes it anew. Times are of one machine at one time; "
          "everything else is the same wherever it runs. "
       << shownNumber(static_cast<double>(data.runs().size()), 9)
       << " runs. Where figures were published, they are those of "
       << (data.study().published.source.empty() ? "nobody" : data.study().published.source)
       << ".\n"
       << picture("Planning time of each program over the number of cells", times_picture)
       << picture("A path through blocks that stayed unfilled, and the same with them filled",
                  paths_picture);
  for (const Finding& finding : findings) page << markdownSection(finding);
  return page.str();
}

}  // namespace grid_path_planner::study
