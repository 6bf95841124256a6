// The corners of a tag to a fraction of a pixel: a line is fitted to each side, and neighbouring lines intersect.
//
// Across each side the brightness is read along many short profiles, from the black border into the white margin.
// A profile reaches less far than one of the tag's cells is wide, as it is seen, and in the end no farther than a pixel
// blurs: what is beyond the border and the margin is in none of them (opencv#24113: windows of a fixed size take in other
// cells of small tags), nor a change of brightness beside the edge. All of a side counts, so that noise averages out, but
// for what lies off the line of most: a pipe may hide a part. Not allowed for: lines that a lens bends within one tag, and
// cells narrower than 2 pixels, whose corners err by 0.08 pixels where others do by 0.02.
#pragma once

#include <optional>

#include "vision/grey_image.h"

namespace grid_path_planner::vision {

// `corners` are right to about a pixel. None where the sides cannot be fitted: what is right to a pixel only
// would count as much as the others.
std::optional<PixelCorners> refinedCorners(const GreyImage& image, const PixelCorners& corners);

}  // namespace grid_path_planner::vision
