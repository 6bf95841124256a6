#include "study/report/report_page.h"

#include <sstream>

#include "study/report/markup.h"
#include "study/report/report_assets.h"

namespace grid_path_planner::study {
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

}  // namespace

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

std::string findingHtml(const Finding& finding, const std::string& charts) {
  return "<section><h2 id=\"about-" + finding.table.name + "\">" + escaped(finding.question) +
         "</h2>" + answersHtml(finding.answers) + charts +
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

std::string pageHtml(const ReportPage& page, const std::string& pictures) {
  const std::string title = escaped(page.title);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><link rel=\"icon\" href=\"data:,\"><title>" +
      title + "</title><style>" + kReportStyle + "</style></head><body><header><h1>" + title +
      "</h1><p class=\"soft\">Made by <code>" + escaped(page.command) + "</code>" + page.origin +
      "</p>" + page.summary + "</header><nav aria-label=\"Contents\"><ul>";
  for (const PageLink& link : page.links)
    html += "<li><a href=\"#about-" + link.name + "\">" + escaped(link.text) + "</a></li>";
  return html + "</ul></nav><main>" + page.main +
         "</main><script type=\"application/json\" id=\"pictures-data\">" + scriptSafe(pictures) +
         "</script><script>" + kReportScript + "</script></body></html>\n";
}

}  // namespace grid_path_planner::study
