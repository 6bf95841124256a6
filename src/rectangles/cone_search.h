// The search of Polyanya over a mesh of rectangles.
//
// A cone is all that one root sees of a border: what lies between two directions. It crosses the
// rectangle behind and is split by the borders that it meets there. Where it touches a corner round
// which a taut way can turn, a turn begins: a root of its own, that sees the quarter between the
// direction of the arrival and the wall that it turns along. That quarter lies in one rectangle, so
// a turn is one node, and its borders are looked at when its time comes.
//
// Points and directions are whole numbers and every decision is the sign of a cross product of two
// of them, so all are exact; only lengths are rounded.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "grid_path_planner/base/statistics.h"
#include "grid_path_planner/base/status.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/rectangles/rectangle_mesh.h"

namespace grid_path_planner {

class ConeSearch {
 public:
  struct End {
    MeshPoint at;             // inside a cell of
    std::uint32_t rectangle;  // this one
  };
  struct Answer {
    Status status = Status::UNREACHABLE;
    std::vector<MeshPoint> points;  // where FOUND: start, turning points, goal
    double length = 0.0;            // in the mesh's units
  };

  // `expanded` gets the number of a rectangle for every expansion if it is not null.
  Answer run(const RectangleMesh& mesh, End start, End goal, const StopToken& stop,
             Statistics& counts, std::vector<std::uint32_t>* expanded);

  // Of the last run.
  std::size_t bytes() const;

 private:
  using Turn = RectangleMesh::Turn;

  struct Root {
    MeshPoint at;
    double g;
    std::int32_t parent;
    std::int32_t widest[2];  // by Turn: the parent of the widest arrival so far at this g
    bool beaten;             // a shorter way to this corner has a root of its own
  };
  struct Node {
    MeshPoint right;  // directions
    MeshPoint left;
    std::int32_t root;
    std::uint32_t rectangle;
    std::int32_t side;   // the first to look at, anticlockwise
    std::int32_t sides;  // how many
  };
  struct Entry {
    double f;
    std::uint32_t node;
    friend bool operator<(const Entry& a, const Entry& b) { return a.f > b.f; }  // for std's heaps
  };
  struct Known {  // of a corner
    std::uint32_t query = 0;
    std::int32_t root = -1;
  };

  void begin(const RectangleMesh& mesh, End start, End goal, Statistics& counts);
  void leaveStart();
  void expand(const Node& node);
  void lookAlongWalls(const Node& node);
  void alongLeft(const Node& node, int side);
  void alongRight(const Node& node, int side);
  void pass(const Node& node, const RectangleMesh::Border& border, int side, std::int64_t right,
            std::int64_t left);
  void turn(std::int32_t parent, std::uint32_t corner, Turn sense);
  std::int32_t relax(std::int32_t parent, std::uint32_t corner, Turn sense);
  bool sees(const Node& node) const;
  void see(std::int32_t root);
  double promise(const Node& node, MeshPoint on_border, int side) const;
  void offer(double f, const Node& node);
  void push(double f, const Node& node);
  Node pop();
  double distance(MeshPoint a, MeshPoint b) const;

  const RectangleMesh* mesh_ = nullptr;
  Statistics* counts_ = nullptr;
  End start_{};
  End goal_{};
  double best_ = std::numeric_limits<double>::infinity();  // the shortest way to the goal so far
  std::int32_t best_root_ = -1;
  bool has_next_ = false;  // the most promising successor of the node in hand
  double next_f_ = 0.0;
  Node next_{};
  std::vector<Root> roots_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> unused_;  // places in nodes_
  std::vector<Entry> heap_;
  std::uint32_t query_ = 0;
  std::vector<Known> corners_;
  std::vector<std::uint32_t> blocks_;         // that this query may pass
  std::vector<std::uint32_t> block_queries_;  // the query for which a block was one of them
};

}  // namespace grid_path_planner
