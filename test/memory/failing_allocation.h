// Makes one allocation of this thread fail.
//
//   const FailingAllocation fails(7);      // the seventh from now on, by operator new, throws std::bad_alloc
//   try { work(); } catch (const std::bad_alloc&) {}
//   fails.happened();               // whether there were so many
#pragma once

namespace grid_path_planner::test {

class FailingAllocation {
 public:
  explicit FailingAllocation(int number);
  ~FailingAllocation();
  FailingAllocation(const FailingAllocation&) = delete;
  FailingAllocation& operator=(const FailingAllocation&) = delete;

  bool happened() const;
};

}  // namespace grid_path_planner::test
