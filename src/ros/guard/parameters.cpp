#include "ros/guard/parameters.h"

#include <algorithm>
#include <set>
#include <sstream>

#include "base/plain_text.h"
#include "ros/guard/incoming/advertised_service.h"
#include "ros/guard/network_text.h"

namespace ros {
namespace {

using Reconfigure =
    ServiceSpec<dynamic_reconfigure::ReconfigureRequest, dynamic_reconfigure::ReconfigureResponse>;
struct UncheckedReconfigure : Reconfigure {};  // for roscpp's own code, by another name

}  // namespace

template <>
bool ServiceCallbackHelperT<Reconfigure>::call(ServiceCallbackHelperCallParams& given) {
  grid_path_planner::nodes::prepareCall<RequestType>(given);
  return ServiceCallbackHelperT<UncheckedReconfigure>(callback_, create_req_, create_res_)
      .call(given);
}

}  // namespace ros

namespace grid_path_planner::nodes {

using base::checkPlainText;
using base::closestName;
using base::configName;
using base::InputError;

namespace {

using XmlRpc::XmlRpcValue;

const char* typeName(XmlRpcValue::Type type) {
  switch (type) {
    case XmlRpcValue::TypeBoolean:
      return "the boolean";
    case XmlRpcValue::TypeInt:
      return "the integer";
    case XmlRpcValue::TypeDouble:
      return "the number";
    case XmlRpcValue::TypeString:
      return "the string";
    case XmlRpcValue::TypeArray:
      return "the list";
    case XmlRpcValue::TypeStruct:
      return "the dictionary";
    default:
      return "the value";
  }
}

[[noreturn]] void refuse(const std::string& name, const char* expected, XmlRpcValue& value) {
  std::ostringstream text;
  value.write(text);
  throw InputError(name + " must be " + expected + ", got " + typeName(value.getType()) + " " +
                   printable(text.str()));
}

std::string shortest(double number) {
  std::string text;
  for (int digits = 6; digits <= 17; ++digits) {
    std::ostringstream out;
    out.precision(digits);
    out << number;
    text = out.str();
    if (std::strtod(text.c_str(), nullptr) == number) break;
  }
  return text;
}

// "[[x, y], [x, y]]" of a list of lists of numbers; "" of any other value.
std::string listText(XmlRpcValue& value) {
  if (value.getType() != XmlRpcValue::TypeArray) return "";
  std::string text;
  for (int i = 0; i < value.size(); ++i) {
    if (value[i].getType() != XmlRpcValue::TypeArray) return "";
    std::string inner;
    for (int j = 0; j < value[i].size(); ++j) {
      double number = 0.0;
      if (value[i][j].getType() == XmlRpcValue::TypeInt)
        number = static_cast<int>(value[i][j]);
      else if (value[i][j].getType() == XmlRpcValue::TypeDouble)
        number = static_cast<double>(value[i][j]);
      else
        return "";
      inner += (j == 0 ? "" : ", ") + shortest(number);
    }
    text += (i == 0 ? "[" : ", [") + inner + "]";
  }
  return "[" + text + "]";
}

bool isKnown(const std::string& name, const std::vector<std::string>& known) {
  return std::any_of(known.begin(), known.end(), [&](const std::string& other) {
    return name == other || name == configName(other);
  });
}

// Of an unknown nested name as much as is needed to see what is unknown.
std::string reportedName(const std::string& name, const std::vector<std::string>& known) {
  const std::string group = name.substr(0, name.find('/') + 1);
  const bool group_is_known =
      !group.empty() && std::any_of(known.begin(), known.end(), [&](const std::string& other) {
        return other.compare(0, group.size(), group) == 0;
      });
  return group_is_known ? name : name.substr(0, name.find('/'));
}

}  // namespace

std::string optionText(const std::string& name, std::string text) {
  constexpr std::size_t kLongest = 4096;
  for (char& letter : text)
    if (letter == '\n' || letter == '\r' || letter == '\t') letter = ' ';
  checkPlainText(name, text, kLongest);
  return text;
}

void assignParameter(const std::string& name, XmlRpcValue value, bool& target) {
  if (value.getType() != XmlRpcValue::TypeBoolean) refuse(name, "true or false", value);
  target = static_cast<bool>(value);
}

void assignParameter(const std::string& name, XmlRpcValue value, int& target) {
  if (value.getType() != XmlRpcValue::TypeInt) refuse(name, "an integer", value);
  target = static_cast<int>(value);
}

void assignParameter(const std::string& name, XmlRpcValue value, double& target) {
  if (value.getType() == XmlRpcValue::TypeInt)
    target = static_cast<int>(value);
  else if (value.getType() == XmlRpcValue::TypeDouble)
    target = static_cast<double>(value);
  else
    refuse(name, "a number", value);
}

void assignParameter(const std::string& name, XmlRpcValue value, std::string& target) {
  if (value.getType() == XmlRpcValue::TypeString)
    target = optionText(name, static_cast<std::string>(value));
  else if (value.getType() == XmlRpcValue::TypeInt)
    target = std::to_string(static_cast<int>(value));
  else if (value.getType() == XmlRpcValue::TypeDouble)
    target = shortest(static_cast<double>(value));
  else if (const std::string text = listText(value); !text.empty())
    target = text;
  else
    refuse(name, "a string", value);
}

XmlRpcValue parameterTree(const ros::NodeHandle& private_nh) {
  XmlRpcValue tree;
  if (!ros::param::get(private_nh.getNamespace(), tree) ||
      tree.getType() != XmlRpcValue::TypeStruct)
    return {};
  return tree;
}

const XmlRpcValue* findParameter(const XmlRpcValue& tree, const std::string& name) {
  const XmlRpcValue* value = &tree;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    const std::string part = name.substr(begin, end - begin);
    if (value->getType() != XmlRpcValue::TypeStruct || !value->hasMember(part)) return nullptr;
    value = &(*value)[part];
    begin = end + 1;
  }
  return value;
}

