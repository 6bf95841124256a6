#include "ros/guard/incoming/service_caller.h"

#include <ros/init.h>
#include <ros/service_client_link.h>
#include <ros/service_manager.h>
#include <ros/service_publication.h>

#include <boost/thread/lock_types.hpp>
#include <boost/thread/mutex.hpp>
#include <chrono>
#include <thread>
#include <vector>

// The links of a service's clients are private in roscpp, and nothing else leads from a call to its
// connection; so are the lock of all services, which whoever asks for one waits for, and whether a link stays after an
// answer. Naming private members in an explicit
// instantiation is the one thing that C++ allows.
namespace grid_path_planner::nodes {
namespace {

using ClientLinks = std::vector<ros::ServiceClientLinkPtr> ros::ServicePublication::*;
using ClientMutex = boost::mutex ros::ServicePublication::*;
using Stays = bool ros::ServiceClientLink::*;
using Publications = ros::L_ServicePublication ros::ServiceManager::*;
using PublicationsMutex = boost::mutex ros::ServiceManager::*;

ClientLinks clientLinksMember();
ClientMutex clientMutexMember();
Stays staysMember();
Publications publicationsMember();
PublicationsMutex publicationsMutexMember();

template <ClientLinks links, ClientMutex mutex, Stays stays>
struct PrivateServiceMembers {
  friend ClientLinks clientLinksMember() { return links; }
  friend ClientMutex clientMutexMember() { return mutex; }
  friend Stays staysMember() { return stays; }
};
template struct PrivateServiceMembers<&ros::ServicePublication::client_links_,
                                      &ros::ServicePublication::client_links_mutex_,
                                      &ros::ServiceClientLink::persistent_>;

template <Publications publications, PublicationsMutex mutex>
struct PrivateServiceManagerMembers {
  friend Publications publicationsMember() { return publications; }
  friend PublicationsMutex publicationsMutexMember() { return mutex; }
};
template struct PrivateServiceManagerMembers<&ros::ServiceManager::service_publications_,
                                             &ros::ServiceManager::service_publications_mutex_>;

// As ServiceManager::lookupServicePublication(), but null once roscpp ends its services: it then holds the lock until all of
// their callbacks are done, of which the caller may be one.
ros::ServicePublicationPtr publicationOf(const std::string& service) {
  ros::ServiceManager& manager = *ros::ServiceManager::instance();
  boost::unique_lock<boost::mutex> lock(manager.*publicationsMutexMember(), boost::try_to_lock);
  while (!lock.owns_lock()) {
    if (ros::isShuttingDown()) return nullptr;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    lock.try_lock();
  }
  for (const ros::ServicePublicationPtr& publication : manager.*publicationsMember())
    if (publication->getName() == service && !publication->isDropped()) return publication;
  return nullptr;
}

// Null: closed before.
ros::ServiceClientLinkPtr linkOf(const std::string& service, const ros::M_string* header) {
  const ros::ServicePublicationPtr publication = publicationOf(service);
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
