// Trees in OctoMap's two formats: .bt (free, occupied, unknown) and .ot (log odds).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/base/files.h"
#include "mapping/map_tree.h"

namespace grid_path_planner::mapping {

// The format is recognised by the first line. OctoMap's own readers build an arbitrary tree from a
// truncated file; this one throws InputError naming the file where it is missing, is not a tree, is
// a .ot of another kind than OcTree, OcTreeStamped and ColorOcTree, whose colours are passed over, ends early, goes on after the tree, contradicts its header, or needs
// more than `limits`, of which the file and the tree are taken.
std::unique_ptr<MapTree> readTreeFile(const std::string& file, const OctreeOptions& model,
                                      base::ReadLimits& limits);

// What a .ot file of the tree holds, with `comments` as lines of its own after the first one.
std::string treeText(const MapTree& tree, const std::vector<std::string>& comments = {});

// By the file's ending, atomically. Throws InputError naming the file.
void writeTreeFile(const MapTree& tree, const base::OutputFile& file);

}  // namespace grid_path_planner::mapping
