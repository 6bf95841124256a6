// Cells of tables that reports of trials share.
#pragma once

#include <string>
#include <vector>

#include "study/report/finding.h"
#include "trials/trial_study.h"

namespace grid_path_planner::trials {

// "0.26 ± 0.39"; a dash for NaN, where there was nothing to compare.
study::TableCell withSpread(double value, double spread);

// Published metres, degrees and m_A of a row; empty cells where it is not published.
std::vector<study::TableCell> publishedCells(const TrialSettings& trial, const std::string& row);

}  // namespace grid_path_planner::trials
