// The processor time of robot_localization's filters: of a prediction, and of an update by a 6-D pose.
//
//   filter_core
//
// One line for the EKF and one for the UKF, to run in turn with grid_path_planner_localization_filter.
#include <robot_localization/ekf.h>
#include <robot_localization/ukf.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>

namespace {

using namespace RobotLocalization;

double cpuMicroseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

template <class Call>
double microsecondsOf(int count, const Call& call) {
  const double start = cpuMicroseconds();
  for (int i = 0; i < count; ++i) call();
  return (cpuMicroseconds() - start) / count;
}

Measurement poseMeasurement() {
  Measurement measurement;
  measurement.topicName_ = "pose";
  measurement.updateVector_.assign(STATE_SIZE, 0);
  for (const int index : {StateMemberX, StateMemberY, StateMemberZ, StateMemberRoll,
                          StateMemberPitch, StateMemberYaw})
    measurement.updateVector_[static_cast<std::size_t>(index)] = 1;
  measurement.measurement_ = Eigen::VectorXd::Zero(STATE_SIZE);
  measurement.measurement_[StateMemberX] = 1.0;
  measurement.covariance_ = Eigen::MatrixXd::Identity(STATE_SIZE, STATE_SIZE);
  return measurement;
}

void measure(const char* name, FilterBase& filter) {
  Eigen::VectorXd state = Eigen::VectorXd::Zero(STATE_SIZE);
  state[StateMemberX] = 1.0;
  state[StateMemberYaw] = 0.3;
  state[StateMemberVx] = 0.5;
  filter.setState(state);
  filter.setProcessNoiseCovariance(1e-3 * Eigen::MatrixXd::Identity(STATE_SIZE, STATE_SIZE));
  filter.setEstimateErrorCovariance(0.1 * Eigen::MatrixXd::Identity(STATE_SIZE, STATE_SIZE));
  const double predict = microsecondsOf(100000, [&] { filter.predict(0.0, 1e-6); });
  const Measurement measurement = poseMeasurement();
  const double update = microsecondsOf(100000, [&] { filter.correct(measurement); });
  std::printf("robot_localization %s: prediction %.2f us, 6-D update %.2f us\n", name, predict,
              update);
}

}  // namespace

int main() {
  Ekf ekf;
  measure("EKF", ekf);
  Ukf ukf(std::vector<double>{0.001, 0.0, 2.0});
  measure("UKF", ukf);
  return 0;
}
