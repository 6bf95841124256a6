// Plans for a vehicle with a footprint: a path between cells that a disc of the inscribed radius may take, on which the
// footprint itself is then checked, turns on the spot included.
//
//   Plan plan = FittedPlanner(footprint, costs, inflate, options, memory).plan(search, request, stop);
//
// Where it does not fit the path is searched again: at most kTries times on costs that lead it through the middle of narrow
// places and around those where it did not fit (try_costs.h), smoothed and not, from and to the ends by any line and by one
// in their headings, and then for a disc of the circumscribed radius. Guaranteed: the footprint meets no obstacle on a path that is found (footprint_check.h says which count), nor on the
// line through its waypoints. Not guaranteed: that a path is found where there is one, since no search knows of headings; and
// after the first try, that none costs less.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planning/footprint/footprint_check.h"
#include "planning/footprint/try_costs.h"
#include "planning/plan_on_costs.h"

namespace grid_path_planner::planning {

class FittedPlanner {
 public:
  static constexpr int kTries = 8;

  // Gives the costmap at full resolution for the radius of other options. Throws Stopped.
  using Inflate = std::function<std::shared_ptr<const costmap::CostGrid>(
      const costmap::CostmapOptions&, const base::StopToken&)>;

  // `costs` is the costmap at full resolution that the search is prepared for; the radius of `options` is that
  // which it keeps. `memory`: bytes that the tries may take. All references outlive this.
  FittedPlanner(const vehicle::Footprint& footprint, const costmap::CostGrid& costs,
                Inflate inflate, const PlannerOptions& options, std::size_t memory);

  // Throws Stopped, and what searches throw. Preconditions of planOnCosts().
  Plan plan(MultiResolutionPlanner& search, const PoseRequest& request,
            const base::StopToken& stop);

 private:
  using Contacts = std::vector<vehicle::FootprintContact>;

  // Into curves.
  void bend(Plan& plan, const PoseRequest& request, const base::StopToken& stop) const;
  // The check of poses and paths at the goal which was asked for, or of those at one that replaces it, where only the
  // start allows something.
  const FootprintCheck& checkOf(const path::Pose& end, const PoseRequest& request) const;
  const FootprintCheck& checkOf(const path::Path& path, const PoseRequest& request) const {
    return checkOf(path.poses.back(), request);
  }
  // Of a pose at the start, the goal or the place of another goal.
  std::function<std::string(const path::Pose&)> complaintAbout(const PoseRequest& request) const;
  Contacts contactsOf(const Plan& plan, const PoseRequest& request,
                      const base::StopToken& stop) const;
  Plan planAnew(std::shared_ptr<const costmap::CostGrid> costs, const PoseRequest& request,
                const VehicleTerms& terms, const PlannerOptions& options,
                const base::StopToken& stop);
  std::shared_ptr<const costmap::CostGrid> turningCosts(const base::StopToken& stop) const;
  // A try: what is asked, and on which terms.
  struct Question {
    PoseRequest request;
    VehicleTerms terms;
  };

  std::optional<path::Pose> lead(const path::Pose& end, double sign,
                                 const costmap::CostGrid& turning) const;
  Question ledQuestion(const PoseRequest& request, const costmap::CostGrid& turning) const;
  bool tryAgain(Plan& plan, const PoseRequest& request, const costmap::CostGrid& turning,
                const base::StopToken& stop);
  bool tryOn(const TryCosts& raised, const std::vector<Question>& questions, Plan& plan,
             Contacts& contacts, const base::StopToken& stop);
  Plan planWithRoom(Plan first, const PoseRequest& request, const base::StopToken& stop);
  Plan completed(Plan plan, const PoseRequest& request, const std::string& how,
                 const base::StopToken& stop) const;
  Plan failed(const Plan& first, const PoseRequest& request,
              const vehicle::FootprintContact& contact, const std::string& tried) const;
  std::size_t bytesOfTries() const;

  const vehicle::Footprint& footprint_;
  const costmap::CostGrid& costs_;
  const Inflate inflate_;
  const PlannerOptions& options_;
  const std::size_t memory_;
  FootprintCheck check_;  // which allows what the footprint meets at the start and at the goal
  FootprintCheck check_of_start_;  // at the start only
  VehicleTerms terms_;
  int tries_ = 0;
  base::Statistics spent_;
  std::string first_planner_;  // which a repetition of the plan must begin with
};

}  // namespace grid_path_planner::planning
