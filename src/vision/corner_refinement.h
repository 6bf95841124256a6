// The corners of a tag to a fraction of a pixel: a line is fitted to each side, and neighbouring lines intersect.
//
// Across each side the brightness is read along many short profiles, from the black border into the white margin.
// A profile reaches less far than one of the tag's cells is wide, as it is seen: what is beyond the border
// and the margin is in none of them (opencv#24113: windows of a fixed size take in other cells of small tags). All
// of a side counts, so that noise averages out, but for what lies off the line of most: a pipe may hide a part. Not
// allowed for: lines that a lens bends within one tag.
#pragma once

#include <optional>

#include "vision/grey_image.h"

namespace grid_path_planner::vision {

// `corners` are right to about a pixel. None where the sides cannot be fitted: what is right to a pixel only
// would count as much as the others.
std::optional<PixelCorners> refinedCorners(const GreyImage& image, const PixelCorners& corners);

}  // namespace grid_path_planner::vision
