// Replaced by the first file of this room.
namespace grid_path_planner {}
