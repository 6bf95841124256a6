// Text of strangers, of the network or of a file, that ends in logs, sentences and messages.
//
//   checkPlainText("the name of a model", "hull", 256);   // throws
//   use(cleanedText("hull\n", 2000));                     // "hull "
#pragma once

#include <cstddef>
#include <string>

namespace grid_path_planner::base {

// Throws InputError that calls the text `what` and does not quote it: for more than `longest` bytes, control
// characters, also those from U+0080 to U+009F, which begin escape sequences of terminals, and bytes that are
// no UTF-8.
void checkPlainText(const std::string& what, const std::string& text, std::size_t longest);

// The text's first `longest` bytes or a few less, on one line of UTF-8: a space stands for each control
// character, a question mark for each byte of no character.
std::string cleanedText(const std::string& text, std::size_t longest);

}  // namespace grid_path_planner::base
