// Requests of services whose lengths lie are refused before they are unpacked (claimed_lengths.h).
//
//   using Spec = ros::ServiceSpec<ComparePlans::Request, ComparePlans::Response>;
//   service = advertiseChecked<Spec>(nh, "compare_plans",
//                                    [](auto& request, auto&) { return answer(request); });
//
// The client gets roscpp's answer to a service that failed, the log the reason. Needed where a request
// has an array; one of numbers and strings alone takes no memory for what is not there. So are those
// of dynamic_reconfigure, whose server advertises by itself: ServiceCallbackHelperT::call is
// specialized for them (parameters.h).
#pragma once

#include <ros/advertise_service_options.h>
#include <ros/node_handle.h>
#include <ros/service_callback_helper.h>

#include <boost/make_shared.hpp>
#include <string>
#include <utility>

#include "ros/common/incoming/claimed_lengths.h"

namespace grid_path_planner::nodes {

// Throws as checkClaimedLengths does.
template <class Request>
void checkRequest(const ros::SerializedMessage& request) {
  const auto before = static_cast<std::size_t>(request.message_start - request.buf.get());
  checkClaimedLengths<Request>(request.message_start,
                               static_cast<std::uint32_t>(request.num_bytes - before));
}

// `Spec` is that of the callback, as in ros::ServiceCallbackHelperT.
template <class Spec>
class CheckedRequests : public ros::ServiceCallbackHelperT<Spec> {
 public:
  using Base = ros::ServiceCallbackHelperT<Spec>;
  using Base::Base;

  bool call(ros::ServiceCallbackHelperCallParams& given) override {
    checkRequest<typename Spec::RequestType>(given.request);
    return Base::call(given);
  }
};

// As NodeHandle::advertiseService().
template <class Spec>
ros::ServiceServer advertiseChecked(ros::NodeHandle nh, const std::string& service,
                                    const typename Spec::CallbackType& callback) {
  ros::AdvertiseServiceOptions options;
  options.template initBySpecType<Spec>(service, callback);
  options.helper = boost::make_shared<CheckedRequests<Spec>>(callback);
  return nh.advertiseService(options);
}

}  // namespace grid_path_planner::nodes
