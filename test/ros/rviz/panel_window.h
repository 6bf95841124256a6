// The Plan Panel in the process of the test, without a screen: what is clicked is found by its name.
//
//   PanelWindow window;
//   ASSERT_TRUE(window.click("Cancel"));
//   ASSERT_TRUE(window.waitFor([&] { return window.shows("CANCELLED"); }));
//
// In the main thread.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <QApplication>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <functional>
#include <string>

#include "ros/rviz/plan_panel.h"
#include "ros/support/wait.h"

namespace grid_path_planner::test {

// Qt's, of which a process has one, until its end.
inline void beginApplication() {
  static int count = 1;
  static char name[] = "panel";
  static char* arguments[] = {name, nullptr};
  static const auto* const application = [] {
    ::setenv("QT_QPA_PLATFORM", "offscreen", 1);
    return new QApplication(count, arguments);
  }();
  ASSERT_TRUE(application);
}

class PanelWindow {
 public:
  // Once it has said who is there, which is when it says what may be pressed.
  PanelWindow() {
    EXPECT_TRUE(waitFor([&] { return shows("path_planner"); }));
  }

  // Qt's work is done while this waits.
  bool waitFor(const std::function<bool()>& condition) const {
    return test::waitFor([&] {
      QCoreApplication::processEvents();
      return condition();
    });
  }

  // Once it may be pressed; false where it may not.
  bool click(const char* name) const {
    auto* const button = panel_.findChild<QPushButton*>(name);
    if (!button || !waitFor([&] { return button->isEnabled(); })) return false;
    button->click();
    return true;
  }

  // Writes into the field of the namespace, and presses Enter.
  void lookAt(const char* name) const {
    auto* const field = panel_.findChild<QLineEdit*>("Namespace");
    ASSERT_TRUE(field);
    field->setText(name);
    Q_EMIT field->editingFinished();
  }

  // Whether one of its sentences has this in it now.
  bool shows(const std::string& text) const {
    for (const QLabel* label : panel_.findChildren<QLabel*>())
      if (label->text().contains(QString::fromStdString(text))) return true;
    return false;
  }

 private:
  struct Application {
    Application() { beginApplication(); }
  };

  Application application_;  // before any widget
  nodes::PlanPanel panel_;
};

}  // namespace grid_path_planner::test
