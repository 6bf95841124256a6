#include "ros/rviz/parameter_controls.h"

#include <dynamic_reconfigure/config_tools.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QSignalBlocker>
#include <QSpinBox>
#include <set>
#include <type_traits>
#include <utility>

#include "grid_path_planner/planning/path_planner.h"

namespace grid_path_planner::nodes {

using base::OptionInfo;
using dynamic_reconfigure::Config;
using dynamic_reconfigure::ConfigTools;
using planning::PlannerOptions;

namespace {

const std::set<std::string>& shownNames() {
  static const std::set<std::string> names = {
      "planner",         "free_weight", "unknown_weight", "unknown_is_passable",
      "occupied_weight", "radius",      "decay",          "kernel"};
  return names;
}

// One parameter as its control gives it.
template <class Value>
Config configOf(const std::string& name, const Value& value) {
  Config config;
  ConfigTools::appendParameter(config, name, value);
  return config;
}

// Calls `set` with the value that the message has of a parameter.
template <class Value, class Set>
auto setterOf(const std::string& name, Set set) {
  return [name, set](const Config& config) {
    Value value{};
    if (ConfigTools::getParameter(config, name, value)) set(value);
  };
}

QComboBox* boxOf(const std::vector<std::string>& choices) {
  auto* box = new QComboBox;
  for (const std::string& choice : choices) box->addItem(QString::fromStdString(choice));
  return box;
}

template <class Enum>
std::vector<std::string> namesOf() {
  std::vector<std::string> names;
  for (const auto& choice : choicesOf(Enum{})) names.emplace_back(choice.first);
  return names;
}

// A number: sent when Enter is pressed, the arrows are used or the control is left.
template <class Box, class Value>
Box* numberBox(const OptionInfo& info, Value value) {
  auto* box = new Box;
  box->setRange(static_cast<Value>(info.minimum), static_cast<Value>(info.maximum));
  box->setKeyboardTracking(false);
  box->setValue(value);
  if (*info.unit != '\0') box->setSuffix(QString(" ") + info.unit);
  return box;
}

template <class Box, class Value>
void setQuietly(Box* box, Value value) {
  const QSignalBlocker quiet(box);
  box->setValue(value);
}

}  // namespace

ParameterControls::ParameterControls(Changed changed, QWidget* parent)
    : QWidget(parent), changed_(std::move(changed)) {
  auto* form = new QFormLayout(this);
  form->setContentsMargins(0, 0, 0, 0);
  form->setVerticalSpacing(2);
  PlannerOptions options;
  visitOptions(options, [&](const char* name, auto& value, const OptionInfo& info) {
    using Value = std::decay_t<decltype(value)>;
    if (shownNames().count(name) == 0) return;
    QWidget* control = nullptr;
    if constexpr (std::is_same_v<Value, bool>)
      control = switchControl(name);
    else if constexpr (std::is_arithmetic_v<Value>)
      control = numberControl(name, value, info);
    else if constexpr (std::is_enum_v<Value>)
      control = choiceControl(name, namesOf<Value>());
    else
      control = choiceControl(name, info.names());
    control->setToolTip(info.description);
    form->addRow(name, control);
  });
}

void ParameterControls::show(const Config& config) {
  for (const auto& set : setters_) set(config);
}

QWidget* ParameterControls::numberControl(const std::string& name, int value,
                                          const OptionInfo& info) {
  auto* box = numberBox<QSpinBox>(info, value);
  connect(box, QOverload<int>::of(&QSpinBox::valueChanged), this,
          [this, name](int wanted) { changed_(configOf(name, wanted)); });
  setters_.push_back(setterOf<int>(name, [box](int shown) { setQuietly(box, shown); }));
  return box;
}

QWidget* ParameterControls::numberControl(const std::string& name, double value,
                                          const OptionInfo& info) {
  auto* box = numberBox<QDoubleSpinBox>(info, value);
  box->setSingleStep(0.1);
  box->setDecimals(3);
  connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
          [this, name](double wanted) { changed_(configOf(name, wanted)); });
  setters_.push_back(setterOf<double>(name, [box](double shown) { setQuietly(box, shown); }));
  return box;
}

QWidget* ParameterControls::switchControl(const std::string& name) {
  auto* box = new QCheckBox;
  connect(box, &QCheckBox::clicked, this, [this, name](bool on) { changed_(configOf(name, on)); });
  setters_.push_back(setterOf<bool>(name, [box](bool on) { box->setChecked(on); }));
  return box;
}

// Only a choice of the user is sent, so setting it needs no care.
QWidget* ParameterControls::choiceControl(const std::string& name,
                                          const std::vector<std::string>& choices) {
  auto* box = boxOf(choices);
  connect(box, QOverload<int>::of(&QComboBox::activated), this,
          [this, name, box](int) { changed_(configOf(name, box->currentText().toStdString())); });
  setters_.push_back(setterOf<std::string>(name, [box](const std::string& shown) {
    box->setCurrentText(QString::fromStdString(shown));
  }));
  return box;
}

}  // namespace grid_path_planner::nodes
