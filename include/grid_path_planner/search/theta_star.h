// Theta*: A* whose paths leave the grid's directions (Daniel, Nash, Koenig & Felner, "Theta*:
// Any-angle path planning on grids", JAIR 39, 2010), on weighted maps by the cost of segments.
//
// Where a cell is reached, the straight segment from its parent's parent is tried too, and taken
// where it is legal and no dearer. The turning points are the middles of cells, or of
// what the original map has of them.
//
// Guaranteed: every segment is legal, the cost is the sum of the segments' (terrain/segment.h).
// Not guaranteed: that it is the least an any-angle path can cost, or even as low as that of a grid
// path, though on maps of one weight it mostly lies within a few thousandths of the least.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/search/planner.h"
#include "grid_path_planner/search/steps.h"
#include "grid_path_planner/terrain/segment.h"

namespace grid_path_planner {

class ThetaStar : public Planner {
 public:
  ThetaStar();

  std::size_t bytesFor(const GridGeometry& geometry) const override;

 protected:
  void doPrepare(const StopToken& stop) override;
  void doUpdate(const CellRect& changed, const StopToken& stop) override;
  PlanResult doPlan(const PlanRequest& request, const StopToken& stop) override;

 private:
  // What is known of a cell in the query of its number.
  struct Node {
    double g = 0.0;
    std::uint32_t parent = 0;
    std::uint32_t query = 0;
    bool closed = false;
  };
  struct Entry {
    double f;
    double g;
    std::uint32_t index;
  };
  struct Later {
    bool operator()(const Entry& a, const Entry& b) const {
      if (a.f != b.f) return a.f > b.f;
      return a.g != b.g ? a.g < b.g : a.index > b.index;
    }
  };

  void begin(std::uint32_t start);
  void expand(std::uint32_t from, Statistics& counts);
  void reach(std::uint32_t index, std::uint32_t parent, double g, Statistics& counts);
  double estimate(std::uint32_t index) const;
  Cell cell(std::uint32_t index) const { return map().geometry().cell(CellIndex(index)); }
  SegmentPoint point(std::uint32_t index) const { return waypointOf(map(), cell(index)); }
  PlanResult withStatus(Status status, PlanResult result) const;
  PlanResult found(PlanResult result) const;

  StepMasks masks_;
  std::vector<Node> nodes_;
  std::vector<Entry> heap_;
  std::uint32_t query_ = 0;
  std::uint32_t goal_ = 0;
};

}  // namespace grid_path_planner
