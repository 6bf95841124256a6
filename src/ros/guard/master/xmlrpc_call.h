// XML-RPC with a limit of time: to the master and to other nodes.
//
//   const auto pid = callXmlRpc("http://host:11311", "getPid", {nodeName()}, seconds);
//
// roscpp's own calls wait for ever for one who accepts a connection and does not answer. The name of
// a host is still looked up for as long as the system likes, so this is called in a thread that
// nothing waits for; but by the panel for rviz, where somebody has just changed its namespace.
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <optional>
#include <string>
#include <vector>

namespace grid_path_planner::nodes {

// The third element of the answer (ROS's slave and master API: code, text, value); none where there
// is no answer within `seconds`, or one that is no success.
std::optional<XmlRpc::XmlRpcValue> callXmlRpc(const std::string& uri, const std::string& method,
                                              const std::vector<XmlRpc::XmlRpcValue>& arguments,
                                              double seconds);

// The third element of an answer that is a success. Throws XmlRpc::XmlRpcException.
std::optional<XmlRpc::XmlRpcValue> valueOfAnswer(XmlRpc::XmlRpcValue answer);

// Whether one answers at all at `uri`, be it with an error.
bool answersXmlRpc(const std::string& uri, double seconds);

// Of the master, by its URI.
std::string masterUri();

// The URI under which the master knows a node; none where it knows none, or gives no answer.
std::optional<std::string> uriOfNode(const std::string& node, double seconds);

// Whether the master knows a node; none where it gives no answer within `seconds`.
std::optional<bool> masterKnows(const std::string& node, double seconds);

}  // namespace grid_path_planner::nodes
