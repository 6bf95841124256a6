#include "ros/common/incoming/service_caller.h"

#include <ros/service_client_link.h>
#include <ros/service_manager.h>
#include <ros/service_publication.h>

#include <boost/thread/mutex.hpp>
#include <vector>

// The links of a service's clients are private in roscpp, and nothing else leads from a call to its
// connection; so is whether a link stays after an answer. Naming private members in an explicit
// instantiation is the one thing that C++ allows.
namespace grid_path_planner::nodes {
namespace {

using Links = std::vector<ros::ServiceClientLinkPtr> ros::ServicePublication::*;
using Mutex = boost::mutex ros::ServicePublication::*;
using Stays = bool ros::ServiceClientLink::*;

Links linksMember();
Mutex mutexMember();
Stays staysMember();

template <Links links, Mutex mutex, Stays stays>
struct PrivateMembers {
  friend Links linksMember() { return links; }
  friend Mutex mutexMember() { return mutex; }
  friend Stays staysMember() { return stays; }
};
template struct PrivateMembers<&ros::ServicePublication::client_links_,
                               &ros::ServicePublication::client_links_mutex_,
                               &ros::ServiceClientLink::persistent_>;

// Null: closed before.
ros::ServiceClientLinkPtr linkOf(const std::string& service, const ros::M_string* header) {
  const ros::ServicePublicationPtr publication =
      ros::ServiceManager::instance()->lookupServicePublication(service);
  if (!publication) return nullptr;
  const boost::mutex::scoped_lock lock((*publication).*mutexMember());
  for (const ros::ServiceClientLinkPtr& link : (*publication).*linksMember())
    if (link->getConnection()->getHeader().getValues().get() == header) return link;
  return nullptr;
}

}  // namespace

ServiceCaller::ServiceCaller(const std::string& service, const ros::M_string& header) {
  if (const ros::ServiceClientLinkPtr link = linkOf(service, &header))
    connection_ = link->getConnection();
}

void leaveEndToClient(const boost::shared_ptr<ros::M_string>& header) {
  if (!header) return;
  const auto service = header->find("service");
  if (service == header->end()) return;
  if (const ros::ServiceClientLinkPtr link = linkOf(service->second, header.get()))
    (*link).*staysMember() = true;
}

}  // namespace grid_path_planner::nodes
