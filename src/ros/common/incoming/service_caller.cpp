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

using ClientLinks = std::vector<ros::ServiceClientLinkPtr> ros::ServicePublication::*;
using ClientMutex = boost::mutex ros::ServicePublication::*;
using Stays = bool ros::ServiceClientLink::*;

ClientLinks clientLinksMember();
ClientMutex clientMutexMember();
Stays staysMember();

template <ClientLinks links, ClientMutex mutex, Stays stays>
struct PrivateServiceMembers {
  friend ClientLinks clientLinksMember() { return links; }
  friend ClientMutex clientMutexMember() { return mutex; }
  friend Stays staysMember() { return stays; }
};
template struct PrivateServiceMembers<&ros::ServicePublication::client_links_,
                                      &ros::ServicePublication::client_links_mutex_,
                                      &ros::ServiceClientLink::persistent_>;

// Null: closed before.
ros::ServiceClientLinkPtr linkOf(const std::string& service, const ros::M_string* header) {
  const ros::ServicePublicationPtr publication =
      ros::ServiceManager::instance()->lookupServicePublication(service);
  if (!publication) return nullptr;
  const boost::mutex::scoped_lock lock((*publication).*clientMutexMember());
  for (const ros::ServiceClientLinkPtr& link : (*publication).*clientLinksMember())
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
