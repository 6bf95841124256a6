// Reads options from ROS parameters and dynamic_reconfigure, by the visitOptions of their struct.
//
//   ros::NodeHandle private_nh("~");
//   PlannerOptions options;
//   loadParameters(private_nh, options);             // throws InputError
//   checkPlannerOptions(options);                    // throws InputError
//   warnUnknownParameters(private_nh, optionNames<PlannerOptions>());
//   Reconfigurable<PathPlannerConfig, PlannerOptions> reconfigurable(
//       private_nh, options, [](const PlannerOptions& o) { use(o); });
//
// No value is clamped and no change is applied in part: a value of the wrong type, outside its
// limits or in a contradictory combination is refused with a sentence, and the old values stay. The
// .cfg of a node states no min and max, to which dynamic_reconfigure would clamp without a warning.
//
// An option with a nested name, sensor_model/hit, is the parameter ~sensor_model/hit; for
// dynamic_reconfigure, whose names are C++ names, it is sensor_model_hit.
#pragma once

#include <XmlRpcValue.h>
#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/config_tools.h>
#include <dynamic_reconfigure/server.h>
#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/param.h>

#include <boost/thread/recursive_mutex.hpp>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/base/options.h"
#include "ros/guard/outgoing/refused_parameter.h"

namespace ros {

// Of the service ~set_parameters, which dynamic_reconfigure's server offers by itself: with arrays whose
// lengths may lie (advertised_service.h).
template <>
bool ServiceCallbackHelperT<
    ServiceSpec<dynamic_reconfigure::ReconfigureRequest,
                dynamic_reconfigure::ReconfigureResponse>>::call(ServiceCallbackHelperCallParams&);

}  // namespace ros

namespace grid_path_planner::nodes {

// `name` in every message is the parameter's full name. An int is taken for a double, a number for
// a string (YAML reads an unquoted 8 as a number), and so is a list of lists of numbers, as a footprint's
// corners are written; anything else of another type throws InputError.
void assignParameter(const std::string& name, XmlRpc::XmlRpcValue value, bool& target);
void assignParameter(const std::string& name, XmlRpc::XmlRpcValue value, int& target);
void assignParameter(const std::string& name, XmlRpc::XmlRpcValue value, double& target);
void assignParameter(const std::string& name, XmlRpc::XmlRpcValue value, std::string& target);

// All parameters below the namespace of `private_nh` as one dictionary, by one question to the master: each takes it a
// millisecond, and a node has up to 170 parameters. Invalid where there are none.
XmlRpc::XmlRpcValue parameterTree(const ros::NodeHandle& private_nh);

// The value of `name`, group/name in the dictionary of the group; nullptr where it is not set.
const XmlRpc::XmlRpcValue* findParameter(const XmlRpc::XmlRpcValue& tree, const std::string& name);

// Names under the namespace of `private_nh` that are not in `known`; of a nested name the first
// part, unless a known name begins with it. The name that dynamic_reconfigure uses for a known name
// is known.
std::vector<std::string> unknownParameters(const ros::NodeHandle& private_nh,
                                           const std::vector<std::string>& known);

// What is said of an unknown name: the closest known one, or that it holds the known `inner`, as in a
// file whose parameters stand below the node's name.
std::string meantText(const std::string& name, const std::string& inner,
                      const std::vector<std::string>& known);

// Warns about each of them, with meantText().
void warnUnknownParameters(const ros::NodeHandle& private_nh,
                           const std::vector<std::string>& known);

// The names that the visitor of `Options` visits, in its order.
template <class Options>
std::vector<std::string> optionNames() {
  std::vector<std::string> names;
  Options options;
  visitOptions(options,
               [&](const char* name, auto&, const base::OptionInfo&) { names.push_back(name); });
  return names;
}

// Fills `options` from the parameters that are set; others keep their value. Throws InputError
// naming the full parameter name, the value and what was expected; `options` is then as it was.
template <class Options>
void loadParameters(const ros::NodeHandle& private_nh, Options& options) {
  Options loaded = options;
  const XmlRpc::XmlRpcValue tree = parameterTree(private_nh);
  visitOptions(loaded, [&](const char* name, auto& value, const base::OptionInfo& info) {
    using Value = std::decay_t<decltype(value)>;
    const XmlRpc::XmlRpcValue* parameter = findParameter(tree, name);
    if (!parameter) return;
    const std::string full_name = private_nh.resolveName(name);
    if constexpr (std::is_enum_v<Value>) {
      std::string text;
      assignParameter(full_name, *parameter, text);
      value = base::choiceFromName<Value>(full_name, text);
    } else {
      assignParameter(full_name, *parameter, value);
      if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, double>)
        base::checkLimits(full_name, static_cast<double>(value), info);
    }
  });
  options = std::move(loaded);
}

// The text of an option as it came, line ends as spaces: whoever refuses it repeats it in the log. Throws
// InputError that does not repeat it for other control characters, bytes that are no UTF-8, and more than
// 4096 bytes.
std::string optionText(const std::string& name, std::string text);

// What the parameter of an option holds: an enum by its name.
template <class Value>
XmlRpc::XmlRpcValue parameterValue(const Value& value) {
  if constexpr (std::is_enum_v<Value>)
    return XmlRpc::XmlRpcValue(std::string(base::choiceName(value)));
  else
    return XmlRpc::XmlRpcValue(value);
}

