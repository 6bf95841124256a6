#include "localization/localizer_options.h"

namespace grid_path_planner::localization {

void checkLocalizerOptions(const LocalizerOptions& options) {
  base::checkOptionLimits(options);
}

}  // namespace grid_path_planner::localization
