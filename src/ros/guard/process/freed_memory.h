// What becomes of memory that a program has freed.
//
//   returnFreedMemory();  // at its beginning
//
// glibc's allocator keeps freed blocks of up to 32 MB for the next ones, once the first of such a size was freed; of what lies
// below a block that is still in use nothing goes back to the system. A node whose maps come and go held half as
// much again as it used. After this blocks of 8 MB and more are mapped one by one and go back when they are freed. Smaller
// ones, and other allocators, stay as they are.
#pragma once

namespace grid_path_planner::nodes {

void returnFreedMemory();

}  // namespace grid_path_planner::nodes
