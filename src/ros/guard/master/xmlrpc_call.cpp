#include "ros/guard/master/xmlrpc_call.h"

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcDispatch.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <cstdint>

namespace grid_path_planner::nodes {
namespace {

using XmlRpc::XmlRpcClient;
using XmlRpc::XmlRpcDispatch;
using XmlRpc::XmlRpcValue;

constexpr int kUnknownNode = -1;  // what the master's lookupNode says then

// Whatever came back; none without an answer in time.
std::optional<XmlRpcValue> ask(const std::string& uri, const std::string& method,
                               const std::vector<XmlRpcValue>& arguments, double seconds) {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) return std::nullopt;
  XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpcValue request, response;
  for (std::size_t i = 0; i < arguments.size(); ++i) request[static_cast<int>(i)] = arguments[i];
  if (!client.executeNonBlock(method.c_str(), request)) return std::nullopt;
  XmlRpcDispatch dispatch;
  dispatch.addSource(&client, XmlRpcDispatch::WritableEvent | XmlRpcDispatch::Exception);
  dispatch.work(seconds);
  const bool done = client.executeCheckDone(response);
  dispatch.removeSource(&client);
  client.close();
  if (!done || !response.valid()) return std::nullopt;  // a connection that is refused is done too
  return response;
}

}  // namespace

std::optional<XmlRpcValue> valueOfAnswer(XmlRpcValue answer) {
  if (answer.getType() != XmlRpcValue::TypeArray || answer.size() != 3 ||
      static_cast<int&>(answer[0]) != 1)
    return std::nullopt;
  return XmlRpcValue(answer[2]);
}

std::optional<XmlRpcValue> callXmlRpc(const std::string& uri, const std::string& method,
                                      const std::vector<XmlRpcValue>& arguments, double seconds) {
  try {
    const std::optional<XmlRpcValue> answer = ask(uri, method, arguments, seconds);
    return answer ? valueOfAnswer(*answer) : std::nullopt;
  } catch (const XmlRpc::XmlRpcException&) {
    return std::nullopt;
  }
}

bool answersXmlRpc(const std::string& uri, double seconds) {
  try {
    return ask(uri, "getPid", {XmlRpcValue(ros::this_node::getName())}, seconds).has_value();
  } catch (const XmlRpc::XmlRpcException&) {
    return false;
  }
}

std::string masterUri() {
  return "http://" + ros::master::getHost() + ":" + std::to_string(ros::master::getPort());
}

std::optional<std::string> uriOfNode(const std::string& node, double seconds) {
  auto uri = callXmlRpc(masterUri(), "lookupNode",
                        {XmlRpcValue(ros::this_node::getName()), XmlRpcValue(node)}, seconds);
  if (!uri || uri->getType() != XmlRpcValue::TypeString) return std::nullopt;
  return static_cast<std::string&>(*uri);
}

std::optional<bool> masterKnows(const std::string& node, double seconds) {
  try {
    auto answer = ask(masterUri(), "lookupNode",
                      {XmlRpcValue(ros::this_node::getName()), XmlRpcValue(node)}, seconds);
    if (!answer || answer->getType() != XmlRpcValue::TypeArray || answer->size() != 3)
      return std::nullopt;
    const int code = static_cast<int&>((*answer)[0]);
    if (code == 1 || code == kUnknownNode) return code == 1;
    return std::nullopt;
  } catch (const XmlRpc::XmlRpcException&) {
    return std::nullopt;
  }
}

}  // namespace grid_path_planner::nodes
