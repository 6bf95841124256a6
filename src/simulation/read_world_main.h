// The program that readWorld() starts (base/child_process.h).
#pragma once

namespace grid_path_planner::simulation {

int readWorldMain(int argc, char** argv);

}  // namespace grid_path_planner::simulation
