#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "study/findings/finding_text.h"
#include "study/report/markup.h"
#include "study/report/report.h"
#include "study/report/report_assets.h"
#include "study/report/report_pictures.h"
#include "study/report/svg_chart.h"

namespace grid_path_planner::study {

using base::Status;
using grid::GridGeometry;

namespace {

bool numeric(const Table& table, std::size_t column) {
  for (const auto& row : table.rows)
    if (row[column].number) return true;
  return false;
}

std::string cellHtml(const TableCell& cell) {
  std::string html = "<td";
  if (cell.number) {
    std::ostringstream number;
    number.precision(12);
    number << *cell.number;
    html += " class=\"number\" data-n=\"" + number.str() + '"';
  }
  return html + '>' + escaped(cell.text) + "</td>";
}

std::string tableHtml(const Table& table, const std::string& frame) {
  std::string html = "<div class=\"" + frame +
                     "\" tabindex=\"0\"><table class=\"sorts\" id=\"table-" + escaped(table.name) +
                     "\"><caption>" + escaped(table.caption) + "</caption><thead><tr>";
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    html += std::string("<th scope=\"col\"") + (numeric(table, i) ? " class=\"number\"" : "") +
            "><button type=\"button\">" + escaped(table.columns[i]) + "</button></th>";
  html += "</tr></thead><tbody>";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (const TableCell& cell : row) html += cellHtml(cell);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string figureHtml(const std::string& svg, const std::string& caption,
                       const std::string& command) {
  if (svg.empty()) return "";
  return "<figure><div class=\"wide\" tabindex=\"0\"><div class=\"chart\">" + svg +
         "</div></div><figcaption>" + escaped(caption) + " <code>" + escaped(command) +
         "</code></figcaption></figure>\n";
}

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

std::string answersHtml(const std::vector<std::string>& answers) {
  if (answers.empty()) return "";
  constexpr std::size_t kShown = 9;
  std::string html = "<ul>";
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (i == kShown)
      html += "</ul><details><summary>" + std::to_string(answers.size() - kShown) +
              " more</summary><ul>";
    html += "<li>" + escaped(answers[i]) + "</li>";
  }
  return html + (answers.size() > kShown ? "</ul></details>" : "</ul>");
}

std::string findingHtml(const StudyData& data, const Finding& finding, const std::string& command) {
  return "<section><h2 id=\"about-" + finding.table.name + "\">" + escaped(finding.question) +
         "</h2>" + answersHtml(finding.answers) + chartsFor(data, finding, command) +
         tableHtml(finding.table, finding.table.rows.size() > 24 ? "wide tall" : "wide") +
         "</section>\n";
}

std::string fact(std::size_t number, const std::string& singular) {
  return "<li><b>" + shownNumber(static_cast<double>(number), 6) + "</b> " + singular +
         (number == 1 ? "" : "s") + "</li>";
}

std::string firstAnswersHtml(const std::vector<Finding>& findings) {
  std::string html = "<ul>";
  for (const Finding& finding : findings)
    if (!finding.answers.empty())
      html += "<li><a href=\"#about-" + finding.table.name + "\">" + escaped(finding.question) +
              "</a> " + escaped(finding.answers.front()) + "</li>";
  return html + "</ul>";
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
  const std::string title = escaped(data.study().title);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><link rel=\"icon\" href=\"data:,\"><title>" +
      title + "</title><style>" + kReportStyle + "</style></head><body><header><h1>" + title +
      "</h1><p class=\"soft\">Made by <code>" + escaped(command) + "</code>";
  if (!data.study().published.source.empty())
    html += "<br>Published figures: " + escaped(data.study().published.source);
  html += "</p>" + summaryHtml(data, findings) + "</header><nav aria-label=\"Contents\"><ul>";
  for (const Finding& finding : findings)
    html += "<li><a href=\"#about-" + finding.table.name + "\">" + escaped(finding.question) +
            "</a></li>";
  if (!pictures["pictures"].empty()) html += "<li><a href=\"#about-pictures\">The paths</a></li>";
  html +=
      "<li><a href=\"#about-runs\">Every run</a></li></ul></nav><main>" + failuresHtml(failures);
  for (const Finding& finding : findings) html += findingHtml(data, finding, command);
  html += viewerHtml(data, pictures);
  html += "<section><h2 id=\"about-runs\">Every run</h2>" +
          tableHtml(firstRuns(data), "wide tall") +
          "</section></main><script type=\"application/json\" id=\"pictures-data\">" +
          scriptSafe(pictures.dump()) + "</script><script>" + kReportScript +
          "</script></body></html>\n";
  return html;
}

}  // namespace grid_path_planner::study
