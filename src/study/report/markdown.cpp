#include "study/report/markdown.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace grid_path_planner::study {
namespace {

constexpr std::size_t kMostRows = 120;
constexpr std::size_t kMostSentences = 12;

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

}  // namespace

std::string markdown(const std::string& text) {
  std::string out;
  for (const char letter : text) {
    if (letter == '|' || letter == '*' || letter == '<') out += '\\';
    out += letter == '\n' || letter == '\r' ? ' ' : letter;
  }
  return out;
}

std::string markdownCode(const std::string& text) {
  std::string out = "    ";
  for (const char letter : text)
    out += letter == '\n' ? std::string("\n    ") : std::string(1, letter);
  return out;
}

std::string markdownLink(const std::string& name) {
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string out;
  for (const char letter : name) {
    const auto byte = static_cast<unsigned char>(letter);
    if (std::isalnum(byte) != 0 || std::strchr("/._-", letter) != nullptr)
      out += letter;
    else
      out += std::string("%") + kHex[byte / 16] + kHex[byte % 16];
  }
  return out;
}

std::string markdownSection(const Finding& finding) {
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

}  // namespace grid_path_planner::study
