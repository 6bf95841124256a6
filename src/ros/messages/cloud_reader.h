// The points of a sensor_msgs/PointCloud2.
//
//   const std::vector<Eigen::Vector3d> points = finitePoints(*message);
//
// The fields x, y and z may stand at any offset, among any others and in any order, each as FLOAT32
// or FLOAT64, of either byte order; the cloud may be organised or not, its rows padded or not. is_dense is not looked at: it
// is true of clouds with NaN, too.
#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <Eigen/Core>
#include <vector>

namespace grid_path_planner::nodes {

// All points without a NaN or infinity, in the cloud's order and frame, m. The sensor's own place, (0, 0, 0), is what some
// drivers have for a ray without return, and no point. Throws InputError with a sentence for a missing field or one of
// another type, and data that is shorter than the fields say.
std::vector<Eigen::Vector3d> finitePoints(const sensor_msgs::PointCloud2& cloud);
// x, y, z of all points, row by row; those that measured nothing too. Throws InputError as above.
std::vector<float> allPoints(const sensor_msgs::PointCloud2& cloud);

}  // namespace grid_path_planner::nodes
