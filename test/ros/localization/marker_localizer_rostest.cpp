// marker_localizer before the panel of two_markers.yaml, whose images are drawn here.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>

#include "ros/support/latest.h"
#include "ros/support/panel_image.h"
#include "ros/support/panel_site.h"
#include "ros/support/process.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using Eigen::Isometry3d, Eigen::Vector3d;
using geometry_msgs::PoseWithCovarianceStamped;
using sensor_msgs::CameraInfo;
using sensor_msgs::Image;
using test::angleBetween;
using test::baseFromCamera;
using test::contains;
using test::distanceBetween;
using test::kPanelKnown;
using test::Latest;
using test::mapFromBase;
using test::mapFromPanel;
using test::panelCamera;
using test::panelImage;
using test::poseOf;
using test::Process;
using test::stampedTransform;
using test::waitFor;

constexpr char kLayout[] = GPP_TEST_DATA "/two_markers.yaml";

// Before the left tag, 3 m away and 35 degrees aside: alone, and by a lens of long focal length, it looks alike from
// the other side.
constexpr double kLongFocal = 400.0;  // pixels
Isometry3d mapFromBaseAside() {
  const Vector3d tag(-0.2, 0.0, 0.0), camera(1.52, 0.05, 2.46), ahead = (tag - camera).normalized();
  const Vector3d right = ahead.cross(Vector3d::UnitY()).normalized();
  Isometry3d panel_from_camera(Eigen::Translation3d{camera});
  panel_from_camera.linear() << right, ahead.cross(right), ahead;
  return mapFromPanel() * panel_from_camera * baseFromCamera().inverse();
}

Image imageFrom(const Isometry3d& map_from_base, double focal = test::kPanelFocal) {
  return panelImage(mapFromPanel().inverse() * map_from_base * baseFromCamera(), {}, focal);
}

// tf of camera and vehicle, 50 times a second.
class Frames {
 public:
  ~Frames() {
    over_ = true;
    thread_.join();
  }
  // Where the vehicle is in the map; nothing: tf does not know.
  void say(const std::optional<Isometry3d>& vehicle) {
    const std::lock_guard<std::mutex> lock(mutex_);
    vehicle_ = vehicle;
  }

 private:
  void run() {
    while (!over_) {
      broadcaster_.sendTransform(
          stampedTransform("base_link", "camera", baseFromCamera(), ros::Time::now()));
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (vehicle_)
          broadcaster_.sendTransform(
              stampedTransform("map", "base_link", *vehicle_, ros::Time::now()));
      }
      ros::WallDuration(0.02).sleep();
    }
  }
  tf2_ros::TransformBroadcaster broadcaster_;
  std::mutex mutex_;
  std::optional<Isometry3d> vehicle_;
  std::atomic<bool> over_{false};
  std::thread thread_{[this] { run(); }};
};

class MarkerLocalizerTest : public testing::Test {
 protected:
  void start(std::vector<std::string> arguments = kPanelKnown, const std::string& layout = kLayout,
             const CameraInfo& info = panelCamera()) {
    ros::param::del("/marker_localizer");
    arguments.push_back("--layout=" + layout);
    node_ = std::make_unique<Process>("marker_localizer", arguments);
    ASSERT_TRUE(waitFor([&] {
      return images_.getNumSubscribers() > 0 && infos_.getNumSubscribers() > 0 &&
             poses_.connected() && ros::service::exists("marker_localizer/learn_panel", false);
    })) << node_->output();
    sendInfo(info);
  }
  void sendInfo(const CameraInfo& info) { infos_.publish(info); }
  Image image() const {
    Image image = picture_;
    image.header.stamp = ros::Time::now();
    return image;
  }
  // Sends images until one gives a pose.
  std::optional<PoseWithCovarianceStamped> pose() {
    const std::size_t seen = poses_.count();
    waitFor([&] {
      images_.publish(image());
      ros::WallDuration(0.05).sleep();
      return poses_.count() > seen;
    });
    return poses_.waitForMoreThan(seen);
  }
  // Sends it until the node says so, then something right, which is answered.
  void expectRefused(const std::function<Image()>& wrong, const std::string& sentence) {
    EXPECT_TRUE(waitFor([&] {
      images_.publish(wrong());
      ros::WallDuration(0.02).sleep();
      return isDiagnosed(sentence);
    })) << sentence
        << "\n"
        << node_->output();
    sendInfo(panelCamera());
    EXPECT_TRUE(pose()) << "after: " << sentence;
  }
  bool isDiagnosed(const std::string& sentence) const {
    const auto all = diagnostics_.all();
    for (auto array = all.rbegin(); array != all.rend() && array != all.rbegin() + 3; ++array)
      for (const auto& status : array->status)
        for (const auto& value : status.values)
          if (contains(value.value, sentence) || contains(status.message, sentence)) return true;
    return false;
  }

