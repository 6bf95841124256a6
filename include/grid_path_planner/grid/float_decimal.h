// The number that was meant by a resolution that went through a message, whose float32 holds 0.05
// as 0.05000000074505806.
#pragma once

namespace grid_path_planner::grid {

// The double with the fewest decimals that rounds to `value`: 0.05f gives 0.05.
double decimalOfFloat(float value);

// The same for a number printed from a float32; other numbers stay as they are.
double floatToDecimal(double value);

}  // namespace grid_path_planner::grid