std::vector<std::string> unknownParameters(const ros::NodeHandle& private_nh,
                                           const std::vector<std::string>& known) {
  std::vector<std::string> set_names;
  if (!private_nh.getParamNames(set_names)) return {};
  const std::string prefix = private_nh.getNamespace() + "/";
  std::set<std::string> unknown;
  for (const std::string& full_name : set_names) {
    if (full_name.compare(0, prefix.size(), prefix) != 0) continue;
    const std::string name = full_name.substr(prefix.size());
    if (!isKnown(name, known)) unknown.insert(printable(reportedName(name, known)));
  }
  return {unknown.begin(), unknown.end()};
}

std::string meantText(const std::string& name, const std::string& inner,
                      const std::vector<std::string>& known) {
  if (!inner.empty())
    return "; " + inner + " stands below it: leave the line '" + name +
           ":' out and begin those below it at the left margin";
  const std::string meant = closestName(name, known);
  return meant.empty() ? "" : "; did you mean " + meant + "?";
}

void warnUnknownParameters(const ros::NodeHandle& private_nh,
                           const std::vector<std::string>& known) {
  const std::vector<std::string> unknown = unknownParameters(private_nh, known);
  if (unknown.empty()) return;
  const XmlRpcValue tree = parameterTree(private_nh);
  for (const std::string& name : unknown) {
    const auto inner = std::find_if(known.begin(), known.end(), [&](const std::string& one) {
      return findParameter(tree, name + "/" + one) != nullptr;
    });
    ROS_WARN_STREAM("Unknown parameter "
                    << private_nh.getNamespace() << "/" << name << " is not used"
                    << meantText(name, inner == known.end() ? "" : *inner, known));
  }
}

}  // namespace grid_path_planner::nodes
