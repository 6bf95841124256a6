// Bags of images before a panel with three markers, played to marker_localizer: what cameras have done to other
// localisers, a layout that is off, and time that goes back.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "ros/support/bag_player.h"
#include "ros/support/latest.h"
#include "ros/support/panel_image.h"
#include "ros/support/panel_site.h"
#include "ros/support/process.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using Eigen::Isometry3d;
using geometry_msgs::PoseWithCovarianceStamped;
using sensor_msgs::CameraInfo;
using sensor_msgs::Image;
using test::contains;
using test::Latest;
using test::waitFor;

constexpr int kImages = 8;
const ros::Time kFirstImage(100);
// Less than what a stamp may be ahead (0.1 s): the clock may come after the image.
const ros::Duration kImagePeriod(0.08), kAfterImage(0.02);

ros::Time stampOfImage(int image) {
  return kFirstImage + kImagePeriod * image;
}

// Half a centimetre sideways from image to image.
Isometry3d mapFromBaseAt(int image) {
  return Eigen::Translation3d(0.0, -0.005 * image, 0.0) * test::mapFromBase();
}

Image drawnAt(int image) {
  return test::panelImage(
      test::mapFromPanel().inverse() * mapFromBaseAt(image) * test::baseFromCamera(),
      stampOfImage(image), test::kPanelFocal, 3);
}

// Each is drawn once, which takes a third of a second without optimisation.
const Image& imageAt(int image) {
  static const std::vector<Image> images = [] {
    std::vector<Image> drawn;
    for (int i = 0; i < kImages; ++i) drawn.push_back(drawnAt(i));
    return drawn;
  }();
  return images[static_cast<std::size_t>(image)];
}

// What comes after an image, and why it is refused.
struct Trouble {
  int after;
  std::string input, sentence;
  std::function<void(rosbag::Bag&, const ros::Time&)> write;
};

Trouble imageTrouble(int after, const std::string& sentence,
                     const std::function<void(Image&)>& spoil) {
  return {after, "images", sentence, [=](rosbag::Bag& bag, const ros::Time& time) {
            Image image = imageAt(after);
            image.header.stamp = time;
            spoil(image);
            bag.write("camera/image_raw", time, image);
          }};
}

Trouble infoTrouble(int after, const std::string& sentence, const CameraInfo& info) {
  return {after, "camera_info", sentence, [=](rosbag::Bag& bag, const ros::Time& time) {
            bag.write("camera/camera_info", time, info);
          }};
}

// Those of an image come one at a time: the newest reason of an input is that of its trouble.
std::vector<Trouble> allTroubles() {
  CameraInfo nan = test::panelCamera();
  nan.K[4] = std::numeric_limits<double>::quiet_NaN();
  return {
      imageTrouble(1, "not newer than the one before",
                   [](Image& i) { i.header.stamp = stampOfImage(1); }),
      infoTrouble(1, "0 x 0 pixels", CameraInfo()),
      imageTrouble(2, "not newer than the one before",
                   [](Image& i) { i.header.stamp = stampOfImage(1); }),
      infoTrouble(2, "not calibrated", nan),
      imageTrouble(3, "s ahead of ROS time",
                   [](Image& i) { i.header.stamp = ros::Time(4294967295u, 0); }),
      imageTrouble(4, "s old", [](Image& i) { i.header.stamp = ros::Time(1, 0); }),
      imageTrouble(5, "'nowhere'", [](Image& i) { i.header.frame_id = "nowhere"; }),
      imageTrouble(6, "the calibration 240 x 160",
                   [](Image& i) {
                     i.height /= 2;
                     i.data.resize(i.data.size() / 2);
                   }),
  };
}

