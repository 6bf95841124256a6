// A trial whose measurements are a bag's: its file, which rows it allows, and its tape.
//
//   localization::NavigationRecording recording;  // of trial.bag
//   const RecordedTrial trial = readRecordedTrialFile("dive.yaml", [](auto& name, auto& text) { return false; });
//   const std::vector<RecordedRow> rows = rowsOf(recording);
//   const SensorTape tape = tapeOf(trial, recording);
#pragma once

#include <map>
#include <string>
#include <vector>

#include "localization/recording/navigation_recording.h"
#include "trials/sensor_tape.h"
#include "trials/trial_nodes.h"
#include "trials/trial_rows.h"

namespace grid_path_planner::trials {

struct RecordedTrial : TrialSettings {
  std::string file;
  std::string title;
  std::string bag;
  localization::NavigationTopics topics;
  std::string truth_frame;                               // of tf; "": the truth is a topic
  std::map<std::string, localization::Mounting> frames;  // in base_link
};

// Whether the trial of this file is a recorded one. Throws InputError where it is no YAML.
bool isRecordedTrial(const std::string& file);

// Its options of `localizer` are given to `set`; file names are relative to its folder. Throws InputError naming file
// and line.
RecordedTrial readRecordedTrialFile(const std::string& file, const TrialNodes::SetOption& set);

// A row, and why the recording does not allow it; "" where it does.
struct RecordedRow {
  TrialRow row;
  std::string missing;
};
std::vector<RecordedRow> rowsOf(const localization::NavigationRecording& recording);

// The instants are those of the marker poses, and as many in between as are wanting; 5 Hz where there are none.
// Throws InputError for more than a million.
SensorTape tapeOf(const RecordedTrial& trial, const localization::NavigationRecording& recording);

}  // namespace grid_path_planner::trials
