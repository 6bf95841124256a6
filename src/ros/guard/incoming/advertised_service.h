// How a node advertises its services: requests whose lengths lie are refused before they are unpacked
// (claimed_lengths.h), and no answer is lost to the end of its connection (service_caller.h).
//
//   service = advertiseService<SaveFile>(private_nh, "save_map", [](auto& request, auto& response) {
//     return saveMap(request, response);
//   });
//
// The client of a request that lies gets roscpp's answer to a service that failed, the log the reason. The
// server of dynamic_reconfigure advertises by itself: ServiceCallbackHelperT::call is specialized for it
// (parameters.h).
#pragma once

#include <ros/advertise_service_options.h>
#include <ros/node_handle.h>
#include <ros/service_callback_helper.h>

#include <boost/function.hpp>
#include <boost/make_shared.hpp>
#include <string>

#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/guard/incoming/service_caller.h"

namespace grid_path_planner::nodes {

// Before a call of a service is handled. Throws as checkClaimedLengths does.
template <class Request>
void prepareCall(const ros::ServiceCallbackHelperCallParams& call) {
  leaveEndToClient(call.connection_header);
  const auto before = static_cast<std::size_t>(call.request.message_start - call.request.buf.get());
  checkClaimedLengths<Request>(call.request.message_start,
                               static_cast<std::uint32_t>(call.request.num_bytes - before));
}

// `Spec` is that of the callback, as in ros::ServiceCallbackHelperT.
template <class Spec>
class PreparedCalls : public ros::ServiceCallbackHelperT<Spec> {
 public:
  using Base = ros::ServiceCallbackHelperT<Spec>;
  using Base::Base;

  bool call(ros::ServiceCallbackHelperCallParams& given) override {
    prepareCall<typename Spec::RequestType>(given);
    return Base::call(given);
  }
};

// `Spec` says what the callback takes: ros::ServiceSpec or ros::ServiceEvent.
template <class Spec>
ros::ServiceServer advertiseServiceBySpec(ros::NodeHandle nh, const std::string& name,
                                          const typename Spec::CallbackType& callback) {
  ros::AdvertiseServiceOptions options;
  options.template initBySpecType<Spec>(name, callback);
  options.helper = boost::make_shared<PreparedCalls<Spec>>(callback);
  return nh.advertiseService(options);
}

template <class Service>
ros::ServiceServer advertiseService(
    const ros::NodeHandle& nh, const std::string& name,
    const boost::function<bool(typename Service::Request&, typename Service::Response&)>& answer) {
  return advertiseServiceBySpec<
      ros::ServiceSpec<typename Service::Request, typename Service::Response>>(nh, name, answer);
}

}  // namespace grid_path_planner::nodes
