// Memory whose first touch costs less: the system maps it by pages of 2 MB.
//
//   cells.reserve(count);
//   adviseHugePages(cells.data(), count);  // before anything is written there
//
// A map of 16 million cells that comes is written to 4,096 pages of 4 kB twice, once as roscpp receives it and once as a
// message, and each of them is mapped, cleared and taken back: with maps at 10 Hz a quarter of path_planner's time. Linux does as advised
// where /sys/kernel/mm/transparent_hugepage/enabled is `madvise` or `always`; elsewhere nothing changes.
#pragma once

#include <cstddef>

namespace grid_path_planner::nodes {

// Blocks of so many bytes and more are mapped one by one (freed_memory.h), and the advice ends with them; one that fits
// into what is free of the heap is taken from there, and the advice stays with that part of it.
constexpr std::size_t kLargeBlock = std::size_t{8} << 20;

// Does nothing to smaller ones. Only for memory that will be written to from end to end: else more of it is taken.
void adviseHugePages(void* memory, std::size_t bytes) noexcept;

}  // namespace grid_path_planner::nodes