void writeBag(const std::string& file, const std::vector<Trouble>& troubles,
              const CameraInfo& calibration) {
  rosbag::Bag bag(file, rosbag::bagmode::Write);
  for (int image = 0; image < kImages; ++image) {
    const ros::Time time = stampOfImage(image);
    tf2_msgs::TFMessage frames;
    frames.transforms = {
        test::stampedTransform("base_link", "camera", test::baseFromCamera(), time),
        test::stampedTransform("map", "base_link", mapFromBaseAt(image), time),
    };
    bag.write("/tf", time, frames);
    if (image == 0) bag.write("camera/camera_info", time, calibration);
    bag.write("camera/image_raw", time + ros::Duration(0.001), imageAt(image));
    for (const Trouble& trouble : troubles)
      if (trouble.after == image) trouble.write(bag, time + kAfterImage);
  }
}

// With the third marker so far above its place (m).
std::string layoutWith(double off) {
  return "family: 36h11\ntag_size: 0.2\nplate_size: 0.25\nmarkers:\n"
         "  - {id: 0, position: [-0.2, 0, 0], rpy: [0, 0, 0]}\n"
         "  - {id: 1, position: [0.2, 0, 0], rpy: [0, 0, 0]}\n"
         "  - {id: 2, position: [0, " +
         std::to_string(0.22 + off) + ", 0], rpy: [0, 0, 0]}\n";
}

class MarkerLocalizerBagTest : public testing::Test {
 protected:
  void start(double off, const std::vector<std::string>& arguments = test::kPanelKnown,
             const std::vector<Trouble>& troubles = {},
             const CameraInfo& calibration = test::panelCamera()) {
    const std::string file = folder_.path("images.bag");
    writeBag(file, troubles, calibration);
    ros::param::del("/marker_localizer");
    std::vector<std::string> all = arguments;
    all.push_back("--layout=" + folder_.write("three.yaml", layoutWith(off)));
    node_ = std::make_unique<test::Process>("marker_localizer", all);
    player_ = std::make_unique<test::BagPlayer>(nh_, file);
    ASSERT_TRUE(waitFor([&] {
      return player_->isHeard() && pictures_.connected() && poses_.connected() &&
             diagnostics_.connected();
    })) << node_->output();
    tell(kFirstImage);
  }
  // The node has the clock when it diagnoses for the second time: the first may be older.
  void tell(const ros::Time& time) {
    player_->tell(time);
    const std::size_t seen = diagnostics_.count();
    ASSERT_TRUE(waitFor([&] { return diagnostics_.count() > seen + 1; })) << node_->output();
  }
  void rewind() {
    player_->rewind();
    passed_ = pictures_.count();
    tell(kFirstImage);
  }
  // Until after an image and its trouble. The clock goes on when each image before was looked at.
  bool playPast(int image) {
    return player_->play(stampOfImage(image) + kAfterImage * 2.0, [this](const ros::Time& now) {
      return pictures_.count() - passed_ >= imagesBefore(now);
    });
  }
  static std::size_t imagesBefore(const ros::Time& now) {
    std::size_t count = 0;
    while (count < kImages && stampOfImage(static_cast<int>(count)) + kAfterImage * 0.5 < now)
      ++count;
    return count;
  }

  std::string said(const std::string& key) const {
    const auto all = diagnostics_.all();
    for (auto array = all.rbegin(); array != all.rend(); ++array)
      for (const auto& status : array->status)
        for (const auto& value : status.values)
          if (value.key == key) return value.value;
    return "";
  }
  std::string summary() const {
    const auto all = diagnostics_.all();
    for (auto array = all.rbegin(); array != all.rend(); ++array)
      for (const auto& status : array->status)
        if (contains(status.name, "markers")) return status.message;
    return "";
  }
  // Of all images: they were looked at, none is refused, and none gave a pose.
  void expectOffAndNoPose() {
    ASSERT_TRUE(playPast(kImages));
    EXPECT_TRUE(waitFor([&] {
      return contains(summary(), "calibration or layout is off: 3 markers lie ");
    })) << summary();
    EXPECT_TRUE(waitFor([&] { return said("images") == std::to_string(kImages); }));
    EXPECT_EQ(said("images refused"), "0");
    EXPECT_EQ(poses_.count(), 0u);
  }
  // Of the poses from `first` on: those of all images, each with its stamp.
  void expectAllPosesFrom(std::size_t first) {
    ASSERT_TRUE(waitFor([&] { return poses_.count() >= first + kImages; }))
        << poses_.count() - first;
    const auto all = poses_.all();
    ASSERT_EQ(all.size(), first + kImages);
    for (int image = 0; image < kImages; ++image) {
      const PoseWithCovarianceStamped& pose = all[first + static_cast<std::size_t>(image)];
      EXPECT_EQ(pose.header.stamp, stampOfImage(image));
      EXPECT_LT(test::distanceBetween(test::poseOf(pose.pose.pose), mapFromBaseAt(image)), 0.02);
    }
  }

