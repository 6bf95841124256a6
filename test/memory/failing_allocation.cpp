#include "memory/failing_allocation.h"

#include "memory/failing_operators.h"

namespace grid_path_planner::test {
namespace {

thread_local int left = -1;  // allocations before the one that fails; negative: none does

}  // namespace

bool allocationFails(std::size_t) {
  return left >= 0 && left-- == 0;
}

FailingAllocation::FailingAllocation(int number) {
  left = number - 1;
}

FailingAllocation::~FailingAllocation() {
  left = -1;
}

bool FailingAllocation::happened() const {
  return left < 0;
}

}  // namespace grid_path_planner::test
