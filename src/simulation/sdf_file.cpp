#include "simulation/sdf_file.h"

#include <iostream>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "base/plain_text.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::simulation {

using base::cleanedText;
using base::InputError;

namespace {

// What libsdformat prints, kept from the terminal for as long as this lives: of an error of syntax
// it returns only that there was one, and prints in which line.
class CapturedConsole {
 public:
  CapturedConsole() : stream_(console_->GetMsgStream()), before_(stream_.GetStream()) {
    stream_.SetStream(&text_);
  }
  ~CapturedConsole() { stream_.SetStream(before_); }
  CapturedConsole(const CapturedConsole&) = delete;
  CapturedConsole& operator=(const CapturedConsole&) = delete;

  // On one line, without colours.
  std::string text() const {
    const std::string plain = std::regex_replace(text_.str(), std::regex("\x1b\\[[0-9;]*m"), "");
    return std::regex_replace(plain, std::regex("\\s*\n\\s*(?=.)"), "; ");
  }

 private:
  const sdf::ConsolePtr console_ = sdf::Console::Instance();
  sdf::Console::ConsoleStream& stream_;
  std::ostream* const before_;
  std::ostringstream text_;
};

class FindCallback {
 public:
  explicit FindCallback(const std::function<std::string(const std::string&)>& find) {
    sdf::setFindCallback(find);
  }
  ~FindCallback() { sdf::setFindCallback(nullptr); }
  FindCallback(const FindCallback&) = delete;
  FindCallback& operator=(const FindCallback&) = delete;
};

constexpr std::size_t kLongestText = 2000;  // of a file that gives cause to a warning a line

std::string withoutEnd(std::string text) {
  text.erase(text.find_last_not_of(" \n;.") + 1);
  return text;
}

}  // namespace

sdf::Root loadSdf(const std::string& file,
                  const std::function<std::string(const std::string&)>& find) {
  const FindCallback callback(find);
  sdf::Root root;
  sdf::Errors errors;
  std::string printed;
  {
    const CapturedConsole console;
    try {
      errors = root.Load(file);
    } catch (const std::logic_error& error) {  // std::stoi's, of a version that is no number
      throw InputError(file,
                       std::string("libsdformat does not accept it: a number in it is none (") +
                           error.what() + ")");
    }
    printed = cleanedText(withoutEnd(console.text()), kLongestText);
  }
  if (errors.empty()) {
    if (!printed.empty()) std::cerr << file << ": " << printed << "\n";
    return root;
  }
  std::ostringstream complaint;
  complaint << "libsdformat does not accept it: " << errors.front();
  if (!printed.empty()) complaint << "; " << printed;
  throw InputError(file, complaint.str());
}

}  // namespace grid_path_planner::simulation
