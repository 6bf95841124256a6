#include "study/study_folder.h"

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::study {

using base::InputError;

StudyFolder::StudyFolder(const std::string& folder, std::uint64_t fingerprint)
    : RunFolder(folder, "study", fingerprint) {
  for (std::size_t i = 0; i < lines().size(); ++i) {
    try {
      runs_.push_back(runFromLine(lines()[i]));
    } catch (const InputError& error) {
      throw InputError(placeOf(i), error.what());
    }
  }
}

}  // namespace grid_path_planner::study
