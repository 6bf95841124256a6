// What studies find in their folders when they are gone on with, and what a program answers that flies one.
#include "flights/flight_record.h"
#include "flights/program_pilot.h"
#include "fuzz/fuzz_target.h"
#include "study/study_run.h"
#include "trials/trial_record.h"

namespace grid_path_planner::fuzz {
namespace {

// A line that is read is written and read again to the same.
template <class Read>
void readAgain(const std::string& line, const Read& read) {
  mayRefuse([&] {
    const std::string again = lineOf(read(line));
    mustHold(lineOf(read(again)) == again, "what is read is written so that it can be read");
  });
}

// The first byte says of which study the line is.
std::vector<std::string> seedsOfRecords() {
  study::StudyRun run;
  run.status = base::Status::FOUND;
  run.cost = run.optimum = 3.5;
  run.times_ms = {0.5};
  run.path_xy = {0.5F, 1.5F};
  flights::FlightRecord flight;
  flight.end = flights::FlightEnd::HOME;
  flight.path = {{0.5F, 1.0F, 2.0F}};
  trials::RunRecord trial;
  trial.rows.emplace_back();
  trials::SeenFrame frame;
  frame.solutions.resize(1);
  std::string damaged = lineOf(flight);
  damaged.replace(damaged.find("\"seed\":0"), 8, "\"seed\":1e300");
  return {"0" + lineOf(run),   "1" + lineOf(flight), "2" + lineOf(trial),
          "3" + lineOf(frame), "1" + damaged,        "4" + lineOf(trials::RowRecord())};
}

FUZZ_TARGET(study_record, seedsOfRecords) {
  if (input.empty()) return;
  const std::string line = input.substr(1);
  switch (input.front()) {
    case '0':
      return readAgain(line, study::runFromLine);
    case '1':
      return readAgain(line, flights::recordFromLine);
    case '2':
      return readAgain(line, trials::runFromLine);
    case '3':
      return readAgain(line, trials::frameFromLine);
    default:
      return readAgain(line, trials::rowFromLine);
  }
}

std::vector<std::string> seedsOfProgramAnswers() {
  return {R"({"velocity": [0.5, 0, -0.1, 0.2]})",
          R"({"velocity": [0, 0, 0, 0], "status": "ARRIVED", "sentence": "there"})"};
}

FUZZ_TARGET(program_answer, seedsOfProgramAnswers) {
  mayRefuse([&] {
    mustHold(flights::pilotAnswerFrom(input).velocity.isFinite(), "a command is finite");
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
