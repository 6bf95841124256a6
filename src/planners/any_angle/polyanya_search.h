// The search of Polyanya over a mesh of rectangles.
//
// A cone is all that one root sees, between two rays, of what lies north (or south) of it. It
// crosses a rectangle and is split by the borders on the far side. Where it touches a corner round
// which a taut way can turn and which shows anything beyond, the corner becomes a root of its own,
// with a cone for what lies beyond the ray; and where the wall that it turned along is one of the
// line, with the corners that follow on the line.
//
// Points and rays are whole numbers and every decision is the sign of a difference of two products
// of them, so all are exact; only lengths are rounded.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "grid_path_planner/base/statistics.h"
#include "grid_path_planner/base/status.h"
#include "grid_path_planner/base/stop_token.h"
#include "planners/any_angle/polyanya_mesh.h"
#include "planners/core/node_heap.h"

namespace grid_path_planner::planners {

class PolyanyaSearch {
 public:
  struct End {
    MeshPoint at;             // inside a cell of
    std::uint32_t rectangle;  // this one
  };
  struct Answer {
    base::Status status = base::Status::UNREACHABLE;
    std::vector<MeshPoint> points;  // where FOUND: start, turning points, goal
    double length = 0.0;            // in the mesh's units
  };

  // `expanded` gets the number of a rectangle for every expansion if it is not null.
  Answer run(const PolyanyaMesh& mesh, End start, End goal, const base::StopToken& stop,
             base::Statistics& counts, std::vector<std::uint32_t>* expanded);

  // Of the last run.
  std::size_t bytes() const;

 private:
  static constexpr std::int8_t kCone = -1;
  using Direction = PolyanyaMesh::Direction;
  using Heading = PolyanyaMesh::Heading;
  enum Sense { ANTICLOCKWISE, CLOCKWISE };

  struct Root {
    MeshPoint at;
    double g;
    std::int32_t parent;
    std::int32_t widest[2];  // by Sense: the parent of the widest arrival so far at this g
    bool beaten;             // a shorter way to this corner has a root of its own
  };
  // A direction: columns to the east for lines ahead, which are 0 or more.
  struct Ray {
    std::int32_t columns;
    std::int32_t lines;
  };
  // A cone that is about to cross a rectangle; or the next corner along a line.
  struct Node {
    Ray ray[2];  // by Way
    std::int32_t root;
    std::uint32_t place;  // the rectangle, or the corner
    Heading heading;      // of a cone
    std::int8_t along;    // the Way along the line, kCone of a cone
  };
  struct Known {  // of a corner
    std::uint32_t query = 0;
    std::int32_t root = -1;
  };
  // What a cone that goes on meets: nothing more, the goal's rectangle, borders where it parts or
  // can turn, or nothing yet.
  enum class Meets { END, GOAL, BORDERS, NOTHING };
  // The far side of a rectangle: its borders from the first on of which a cone sees something.
  struct FarSide {
    std::int32_t lines;  // from the root
    std::uint32_t first;
    std::uint32_t end;
  };

  void begin(const PolyanyaMesh& mesh, End start, End goal, base::Statistics& counts);
  bool turns(const PolyanyaMesh::Rectangle& from, const PolyanyaMesh::Border& border, Direction way,
             Heading heading, std::int32_t columns, std::int32_t lines) const;
  std::uint32_t firstSeen(std::uint32_t first, std::uint32_t end, std::int32_t root, Ray west,
                          std::int32_t lines) const;
  Meets projectThroughOpenBorders(MeshPoint root, Node& cone, FarSide& far, int& borders) const;
  void pushSuccessor(Node cone);
  void expandCorner(const Node& node);
  void expandCone(Node cone);
  Node pass(const Node& cone, std::int32_t lines, const PolyanyaMesh::Border& border);
  void turningSuccessors(const Node& cone, const PolyanyaMesh::Border& border, Direction way);
  void flatSuccessors(std::int32_t root, std::uint32_t corner, Direction way);
  void reachGoal(const Node& cone);
  std::optional<double> lengthTo(std::int32_t parent, std::uint32_t corner) const;
  std::int32_t rootAt(std::int32_t parent, std::uint32_t corner, double g, Sense sense);
  void updateIncumbent(std::int32_t root);
  double fValue(const Node& cone) const;
  void keepBestSuccessor(double f, const Node& node);
  void push(double f, const Node& node);
  bool allowed(const PolyanyaMesh::Border& border) const {
    return block_queries_[border.block] == query_ && border.to != start_.rectangle;
  }

  const PolyanyaMesh* mesh_ = nullptr;
  base::Statistics* counts_ = nullptr;
  End start_{};
  End goal_{};
  double incumbent_ =
      std::numeric_limits<double>::infinity();  // the shortest way to the goal so far
  std::int32_t incumbent_root_ = -1;
  bool has_next_ = false;  // the most promising successor of the node in hand
  double next_f_ = 0.0;
  Node next_{};
  std::vector<Root> roots_;
  NodeHeap<Node> open_;
  std::uint32_t query_ = 0;
  std::vector<Known> corners_;
  std::vector<std::uint32_t> blocks_;         // that this query may pass
  std::vector<std::uint32_t> block_queries_;  // the query for which a block was one of them
};

}  // namespace grid_path_planner::planners
