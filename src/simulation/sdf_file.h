// Loads an SDF file with libsdformat; its errors become InputError.
#pragma once

#include <functional>
#include <sdf/sdf.hh>
#include <string>

namespace grid_path_planner::simulation {

// `find` gives the path of an included model for its uri, or "". Throws InputError naming the file,
// with what libsdformat returned and, where that was nothing better than "unable to read", what it
// printed.
sdf::Root loadSdf(const std::string& file,
                  const std::function<std::string(const std::string&)>& find);

}  // namespace grid_path_planner::simulation