  ros::NodeHandle nh_;
  ros::Publisher images_ = nh_.advertise<Image>("camera/image_raw", 10);
  ros::Publisher infos_ = nh_.advertise<CameraInfo>("camera/camera_info", 10, true);
  Latest<PoseWithCovarianceStamped> poses_{nh_, "marker_pose"};
  Latest<diagnostic_msgs::DiagnosticArray> diagnostics_{nh_, "/diagnostics"};
  Frames frames_;
  Image picture_ = imageFrom(mapFromBase());
  std::unique_ptr<Process> node_;
};

TEST_F(MarkerLocalizerTest, SaysWhereTheVehicleIsWithTheImagesStamp) {
  Latest<PoseWithCovarianceStamped> panels(nh_, "panel_pose");
  Latest<visualization_msgs::MarkerArray> markers(nh_, "panel_markers");
  Latest<Image> pictures(nh_, "marker_image");
  start();  // and nothing in tf: two tags tell without a prediction
  const auto fix = pose();
  ASSERT_TRUE(fix) << node_->output();
  EXPECT_EQ(fix->header.frame_id, "map");
  EXPECT_LE(fix->header.stamp, ros::Time::now());
  EXPECT_LT(distanceBetween(poseOf(fix->pose.pose), mapFromBase()), 0.02);
  EXPECT_LT(angleBetween(poseOf(fix->pose.pose), mapFromBase()), 0.02);
  EXPECT_GT(fix->pose.covariance[0], 0.0);
  EXPECT_LT(fix->pose.covariance[0], 0.01);
  const auto panel = panels.waitForMoreThan(0);
  ASSERT_TRUE(panel);
  EXPECT_LT(distanceBetween(poseOf(panel->pose.pose), mapFromPanel()), 1e-5);
  ASSERT_TRUE(waitFor([&] {
    images_.publish(image());
    return markers.count() > 0 && pictures.count() > 0;
  }));
  EXPECT_EQ(markers.all()[0].markers.size(), 2u);
  EXPECT_EQ(pictures.all()[0].data.size(), 3 * picture_.data.size());
}

// apriltag#71: taken by the better fit, the vehicle is now here and now on the other side.
TEST_F(MarkerLocalizerTest, OneMarkerAloneIsWhereThePredictionHasIt) {
  const test::TemporaryFolder folder;
  picture_ = imageFrom(mapFromBaseAside(), kLongFocal);
  start(kPanelKnown,
        folder.write("one.yaml",
                     "family: 36h11\ntag_size: 0.2\nplate_size: 0.25\nmarkers:\n"
                     "  - {id: 0, position: [-0.2, 0, 0], rpy: [0, 0, 0]}\n"),
        panelCamera(kLongFocal));
  ASSERT_TRUE(waitFor([&] {
    images_.publish(image());
    ros::WallDuration(0.05).sleep();
    return isDiagnosed("the corners admit two poses, and there is no prediction");
  })) << node_->output();
  EXPECT_EQ(poses_.count(), 0u);
  frames_.say(mapFromBaseAside());
  const auto fix = pose();
  ASSERT_TRUE(fix) << node_->output();
  EXPECT_LT(angleBetween(poseOf(fix->pose.pose), mapFromBaseAside()), 0.1);
}

TEST_F(MarkerLocalizerTest, ThePanelIsLearntStandingStillAndThenFixed) {
  Latest<PoseWithCovarianceStamped> panels(nh_, "panel_pose");
  frames_.say(mapFromBase());
  start({"_learn_images:=4"});
  std_srvs::Trigger learn;
  ASSERT_TRUE(ros::service::call("marker_localizer/learn_panel", learn));
  EXPECT_FALSE(learn.response.success);
  EXPECT_TRUE(contains(learn.response.message, "so far there are")) << learn.response.message;
  ASSERT_TRUE(waitFor([&] {
    images_.publish(image());
    ros::WallDuration(0.05).sleep();
    return ros::service::call("marker_localizer/learn_panel", learn) && learn.response.success;
  })) << learn.response.message;
  const auto panel = panels.waitForMoreThan(0);
  ASSERT_TRUE(panel);
  EXPECT_LT(distanceBetween(poseOf(panel->pose.pose), mapFromPanel()), 0.03);
  EXPECT_GT(panel->pose.covariance[0], 0.0);
  // From now on the vehicle is where the panel has it, whatever tf says.
  frames_.say(Eigen::Translation3d(1.0, 0.0, 0.0) * mapFromBase());
  const auto fix = pose();
  ASSERT_TRUE(fix);
  EXPECT_LT(distanceBetween(poseOf(fix->pose.pose), mapFromBase()), 0.03);
  ASSERT_TRUE(ros::service::call("marker_localizer/learn_panel", learn));
  EXPECT_FALSE(learn.response.success);
  EXPECT_TRUE(contains(learn.response.message, "known already"));
  EXPECT_EQ(panels.count(), 1u);
}

