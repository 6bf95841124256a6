#include "ros/rviz/panel_widgets.h"

#include <QFont>
#include <initializer_list>
#include <utility>

namespace grid_path_planner::nodes {

using panel::Buttons;
using panel::PanelModel;
using panel::Tone;

namespace {

QPushButton* buttonOf(const char* text, const char* tip) {
  auto* button = new QPushButton(text);
  button->setObjectName(text);
  button->setToolTip(tip);
  button->setMinimumWidth(10);
  return button;
}

QLabel* wrappedLabel() {
  auto* label = new QLabel;
  label->setWordWrap(true);
  label->setTextFormat(Qt::PlainText);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return label;
}

void addRow(QVBoxLayout* column, std::initializer_list<QWidget*> widgets) {
  auto* row = new QHBoxLayout;
  row->setSpacing(3);
  for (QWidget* widget : widgets) row->addWidget(widget);
  column->addLayout(row);
}

const char* styleOf(Tone tone) {
  switch (tone) {
    case Tone::BUSY:
      return "color: #0072b2";
    case Tone::GOOD:
      return "color: #00724f";
    case Tone::BAD:
      return "color: #b34700; font-weight: bold";
    case Tone::CALM:
      break;
  }
  return "";
}

// Setting what is there already would cost a new layout ten times a second.
void setText(QLabel* label, const std::string& text) {
  const QString shown = QString::fromStdString(text);
  if (label->text() != shown) label->setText(shown);
}

void setStyle(QWidget* widget, const QString& style) {
  if (widget->styleSheet() != style) widget->setStyleSheet(style);
}

// Flat, in a colour that nothing else in rviz has: who tests the panel finds it on the screen.
constexpr char kFirstButton[] =
    "QPushButton:enabled { background: #0b5fa5; color: white; border: 1px solid #0b5fa5; "
    "border-radius: 3px; padding: 3px; }";

}  // namespace

PanelReport::PanelReport()
    : sentence_(wrappedLabel()),
      figures_(wrappedLabel()),
      driving_(wrappedLabel()),
      progress_(new QProgressBar) {
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  progress_->setMaximumHeight(10);
}

void PanelReport::addTo(QVBoxLayout* column) const {
  for (QWidget* widget : std::initializer_list<QWidget*>{sentence_, figures_, driving_, progress_})
    column->addWidget(widget);
}

void PanelReport::show(const PanelModel& model) {
  setText(sentence_, model.sentence());
  setStyle(sentence_, styleOf(model.tone()));
  setText(figures_, model.figures());
  setText(driving_, model.driveText());
  progress_->setValue(static_cast<int>(1000.0 * model.progress().share().value_or(0.0)));
}

PanelWidgets::PanelWidgets(QWidget* parent, ParameterControls* parameters)
    : name_space(new QLineEdit),
      nodes(wrappedLabel()),
      start_at_vehicle(buttonOf("From vehicle", "Plans start where the vehicle is")),
      remove_via(buttonOf("Remove via", "Takes the last via-point away")),
      clear(buttonOf("Clear", "Takes away all points, the path and the comparison")),
      best_order(new QCheckBox("Via-points in the best order")),
      plan(buttonOf("Plan",
                    "A path through the via-points to the goal; it follows what is dragged")),
      compare(buttonOf("Compare", "The paths of the planners that are ticked below, side by side")),
      explain(buttonOf("Explain", "Why there is no path, and what would have to change")),
      drive(buttonOf("Drive", "The vehicle drives the path that is shown")),
      pause(buttonOf("Pause", "The vehicle stops, and keeps its path")),
      resume(buttonOf("Resume", "The vehicle goes on")),
      cancel(buttonOf("Cancel", "Ends planning and driving: the vehicle stops")),
      save(buttonOf("Save ...", "Writes the path that is shown as a waypoint file")),
      load(buttonOf("Load ...", "Reads a waypoint file, to be driven")),
      comparison(new ComparisonTable) {
  auto* column = new QVBoxLayout(parent);
  column->setSpacing(4);
  plan->setStyleSheet(kFirstButton);
  name_space->setObjectName("Namespace");
  name_space->setPlaceholderText("namespace of the nodes");
  name_space->setToolTip("Of path_planner and navigate_path, such as /a; empty: that of rviz");
  comparison->setMinimumHeight(120);
  addRow(column, {name_space, nodes});
  column->addWidget(parameters);
  addRow(column, {start_at_vehicle, remove_via, clear});
  best_order->setToolTip(
      "In the order that costs least, instead of the one in which they were set");
  column->addWidget(best_order);
  addRow(column, {plan, compare, explain});
  addRow(column, {drive, pause, resume, cancel});
  addRow(column, {save, load});
  report.addTo(column);
  column->addWidget(comparison, 1);
}

void PanelWidgets::show(const PanelModel& model) {
  const Buttons may = model.buttons();
  const std::initializer_list<std::pair<QPushButton*, bool>> buttons = {
      {plan, may.plan},
      {compare, may.compare},
      {explain, may.explain},
      {drive, may.drive},
      {pause, may.pause},
      {resume, may.resume},
      {cancel, may.cancel},
      {save, may.save},
      {start_at_vehicle, model.points().start().has_value()},
      {remove_via, !model.points().via().empty()}};
  for (const auto& [button, enabled] : buttons) button->setEnabled(enabled);
  setText(nodes, model.nodesText());
  report.show(model);
}

}  // namespace grid_path_planner::nodes
