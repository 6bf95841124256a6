#include "grid_path_planner/mapping/projected_map_options.h"

#include <cmath>
#include <cstdlib>
#include <map>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/options.h"

namespace grid_path_planner::mapping {

using base::checkOptionLimits;
using base::decimalText;
using base::InputError;

namespace {

// The number in `text`, or `fallback` where it says "occupancy".
double heightOf(const std::string& name, const std::string& text, double fallback) {
  if (text == "occupancy") return fallback;
  char* end = nullptr;
  const double height = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(height))
    throw InputError(name + " must be a height in metres or occupancy, got '" + text + "'");
  return height;
}

void checkEnding(const std::string& name, const std::string& file,
                 const std::vector<std::string>& endings) {
  if (file.empty()) return;
  std::string known;
  for (const std::string& ending : endings) {
    if (file.size() > ending.size() &&
        file.compare(file.size() - ending.size(), ending.size(), ending) == 0)
      return;
    known += (known.empty() ? "" : " or ") + ending;
  }
  throw InputError(name + " must end in " + known + ", got '" + file + "'");
}

}  // namespace

ProjectionOptions projectionOptions(const ProjectedMapOptions& o) {
  ProjectionOptions projection = o.projection;
  projection.min_z = heightOf("projection_min_z", o.projection_min_z, o.occupancy_min_z);
  projection.max_z = heightOf("projection_max_z", o.projection_max_z, o.occupancy_max_z);
  return projection;
}

void checkProjectedMapOptions(const ProjectedMapOptions& o) {
  checkOptionLimits(o);
  checkOctreeOptions(o.octree);
  checkCloudFilterOptions(o.cloud);
  if (!(o.occupancy_min_z < o.occupancy_max_z))
    throw InputError("occupancy_min_z must be below occupancy_max_z, got " +
                     decimalText(o.occupancy_min_z) + " and " + decimalText(o.occupancy_max_z));
  checkProjectionOptions(projectionOptions(o));
  if (o.frame_id.empty()) throw InputError("frame_id must name a frame, got ''");
  if (o.base_frame_id.empty()) throw InputError("base_frame_id must name a frame, got ''");
  checkEnding("map_file", o.map_file, {".yaml", ".yml"});
  checkEnding("octree_file", o.octree_file, {".bt", ".ot"});
}

std::string ignoredParameter(const std::string& name) {
  static const std::map<std::string, std::string> sentences = {
      {"incremental_2D_projection", "the projection is always incremental"},
      {"compress_map", "the tree is kept pruned wherever voxels change"},
      {"min_x_size", "projection_bounds fixes the extent of the 2-D map"},
      {"min_y_size", "projection_bounds fixes the extent of the 2-D map"},
      {"filter_speckles", "single voxels are shown and projected like others"},
      {"colored_map", "colours of points are not mapped"}};
  const auto found = sentences.find(name);
  return found == sentences.end() ? "" : found->second;
}

}  // namespace grid_path_planner::mapping