TEST_F(MarkerLocalizerTest, ImagesThatCannotBeUsedAreRefusedAndNothingIsLost) {
  start();
  ASSERT_TRUE(pose()) << node_->output();
  const auto refuses = [&](const std::string& sentence, const std::function<void(Image&)>& spoil) {
    expectRefused(
        [&] {
          Image wrong = image();
          spoil(wrong);
          return wrong;
        },
        sentence);
  };
  refuses("it has no stamp", [](Image& i) { i.header.stamp = {}; });
  refuses("s ahead of ROS time", [](Image& i) { i.header.stamp = ros::Time(4294967295u, 0); });
  refuses("s old", [](Image& i) { i.header.stamp = ros::Time(1, 0); });
  const Image old = image();
  refuses("it is not newer than the one before",
          [&](Image& i) { i.header.stamp = old.header.stamp; });
  refuses("it has 0 x 0 pixels", [](Image& i) {
    i.width = i.height = i.step = 0;
    i.data.clear();
  });
  refuses("more than 8192", [](Image& i) { i.width = i.height = i.step = 4294967295u; });
  refuses("its rows take", [](Image& i) { i.step *= 2; });
  refuses("its encoding must be", [](Image& i) { i.encoding = "32FC1"; });
  refuses("the calibration 240 x 160", [](Image& i) {
    i.height /= 2;
    i.data.resize(i.data.size() / 2);
  });
  refuses("'nowhere'", [](Image& i) { i.header.frame_id = "nowhere"; });
  CameraInfo other = panelCamera(1.5 * test::kPanelFocal);  // 0.9 m off, and no residual showed it
  other.header.frame_id = "other_camera";
  sendInfo(other);
  refuses("that of the camera_info 'other_camera'", [](Image&) {});
}

// The pose of tf came back as that of the panel, 3 m off as tf was, known to a centimetre.
TEST_F(MarkerLocalizerTest, ACameraThatTfHasInTheMapConfirmsNothing) {
  tf2_ros::StaticTransformBroadcaster fixed;
  const ros::Time now = ros::Time::now();
  fixed.sendTransform(std::vector<geometry_msgs::TransformStamped>{
      stampedTransform("map", "fixed_camera", mapFromBase() * baseFromCamera(), now),
      stampedTransform("earth", "map", Isometry3d::Identity(), now),
      stampedTransform("earth", "ship_camera", mapFromBase() * baseFromCamera(), now)});
  frames_.say(Eigen::Translation3d(3.0, 0.0, 0.0) * mapFromBase());
  start();
  for (const std::string frame : {"fixed_camera", "ship_camera"})
    expectRefused(
        [&] {
          Image wrong = image();
          wrong.header.frame_id = frame;
          return wrong;
        },
        "tf has '" + frame + "' by map, not on the vehicle");
}

TEST_F(MarkerLocalizerTest, ACalibrationThatIsNoneIsRefusedAndTheOneBeforeStays) {
  start();
  ASSERT_TRUE(pose()) << node_->output();
  CameraInfo zero;
  CameraInfo nan = panelCamera();
  nan.K[0] = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [wrong, sentence] :
       {std::pair(zero, "0 x 0 pixels"), std::pair(nan, "not calibrated")}) {
    sendInfo(wrong);
    EXPECT_TRUE(waitFor([&, text = std::string(sentence)] { return isDiagnosed(text); }));
    EXPECT_TRUE(pose()) << sentence;
  }
}

TEST_F(MarkerLocalizerTest, WithoutACalibrationItSaysWhatItWaitsFor) {
  infos_.shutdown();
  ros::param::del("/marker_localizer");
  auto arguments = kPanelKnown;
  arguments.push_back(std::string("--layout=") + kLayout);
  node_ = std::make_unique<Process>("marker_localizer", arguments);
  EXPECT_TRUE(waitFor([&] {
    images_.publish(image());
    ros::WallDuration(0.05).sleep();
    return isDiagnosed("no camera_info that can be used has come yet");
  }));
}

TEST_F(MarkerLocalizerTest, ALayoutThatIsNoneEndsItBeforeItStarts) {
  const test::TemporaryFolder folder;
  const auto exitOf = [&](const std::string& markers) {
    const std::string file = folder.write(
        "bad.yaml", "family: 36h11\ntag_size: 0.2\nplate_size: 0.25\nmarkers:\n" + markers);
    Process node("marker_localizer", {"__name:=refused", "--layout=" + file});
    EXPECT_TRUE(node.waitForExit());
    EXPECT_EQ(node.exitCode(), 1);
    return node.output();
  };
  const std::string marker = "  - {id: 0, position: [0, 0, 0], rpy: [0, 0, 0]}\n";
  EXPECT_TRUE(contains(exitOf(marker + marker), "bad.yaml:6: there are two markers 0"));
  EXPECT_TRUE(contains(exitOf("  - {id: 0, position: [.nan, 0, 0], rpy: [0, 0, 0]}\n"),
                       "bad.yaml:5: position must be"));
  Process none("marker_localizer", {"__name:=refused"});
  ASSERT_TRUE(none.waitForExit());
  EXPECT_TRUE(none.says("layout must name the file"));
}

}  // namespace
}  // namespace grid_path_planner::nodes
