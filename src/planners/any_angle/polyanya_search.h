// The search of Polyanya over a mesh of rectangles.
//
// A search node (I, r) is the part of a rectangle's far side that is visible from the root r
// between two rays. It is projected from rectangle to rectangle and split by borders: its
// observable successors. Where it touches a corner at which a taut path can turn, and the turn has
// a successor, the corner becomes a root of its own (non-observable successors): with an interval
// beyond the ray and, where the obstacle's wall lies along the line, with a flat node, which is the
// next corner on the line.
//
// Points and rays are whole numbers and every decision is exact (polyanya_projection.h); only
// lengths are rounded.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "grid_path_planner/base/statistics.h"
#include "grid_path_planner/base/stop_token.h"
#include "planners/any_angle/interval_search.h"
#include "planners/any_angle/polyanya_mesh.h"
#include "planners/any_angle/polyanya_projection.h"
#include "planners/core/stamped_array.h"

namespace grid_path_planner::planners {

class PolyanyaSearch : private IntervalSearch<MeshPoint, PolyanyaNode> {
 public:
  using Answer = IntervalSearch::Answer;

  struct End {
    MeshPoint at;             // inside a cell of
    std::uint32_t rectangle;  // this one
  };

  // `expanded` gets the number of a rectangle for every expansion if it is not null.
  Answer run(const PolyanyaMesh& mesh, End start, End goal, const base::StopToken& stop,
             base::Statistics& counts, std::vector<std::uint32_t>* expanded);

  // Of the last run.
  std::size_t bytes() const;

 private:
  using Direction = PolyanyaMesh::Direction;
  using Heading = PolyanyaMesh::Heading;
  using Projection = PolyanyaProjection;

  bool startQuery(const PolyanyaMesh& mesh, const End& start, const End& goal,
                  base::Statistics& counts);
  void pushStartIntervals(const End& start);
  bool nextNode(PolyanyaNode& node);
  void expand(const PolyanyaNode& node);
  void expandFlat(const PolyanyaNode& node);
  void expandInterval(PolyanyaNode node);
  int observableSuccessors(const PolyanyaNode& node, const Projection::FarSide& far,
                           PolyanyaNode& last);
  PolyanyaNode successorBeyond(const PolyanyaNode& node, std::int32_t lines,
                               const PolyanyaMesh::Border& border);
  void turningSuccessors(const PolyanyaNode& node, const PolyanyaMesh::Border& border,
                         Direction direction);
  void flatSuccessors(std::int32_t root, std::uint32_t corner, Direction direction);
  void updateIncumbentIfVisible(const PolyanyaNode& node);
  void keepProjectedSuccessor(PolyanyaNode node);
  void keepBestSuccessor(double f, const PolyanyaNode& node);
  std::optional<double> gAt(std::int32_t parent, std::uint32_t corner) const;
  std::int32_t rootAt(std::int32_t parent, std::uint32_t corner, double g, Sense sense);
  double fValue(const PolyanyaNode& node) const;

  const PolyanyaMesh* mesh_ = nullptr;
  PolyanyaProjection projection_;
  StampedArray<std::int32_t> corner_roots_;
  bool has_next_ = false;  // the successor with the least f-value of the node that is expanded
  double next_f_ = 0.0;
  PolyanyaNode next_{};
};

}  // namespace grid_path_planner::planners
