#include "ros/guard/outgoing/direct_publisher.h"

#include <ros/connection.h>
#include <ros/topic_manager.h>
#include <ros/transport_subscriber_link.h>

#include <boost/thread/mutex.hpp>
#include <utility>

// The links of a topic's subscribers and the writing of a connection are private in roscpp, which offers
// either to nobody. Naming private members in an explicit instantiation is the one thing that C++ allows.
namespace grid_path_planner::nodes {
namespace {

using Links = std::vector<ros::SubscriberLinkPtr> ros::Publication::*;
using Mutex = boost::mutex ros::Publication::*;
using Write = void (ros::Connection::*)();

Links linksMember();
Mutex mutexMember();
Write writeMember();

template <Links links, Mutex mutex, Write write>
struct PrivateMembers {
  friend Links linksMember() { return links; }
  friend Mutex mutexMember() { return mutex; }
  friend Write writeMember() { return write; }
};
template struct PrivateMembers<&ros::Publication::subscriber_links_,
                               &ros::Publication::subscriber_links_mutex_,
                               &ros::Connection::writeTransport>;

}  // namespace

DirectPublisher::DirectPublisher(ros::Publisher publisher)
    : publisher_(std::move(publisher)),
      publication_(ros::TopicManager::instance()->lookupPublication(publisher_.getTopic())) {}

// A connection that breaks here takes its link out of the list: it is not written to under the mutex.
void DirectPublisher::send(const ros::SerializedMessage& message) {
  if (!publication_->enqueueMessage(message)) return;  // ROS was shut down
  {
    const boost::mutex::scoped_lock lock((*publication_).*mutexMember());
    links_ = (*publication_).*linksMember();
  }
  for (const ros::SubscriberLinkPtr& link : links_)
    if (const auto remote = boost::dynamic_pointer_cast<ros::TransportSubscriberLink>(link))
      ((*remote->getConnection()).*writeMember())();
  links_.clear();
}

}  // namespace grid_path_planner::nodes
