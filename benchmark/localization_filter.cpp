// What the filter of vehicle_localizer costs, and how far it is off.
//
//   grid_path_planner_localization_filter [SECONDS [RUNS [FAULTY_RUNS [HOURS]]]]
//
// Prints the processor time of a prediction, of an update by a 6-D pose, of a measurement of the IMU
// in the lagged filter, and of a fix that comes 2 s late; then, over seeded runs of so many seconds
// with the sensors of doc/localization.md, the mean normalised estimation error squared of all 15
// errors and of the pose, and the mean error at the end. At last, over runs of 90 s with one to three
// faults of sensors, how many said OK while they were off by 1 m or 12 degrees for 2 s. For each of so
// many simulated hours of one vehicle: the processor time of both filters and 50 reports a second, the
// resident memory, and the mean error.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "base/cholesky.h"
#include "localization/lagged_filter.h"
#include "localization/support/sensor_faults.h"
#include "localization/support/simulated_sensors.h"
#include "localization/vehicle_localizer.h"

namespace {

using namespace grid_path_planner::localization;

double cpuMicroseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

// Of one of `count` calls.
template <class Call>
double microsecondsOf(int count, const Call& call) {
  const double start = cpuMicroseconds();
  for (int i = 0; i < count; ++i) call(i);
  return (cpuMicroseconds() - start) / count;
}

LaggedFilter filterAfter(SimulatedSensors& sensors, double seconds) {
  LaggedFilter filter(sensors.options, Start::AT_FIX);
  for (const Measurement& measurement : sensors.run(seconds)) filter.add(measurement);
  return filter;
}

void measureSteps() {
  SimulatedSensors sensors(1);
  Estimate estimate = filterAfter(sensors, 10.0).snapshot().estimate;
  const Inertial imu = sensors.trajectory.inertialAt(10.0, 9.80665);
  const ImuNoise noise{1e-4, 1e-5, 1e-3, 1e-4, 9.80665};
  const double predict =
      microsecondsOf(100000, [&](int) { propagate(estimate, imu, 1e-6, noise); });
  const PoseFix fix{estimate.state.position, estimate.state.attitude, PoseCovariance::Identity(),
                    sensors.base};
  const double update = microsecondsOf(100000, [&](int) {
    const Eigen::Matrix<double, 6, 1> residual = poseResidual<double>(estimate.state, fix);
    Innovation(estimate, residual, poseJacobian(estimate.state, fix), fix.covariance)
        .apply(estimate);
  });
  std::printf("prediction %.2f us, 6-D update %.2f us\n", predict, update);
}

void measureArrivals() {
  SimulatedSensors sensors(1);
  const std::vector<Measurement> all = sensors.run(30.0);
  LaggedFilter filter(sensors.options, Start::AT_FIX);
  const double each = microsecondsOf(static_cast<int>(all.size()),
                                     [&](int i) { filter.add(all[static_cast<std::size_t>(i)]); });
  const double late = microsecondsOf(50, [&](int i) {
    filter.add({stampAt(28.0) + i, Source::MARKER,
                PoseFix{sensors.trajectory.stateAt(28.0).position,
                        sensors.trajectory.stateAt(28.0).attitude,
                        PoseCovariance::Identity(),
                        {}}});
  });
  std::printf("a measurement %.2f us, a fix that comes 2 s late %.0f us\n", each, late);
}

void measureErrors(double seconds, unsigned runs) {
  double all = 0.0, of_pose = 0.0, metres = 0.0, degrees = 0.0;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    SimulatedSensors sensors(seed);
    const Estimate estimate = filterAfter(sensors, seconds).snapshot().estimate;
    const ErrorVector error = errorBetween<double>(estimate.state, sensors.truthAt(seconds));
    Eigen::Matrix<double, 6, 1> pose;
    pose << error.segment<3>(kPosition), error.segment<3>(kAttitude);
    all +=
        grid_path_planner::base::Cholesky<kErrors>(estimate.covariance).squaredMahalanobis(error) /
        runs;
    of_pose +=
        grid_path_planner::base::Cholesky<6>(poseOf(estimate).covariance).squaredMahalanobis(pose) /
        runs;
    metres += pose.head<3>().norm() / runs;
    degrees += pose.tail<3>().norm() * 180.0 / M_PI / runs;
  }
  std::printf("%u runs of %.0f s: NEES %.2f of 15, %.2f of 6; %.3f m, %.2f deg\n", runs, seconds,
              all, of_pose, metres, degrees);
}

void measureFaults(unsigned runs) {
  unsigned wrong = 0;
  double ok = 0.0;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    const FaultRun run = runWithFaults(seed, 90.0);
    wrong += run.longest >= 2.0;
    ok += run.ok / runs;
    if (run.longest >= 2.0) std::printf("seed %u: OK for %.1f s while off\n", seed, run.longest);
  }
  std::printf("%u of %u runs with faults said OK while off; OK %.2f of the time\n", wrong, runs,
              ok);
}

double residentMegabytes() {
  long pages = 0, resident = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%ld %ld", &pages, &resident) != 2) resident = 0;
    std::fclose(file);
  }
  return static_cast<double>(resident * sysconf(_SC_PAGESIZE)) / 1e6;
}

void measureHour(SimulatedSensors& sensors, VehicleLocalizer& localizer, int hour) {
  constexpr int kSeconds = 3600, kReports = 50;
  double cpu = 0.0, off = 0.0;
  for (int second = 1; second <= kSeconds; ++second) {
    const double now = (hour - 1) * kSeconds + second;
    const std::vector<Measurement> measurements = sensors.run(1.0);
    cpu -= cpuMicroseconds();
    for (const Measurement& measurement : measurements) localizer.add(measurement);
    for (int i = 0; i < kReports; ++i) localizer.report(stampAt(now));
    cpu += cpuMicroseconds();
    const auto pose = localizer.mapAt(stampAt(now));
    if (pose) off += (pose->estimate.state.position - sensors.truthAt(now).position).norm();
  }
  std::printf("hour %d: %.2f s of CPU, %.1f MB, %s, %.3f m off\n", hour, 1e-6 * cpu,
              residentMegabytes(), nameOf(localizer.report(stampAt(hour * kSeconds)).status),
              off / kSeconds);
}

void measureHours(int hours) {
  SimulatedSensors sensors(1);
  VehicleLocalizer localizer{LocalizerOptions()};
  for (int hour = 1; hour <= hours; ++hour) measureHour(sensors, localizer, hour);
}

}  // namespace

int main(int argc, char** argv) {
  measureSteps();
  measureArrivals();
  measureErrors(argc > 1 ? std::atof(argv[1]) : 60.0,
                argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 50);
  measureFaults(argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : 4);
  measureHours(argc > 4 ? std::atoi(argv[4]) : 0);
  return 0;
}