// Sets every parameter that is not what `options` holds, and no other.
template <class Options>
void storeParameters(const ros::NodeHandle& private_nh, Options options) {
  const XmlRpc::XmlRpcValue tree = parameterTree(private_nh);
  visitOptions(options, [&](const char* name, auto& value, const base::OptionInfo&) {
    const XmlRpc::XmlRpcValue wanted = parameterValue(value);
    const XmlRpc::XmlRpcValue* present = findParameter(tree, name);
    if (!present || *present != wanted) private_nh.setParam(name, wanted);
  });
}

// Every option by name in the message that dynamic_reconfigure sends, enums as strings.
template <class Options>
dynamic_reconfigure::Config configMessage(Options options) {
  dynamic_reconfigure::Config message;
  visitOptions(options, [&](const char* name, auto& value, const base::OptionInfo&) {
    using dynamic_reconfigure::ConfigTools;
    if constexpr (std::is_enum_v<std::decay_t<decltype(value)>>)
      ConfigTools::appendParameter(message, base::configName(name),
                                   std::string(base::choiceName(value)));
    else
      ConfigTools::appendParameter(message, base::configName(name), value);
  });
  return message;
}

// The options that `message` gives, those it does not name as in `options`. Throws InputError
// naming an option outside its limits or an unknown choice.
template <class Options>
Options withConfigMessage(Options options, const dynamic_reconfigure::Config& message) {
  visitOptions(options, [&](const char* name, auto& value, const base::OptionInfo& info) {
    using Value = std::decay_t<decltype(value)>;
    using dynamic_reconfigure::ConfigTools;
    if constexpr (std::is_enum_v<Value>) {
      std::string text;
      if (ConfigTools::getParameter(message, base::configName(name), text))
        value = base::choiceFromName<Value>(name, optionText(name, text));
    } else if (ConfigTools::getParameter(message, base::configName(name), value)) {
      if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, double>)
        base::checkLimits(name, static_cast<double>(value), info);
      else if constexpr (std::is_same_v<Value, std::string>)
        value = optionText(name, value);
    }
  });
  return options;
}

template <class Config, class Options>
Options optionsFromConfig(const Options& present, const Config& config) {
  dynamic_reconfigure::Config message;
  config.__toMessage__(message);
  return withConfigMessage(present, message);
}

template <class Config, class Options>
Config configFromOptions(const Options& options) {
  Config config = Config::__getDefault__();
  dynamic_reconfigure::Config message = configMessage(options);
  for (const auto& parameter : Config::__getParamDescriptions__())
    parameter->fromMessage(message, config);
  return config;
}

// What dynamic_reconfigure's server keeps: it would ask for and set every parameter one by one, twice as a node
// starts and again with every request; Reconfigurable stores them.
template <class Config, class Options>
struct ReconfiguredConfig : Config {
  ReconfiguredConfig() = default;
  ReconfiguredConfig(const Config& config) : Config(config) {}
  void __fromServer__(const ros::NodeHandle& private_nh) {
    Options options;
    loadParameters(private_nh, options);
    static_cast<Config&>(*this) = configFromOptions<Config>(options);
  }
  void __toServer__(const ros::NodeHandle&) const {}
};

// Keeps `Options` open to dynamic_reconfigure. `apply` gets every accepted request once, in the
// thread of the requests, and throws InputError to refuse one: then the old options stay in force,
// the reason is logged and published (refused_parameter.h), and the answer to the request holds the
// old values.
template <class Config, class Options>
class Reconfigurable {
 public:
  using Apply = std::function<void(const Options&)>;

  // `initial` is in force already: `apply` is not called for it. The parameters are set to it, so
  // that parameters, server and node agree also where a value was given as another type.
  Reconfigurable(const ros::NodeHandle& private_nh, const Options& initial, Apply apply)
      : private_nh_(private_nh),
        refused_(private_nh),
        options_(initial),
        apply_(std::move(apply)),
        server_(mutex_, agreeing(private_nh, initial)) {
    server_.setCallback([this](Served& config, uint32_t) { onRequest(config); });
  }

 private:
  using Served = ReconfiguredConfig<Config, Options>;

  static const ros::NodeHandle& agreeing(const ros::NodeHandle& private_nh,
                                         const Options& initial) {
    storeParameters(private_nh, initial);
    return private_nh;
  }

  void onRequest(Config& config) {
    if (!started_) {  // setCallback calls once with the values of the parameters
      started_ = true;
      config = configFromOptions<Config>(options_);
      return;
    }
    try {
      const Options wanted = optionsFromConfig(options_, config);
      apply_(wanted);
      options_ = wanted;
      storeParameters(private_nh_, options_);
      refused_.accept();
    } catch (const std::exception& error) {
      ROS_ERROR_STREAM("Reconfiguration of " << private_nh_.getNamespace()
                                             << " refused, the old values stay: " << error.what());
      refused_.refuse(error.what());
      config = configFromOptions<Config>(options_);
    }
  }

  ros::NodeHandle private_nh_;
  RefusedParameter refused_;
  Options options_;
  Apply apply_;
  bool started_ = false;
  boost::recursive_mutex mutex_;
  dynamic_reconfigure::Server<Served> server_;
};

}  // namespace grid_path_planner::nodes
