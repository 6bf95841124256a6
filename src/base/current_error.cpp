#include "base/current_error.h"

#include <new>
#include <stdexcept>

namespace grid_path_planner::base {

std::string currentErrorText() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return "there is not enough memory";
  } catch (const std::length_error&) {
    return "it asks for more than any memory holds";
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "an error without a name";
  }
}

}  // namespace grid_path_planner::base
