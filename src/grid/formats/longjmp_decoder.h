// What the decoders around C libraries have in common whose errors come as longjmp, which runs no
// destructors: attempt() alone calls setjmp, and what is run there owns nothing.
#pragma once

#include <csetjmp>
#include <string>

#include "grid/formats/image_formats.h"

namespace grid_path_planner::grid {

class LongjmpDecoder {
 protected:
  // All outlive this.
  LongjmpDecoder(const std::string& content, const std::string& file, const ImageLimits& limits)
      : content_(content), file_(file), limits_(limits) {}
  LongjmpDecoder(const LongjmpDecoder&) = delete;
  LongjmpDecoder& operator=(const LongjmpDecoder&) = delete;
  ~LongjmpDecoder() = default;

  // Throws InputError where the library found an error, or the time is over.
  template <typename Calls>
  void run(const Calls& calls) {
    if (attempt(calls)) return;
    if (late_) limits_.limits.goOn(file_);
    if (ends_early_) refuseEarlyEnd(file_, content_.size());
    refuseImage(file_, std::string("it is damaged: ") + message_);
  }

  const std::string& content_;
  const std::string& file_;
  const ImageLimits& limits_;
  // Set before longjmp(jump_, 1).
  bool ends_early_ = false;
  bool late_ = false;
  char message_[200] = "";  // as long as libjpeg's are at most
  std::jmp_buf jump_;

 private:
  template <typename Calls>
  bool attempt(const Calls& calls) {
    if (setjmp(jump_) != 0) return false;
    calls();
    return true;
  }
};

}  // namespace grid_path_planner::grid
