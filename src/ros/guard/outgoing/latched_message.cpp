#include "ros/guard/outgoing/latched_message.h"

#include <boost/thread/mutex.hpp>

// The latched message is private in roscpp. Naming private members in an explicit instantiation is the one thing
// that C++ allows.
namespace grid_path_planner::nodes {
namespace {

template <class Publisher, auto member>
struct PrivateMember {
  friend const auto& implementationOf(const Publisher& publisher) { return publisher.*member; }
};
const auto& implementationOf(const ros::Publisher& publisher);
template struct PrivateMember<ros::Publisher, &ros::Publisher::impl_>;

}  // namespace

void forgetLatched(const ros::Publisher& publisher) {
  const auto& implementation = implementationOf(publisher);
  if (!implementation) return;
  const boost::mutex::scoped_lock lock(implementation->last_message_mutex_);
  implementation->last_message_ = ros::SerializedMessage();
}

}  // namespace grid_path_planner::nodes
