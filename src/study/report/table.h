// A table of results. A cell is a text and, where it has one, a number.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace grid_path_planner::study {

struct TableCell {
  std::string text;
  std::optional<double> number;  // what it sorts by

  TableCell(std::string text) : text(std::move(text)) {}
  TableCell(const char* text) : text(text) {}
  // Shown with `digits` significant digits; NaN is a dash, and no number.
  TableCell(double number, int digits);
};

// Formatted digits, e.g. 0.0123, 4.57, 123, 45,678; whole numbers in full. A dash for NaN.
std::string shownNumber(double number, int digits = 3);

struct Table {
  std::string name;     // of its file, and its anchor
  std::string caption;  // one sentence
  std::vector<std::string> columns;
  std::vector<std::vector<TableCell>> rows;  // each as long as columns
};

// Comma-separated values (RFC 4180), the first line holding the columns. Numbers in full.
std::string csvOf(const Table& table);

}  // namespace grid_path_planner::study