  ros::NodeHandle nh_;
  Latest<PoseWithCovarianceStamped> poses_{nh_, "marker_pose"};
  Latest<Image> pictures_{nh_, "marker_image"};
  Latest<diagnostic_msgs::DiagnosticArray> diagnostics_{nh_, "/diagnostics"};
  const test::TemporaryFolder folder_;
  std::size_t passed_ = 0;  // pictures before this pass over the bag
  std::unique_ptr<test::Process> node_;
  std::unique_ptr<test::BagPlayer> player_;
};

// rl#333, fuse#260: after a bag that is played again, everything was "older than the one before".
TEST_F(MarkerLocalizerBagTest, EachTroubleIsToldAndTimeThatGoesBackBeginsAnew) {
  const std::vector<Trouble> troubles = allTroubles();
  start(0.0, test::kPanelKnown, troubles);
  for (const Trouble& trouble : troubles) {
    ASSERT_TRUE(playPast(trouble.after)) << trouble.sentence;
    const std::string key = trouble.input + " refused last because";
    EXPECT_TRUE(waitFor([&] { return contains(said(key), trouble.sentence); }))
        << trouble.sentence << ": " << said(key);
  }
  ASSERT_TRUE(playPast(kImages));
  expectAllPosesFrom(0);
  EXPECT_TRUE(waitFor([&] { return said("images") == std::to_string(kImages + 6); }));
  EXPECT_EQ(said("images refused"), "6");
  EXPECT_EQ(said("camera_info refused"), "2");
  rewind();
  EXPECT_TRUE(node_->says("ROS time went back by"));
  ASSERT_TRUE(playPast(kImages));
  expectAllPosesFrom(kImages);
}

TEST_F(MarkerLocalizerBagTest, ALayoutThatIsOffByMoreThanTwoPixelsIsNamedAndGivesNoPose) {
  start(0.08);
  expectOffAndNoPose();
  EXPECT_TRUE(contains(summary(), "without marker 2 ")) << summary();
}

// Of a lens that is wider than it is high: no marker is to blame.
TEST_F(MarkerLocalizerBagTest, ACalibrationThatIsOffByMoreThanTwoPixelsIsNamedAndGivesNoPose) {
  CameraInfo wide = test::panelCamera();
  wide.K[0] *= 1.4;
  start(0.0, test::kPanelKnown, {}, wide);
  expectOffAndNoPose();
}

TEST_F(MarkerLocalizerBagTest, WhatWasSeenBeforeTimeWentBackTeachesNothing) {
  start(0.0, {"_learn_images:=6", "_learn_distance:=1"});
  std_srvs::Trigger learn;
  const auto answer = [&] {
    return ros::service::call("marker_localizer/learn_panel", learn) ? learn.response.message : "";
  };
  ASSERT_TRUE(playPast(4));
  EXPECT_TRUE(waitFor([&] { return contains(answer(), "so far there are 5"); })) << answer();
  rewind();
  ASSERT_TRUE(playPast(1));
  EXPECT_TRUE(waitFor([&] { return contains(answer(), "so far there are 2"); })) << answer();
}

}  // namespace
}  // namespace grid_path_planner::nodes
