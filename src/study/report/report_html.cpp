#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "study/findings/finding_text.h"
#include "study/report/markup.h"
#include "study/report/report.h"
#include "study/report/report_page.h"
#include "study/report/report_pictures.h"
#include "study/report/svg_chart.h"

namespace grid_path_planner::study {

using base::Status;
using grid::GridGeometry;

namespace {

template <class Value>
std::vector<BoxGroup> boxesOf(const StudyData& data, Value&& value) {
  std::vector<BoxGroup> groups;
  for (const ProblemSize& size : data.sizes()) {
    BoxGroup group;
    group.label = sizeText(data, size);
    for (const StudyVariant& variant : data.study().variants)
      group.series.push_back({variant.label, {}});
    for (const StudyRun& run : data.runs()) {
      const ProblemSize of = data.sizeOf(run.setting);
      if (of != size || run.status != Status::FOUND || value(run) <= 0.0) continue;
      group.series[run.variant].values.push_back(value(run));
    }
    groups.push_back(group);
  }
  return groups;
}

std::vector<LineSeries> scalingOf(const StudyData& data) {
  std::vector<LineSeries> series;
  const std::vector<BoxGroup> boxes = boxesOf(data, medianTime);
  const std::vector<ProblemSize> sizes = data.sizes();
  for (std::size_t variant = 0; variant < data.study().variants.size(); ++variant) {
    LineSeries line{data.study().variants[variant].label, {}};
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const std::vector<double>& times = boxes[i].series[variant].values;
      if (!times.empty())
        line.points.emplace_back(blocksOf(data, sizes[i]), quantileOf(times, 0.5));
    }
    series.push_back(line);
  }
  return series;
}

std::string chartsFor(const StudyData& data, const Finding& finding, const std::string& command) {
  if (finding.table.name == "time")
    return figureHtml(boxPlot("Planning time", "ms", boxesOf(data, medianTime)),
                      "Box: quartiles and median; whiskers: extremes. Compare within a "
                      "program: published ones are of another kind than this package's. Made by",
                      command) +
           figureHtml(linePlot("Planning time against the size of the map searched",
                               "cells (blocks) of the map", "ms, median", scalingOf(data)),
                      "Medians. Made by", command);
  if (finding.table.name == "effort")
    return figureHtml(
        boxPlot(
            "Cells expanded", "cells",
            boxesOf(data, [](const StudyRun& run) { return static_cast<double>(run.expanded); })),
        "Made by", command);
  return "";
}

std::string summaryHtml(const StudyData& data, const std::vector<Finding>& findings) {
  std::size_t found = 0;
  for (const StudyRun& run : data.runs()) found += run.status == Status::FOUND ? 1 : 0;
  const std::size_t all = data.units().size() * data.study().variants.size();
  std::string html;
  if (data.runs().size() < all)
    html = "<p class=\"failure\"><b>Not complete:</b> " +
           shownNumber(static_cast<double>(data.runs().size())) + " of " +
           shownNumber(static_cast<double>(all)) +
           " runs are done, and everything below is about those. The same command goes on.</p>";
  html += "<ul class=\"facts\">" + fact(data.study().maps.size(), "map") +
          fact(data.study().settings.size(), "setting") +
          fact(data.study().variants.size(), "variant") + fact(data.units().size(), "question") +
          fact(data.runs().size(), "run") + "<li><b>" + shownNumber(static_cast<double>(found), 6) +
          "</b> found</li></ul>";
  return html + firstAnswersHtml(findings);
}

std::string failuresHtml(const std::vector<StudyFailure>& failures) {
  if (failures.empty()) return "";
  std::string html =
      "<section class=\"failure\"><h2>Not done</h2><p>The same command tries these "
      "again.</p><ul>";
  for (const StudyFailure& failure : failures)
    html += "<li>" + escaped(failure.unit) + ": " + escaped(failure.reason) + "</li>";
  return html + "</ul></section>";
}

std::string viewerHtml(const StudyData& data, const nlohmann::json& pictures) {
  if (pictures["pictures"].empty()) return "";
  std::string html =
      "<section id=\"viewer\"><h2 id=\"about-pictures\">The paths</h2><fieldset><legend>Map and "
      "kernel</legend>";
  for (std::size_t i = 0; i < pictures["pictures"].size(); ++i)
    html += "<label><input type=\"radio\" name=\"picture\" value=\"" + std::to_string(i) + '"' +
            (i == 0 ? " checked" : "") + '>' +
            escaped(pictures["pictures"][i]["name"].get<std::string>()) + "</label>";
  html +=
      "</fieldset><fieldset><legend>Question</legend><label>weights <select id=\"pick-weights\">"
      "</select></label><label>query <select id=\"pick-query\"></select></label></fieldset>"
      "<fieldset><legend>Paths</legend>";
  for (std::size_t i = 0; i < data.study().variants.size(); ++i)
    html += "<label><input type=\"checkbox\" name=\"variant\" value=\"" + std::to_string(i) +
            "\" checked><svg class=\"swatch\" viewBox=\"0 0 36 12\" aria-hidden=\"true\"><path "
            "d=\"M0 6h36\" stroke-width=\"5\" stroke=\"" +
            seriesColour(i) + "\" stroke-dasharray=\"" + seriesDash(i) + "\"/></svg>" +
            escaped(data.study().variants[i].label) + "</label>";
  return html +
         "</fieldset><figure><svg id=\"map\" role=\"img\"></svg><figcaption>Light: free, grey: "
         "unknown, dark: occupied, as searched. White disc: start, yellow square: goal. One query "
         "chosen: each path's figures and the command that plans it.</figcaption></figure>"
         "<ul id=\"results\" aria-live=\"polite\"></ul></section>";
}

// Browsers are slow with more rows; the file has all.
Table firstRuns(const StudyData& data) {
  constexpr std::size_t kMostRows = 2000;
  Table table = runsTable(data);
  if (table.rows.size() <= kMostRows) return table;
  table.caption += " The first " + shownNumber(kMostRows) + " of " +
                   shownNumber(static_cast<double>(table.rows.size()), 9) +
                   "; runs.csv has them all.";
  table.rows.erase(table.rows.begin() + kMostRows, table.rows.end());
  return table;
}

}  // namespace

std::string reportHtml(const StudyData& data, const std::vector<Finding>& findings,
                       const std::vector<StudyFailure>& failures, const std::string& command) {
  const nlohmann::json pictures = pictureData(data);
  std::string more = "";
  if (!data.study().published.source.empty())
    more = "<br>Published figures: " + escaped(data.study().published.source);
  ReportPage page{data.study().title, command, more, summaryHtml(data, findings), {}, {}};
  for (const Finding& finding : findings) page.links.push_back(linkTo(finding));
  if (!pictures["pictures"].empty()) page.links.push_back({"pictures", "The paths"});
  page.links.push_back({"runs", "Every run"});
  page.main = failuresHtml(failures);
  for (const Finding& finding : findings)
    page.main += findingHtml(finding, chartsFor(data, finding, command));
  page.main += viewerHtml(data, pictures) + "<section><h2 id=\"about-runs\">Every run</h2>" +
               tableHtml(firstRuns(data), "wide tall") + "</section>";
  return pageHtml(page, pictures.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace grid_path_planner::study
