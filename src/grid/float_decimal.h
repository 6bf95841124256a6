// Float round trip: the decimal number that a float32 stands for, as messages hold a resolution of
// 0.05 as 0.05000000074505806.
#pragma once

namespace grid_path_planner::grid {

// The double with the fewest decimals that rounds to `value`: 0.05f gives 0.05.
double floatToDecimal(float value);

// The same for a double that equals a float32; other numbers are returned unchanged.
double printedFloatToDecimal(double value);

}  // namespace grid_path_planner::grid
