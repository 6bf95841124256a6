// Text that comes from the network (names of frames and files) and ends in files, logs and shells.
//
//   checkNetworkText("the frame of the map", message.header.frame_id);
//
// A name with a quote, a dollar sign, a backquote, a backslash, a control character or bytes that
// are no UTF-8 is no name that anyone gives; in a file that a shell reads it is a command.
#pragma once

#include <cstddef>
#include <string>

namespace grid_path_planner::nodes {

constexpr std::size_t kLongestNetworkText = 256;  // bytes

// Throws InputError that calls the text `what` and does not quote it. Text that may quote, such as options, is checked by
// base/plain_text.h.
void checkNetworkText(const std::string& what, const std::string& text,
                      std::size_t longest = kLongestNetworkText);

// The text, or "" where checkNetworkText refuses it: for answers that repeat what they were asked.
std::string printable(const std::string& text);

}  // namespace grid_path_planner::nodes
