#include "ros/common/incoming/service_caller.h"

#include <ros/service_client_link.h>
#include <ros/service_manager.h>
#include <ros/service_publication.h>

#include <boost/thread/mutex.hpp>
#include <vector>

// The links of a service's clients are private in roscpp, and nothing else leads from a call to its
// connection. Naming private members in an explicit instantiation is the one thing that C++ allows.
namespace grid_path_planner::nodes {
namespace {

using Links = std::vector<ros::ServiceClientLinkPtr> ros::ServicePublication::*;
using Mutex = boost::mutex ros::ServicePublication::*;

Links linksMember();
Mutex mutexMember();

template <Links links, Mutex mutex>
struct PrivateMembers {
  friend Links linksMember() { return links; }
  friend Mutex mutexMember() { return mutex; }
};
template struct PrivateMembers<&ros::ServicePublication::client_links_,
                               &ros::ServicePublication::client_links_mutex_>;

}  // namespace

ServiceCaller::ServiceCaller(const std::string& service, const ros::M_string& header) {
  const ros::ServicePublicationPtr publication =
      ros::ServiceManager::instance()->lookupServicePublication(service);
  if (!publication) return;
  const boost::mutex::scoped_lock lock((*publication).*mutexMember());
  for (const ros::ServiceClientLinkPtr& link : (*publication).*linksMember())
    if (link->getConnection()->getHeader().getValues().get() == &header)
      connection_ = link->getConnection();
}

}  // namespace grid_path_planner::nodes
