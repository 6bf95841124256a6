// Parameters of path_planner as controls, made of the options' own descriptions.
// The function that is given gets what the user changed; show() takes what the node has, which is not sent
// back.
#pragma once

#include <dynamic_reconfigure/Config.h>

#include <QWidget>
#include <functional>
#include <string>
#include <vector>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::nodes {

class ParameterControls : public QWidget {
 public:
  // `changed` is given one parameter, when its control was left or its value chosen.
  using Changed = std::function<void(const dynamic_reconfigure::Config&)>;

  explicit ParameterControls(Changed changed, QWidget* parent = nullptr);

  void show(const dynamic_reconfigure::Config& config);

 private:
  QWidget* numberControl(const std::string& name, int value, const base::OptionInfo& info);
  QWidget* numberControl(const std::string& name, double value, const base::OptionInfo& info);
  QWidget* switchControl(const std::string& name);
  QWidget* choiceControl(const std::string& name, const std::vector<std::string>& choices);

  Changed changed_;
  std::vector<std::function<void(const dynamic_reconfigure::Config&)>> setters_;
};

}  // namespace grid_path_planner::nodes
