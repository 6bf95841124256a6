// Writing a file so that a reader, a crash or a full disk never meets half of one.
#pragma once

#include <string>

namespace grid_path_planner {

// Writes `content` beside `file`, or what a link of that name leads to, and renames it over that.
// Devices and pipes are written to as they are. Throws InputError naming the file and
// the reason; then `file` is as it was and nothing is left beside it. Several threads or processes
// may write the same file: one of them wins.
void writeFileAtomically(const std::string& file, const std::string& content);

}  // namespace grid_path_planner
