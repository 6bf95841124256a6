// What went wrong, at the doors behind which nothing may be thrown on.
//
//   try { answer(request); } catch (...) { refuse(request, currentErrorText()); }
#pragma once

#include <string>

namespace grid_path_planner::base {

// Of the exception that is being handled, in a sentence. Precondition: called in a catch block.
std::string currentErrorText();

}  // namespace grid_path_planner::base
