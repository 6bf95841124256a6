// The connections that a node has, by its own word: a message that is sent before is lost.
#pragma once

#include <optional>
#include <string>

#include "ros/guard/master/xmlrpc_call.h"

namespace grid_path_planner::test {

// How many connections the node of this URI has for the topic, "i" (it hears) or "o" (it is heard).
inline int linksOf(const std::optional<std::string>& uri, const std::string& topic,
                   const std::string& direction) {
  if (!uri) return 0;
  auto links = nodes::callXmlRpc(*uri, "getBusInfo", {XmlRpc::XmlRpcValue("/test")}, 1.0);
  int count = 0;
  for (int i = 0; links && i < links->size(); ++i) {
    XmlRpc::XmlRpcValue& link = (*links)[i];
    if (std::string(link[2]) == direction && std::string(link[4]) == topic) ++count;
  }
  return count;
}

}  // namespace grid_path_planner::test
