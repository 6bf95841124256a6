#include "simulation/sensors/sensor_faults.h"

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/options.h"
#include "grid_path_planner/base/yaml_file.h"

namespace grid_path_planner::simulation {

using base::choiceFromName, base::checkKeys, base::choiceName, base::describeYaml, base::InputError,
    base::yamlAs, base::yamlError, base::yamlNode, base::yamlValue;

namespace {

constexpr double kLatest = 1e9;  // s

// Reads one entry of the list; `file` is what errors name.
class FaultReader {
 public:
  FaultReader(const YAML::Node& entry, const std::string& file) : entry_(entry), file_(file) {}

  SensorFault read() const {
    checkKeys(entry_, "a fault", file_, {"sensor", "from", "to", "kind", "by"});
    SensorFault fault;
    fault.sensor = choice<SensorName>("sensor");
    fault.kind = choice<FaultKind>("kind");
    fault.from_ns = nanoseconds("from");
    fault.to_ns = nanoseconds("to");
    if (fault.to_ns <= fault.from_ns)
      throw yamlError(entry_, file_, "a fault must end after it began: to must be above from");
    fault.by = by(fault);
    return fault;
  }

 private:
  template <class E>
  E choice(const std::string& key) const {
    const auto text = yamlValue<std::string>(entry_, key, file_, "a name");
    try {
      return choiceFromName<E>(key, text);
    } catch (const InputError& error) {
      throw yamlError(entry_[key], file_, error.what());
    }
  }

  std::int64_t nanoseconds(const std::string& key) const {
    const auto seconds = yamlValue<double>(entry_, key, file_, "a number of seconds");
    if (!(seconds >= 0.0 && seconds <= kLatest))
      throw yamlError(entry_[key], file_,
                      key + " must be 0 to 1e9 s, got " + base::decimalText(seconds));
    return std::llround(seconds * 1e9);
  }

  std::vector<double> by(const SensorFault& fault) const {
    const bool wanted = fault.kind == FaultKind::OFFSET || fault.kind == FaultKind::OUTLIER;
    const std::string kind = choiceName(fault.kind);
    if (!wanted && entry_["by"])
      throw yamlError(entry_["by"], file_, "a fault of kind " + kind + " has no 'by'");
    if (!wanted) return {};
    if (fault.sensor == SensorName::CAMERA)
      throw yamlError(entry_["kind"], file_,
                      "a fault of the camera must be cut, frozen or nan (black), got " + kind);
    const std::size_t count = countOfNumbers(fault.sensor);
    const std::string expected =
        "a list of numbers, " + std::to_string(count) + " for " + choiceName(fault.sensor);
    const YAML::Node list = yamlNode(entry_, "by", file_, expected);
    if (!list.IsSequence() || list.size() != count)
      throw yamlError(list, file_, "by must be " + expected + ", got " + describeYaml(list));
    std::vector<double> numbers;
    for (const YAML::Node& number : list)
      numbers.push_back(yamlAs<double>(number, "by", file_, "a list of finite numbers"));
    return numbers;
  }

  const YAML::Node entry_;
  const std::string& file_;
};

}  // namespace

const std::vector<std::pair<const char*, FaultKind>>& choicesOf(FaultKind) {
  static const std::vector<std::pair<const char*, FaultKind>> choices = {
      {"cut", FaultKind::CUT},
      {"frozen", FaultKind::FROZEN},
      {"offset", FaultKind::OFFSET},
      {"outlier", FaultKind::OUTLIER},
      {"nan", FaultKind::NOT_A_NUMBER}};
  return choices;
}

std::optional<FaultKind> cameraFaultAt(const std::vector<SensorFault>& faults,
                                       std::int64_t time_ns) {
  for (const FaultKind kind : {FaultKind::CUT, FaultKind::FROZEN, FaultKind::NOT_A_NUMBER})
    for (const SensorFault& fault : faults)
      if (fault.sensor == SensorName::CAMERA && fault.kind == kind && fault.holdsAt(time_ns))
        return kind;
  return std::nullopt;
}

std::size_t countOfNumbers(SensorName sensor) {
  switch (sensor) {
    case SensorName::IMU:
      return 6;
    case SensorName::PRESSURE:
      return 1;
    case SensorName::CAMERA:
      return 0;
    case SensorName::DVL:
    case SensorName::USBL:
      break;
  }
  return 3;
}

std::vector<SensorFault> readSensorFaults(const std::string& file, const base::ReadLimits& limits) {
  const YAML::Node root = base::loadYamlFile(file, limits);
  checkKeys(root, "a file of faults", file, {"faults"});
  const YAML::Node list = yamlNode(root, "faults", file, "a list of faults");
  if (!list.IsSequence())
    throw yamlError(list, file, "faults must be a list, got " + describeYaml(list));
  std::vector<SensorFault> faults;
  for (const YAML::Node& entry : list) faults.push_back(FaultReader(entry, file).read());
  return faults;
}

}  // namespace grid_path_planner::simulation
