// What another node, or who sits where the master should, answers to a question by XML-RPC.
#include <xmlrpcpp/XmlRpcException.h>

#include "fuzz/fuzz_target.h"
#include "ros/guard/master/system_state.h"
#include "ros/guard/master/xmlrpc_call.h"
#include "ros/guard/parameters.h"

namespace grid_path_planner::fuzz {
namespace {

using XmlRpc::XmlRpcValue;

std::string list(const std::string& values) {
  return "<value><array><data>" + values + "</data></array></value>";
}

std::vector<std::string> seedsOfAnswers() {
  const std::string nodes = list(list("<value>/map</value>" + list("<value>/node</value>")));
  const std::string success = "<value><i4>1</i4></value><value></value>";
  return {list(success + list(nodes + nodes + list(""))),
          list(success + "<value><i4>42</i4></value>"),
          list(success + "<value><double>1.5</double></value>"),
          list(success + "<value><boolean>1</boolean></value>"),
          list(success +
               "<value><struct><member><name>a</name><value>b</value></member></struct></value>"),
          list(success + "<value><base64>aGVsbG8=</base64></value>")};
}

// A parameter's value, which is an answer too.
template <class Value>
void assign(const XmlRpcValue& value) {
  Value target{};
  mayRefuse([&] { nodes::assignParameter("~fuzz", value, target); });
}

FUZZ_TARGET(xmlrpc_answer, seedsOfAnswers) {
  try {
    int offset = 0;
    const XmlRpcValue answer(input, &offset);
    if (!answer.valid()) return;
    const auto value = nodes::valueOfAnswer(answer);
    if (!value || !value->valid()) return;
    nodes::systemStateOf(*value);
    assign<bool>(*value);
    assign<int>(*value);
    assign<double>(*value);
    assign<std::string>(*value);
  } catch (const XmlRpc::XmlRpcException&) {  // who asks expects these
  }
}

}  // namespace
}  // namespace grid_path_planner::fuzz
