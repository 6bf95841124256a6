"""What the examples in the headers' essays use and do not declare: C++ declarations, by the end of the
header's name. They stand in the header's namespace; a line with #include goes to the top."""

# For all of them: a token that nobody cancels, and something to do with a result.
COMMON = "extern const StopToken stop; template <class... T> void use(const T&...);"

CONTEXT = {
    "background.h": "struct Table { Table(int, const StopToken&); }; extern std::shared_ptr<int> map;",
    "action_link.h": "#include \"grid_path_planner/PlanPathAction.h\"\nextern ros::NodeHandle nh; extern const PlanPathGoal goal;",
    "service_calls.h": "#include \"grid_path_planner/ComparePlans.h\"\nextern ros::NodeHandle nh; extern ComparePlans question;"
                       "void show(const ComparePlans::Response&); void complain(const std::string&);",
    "panel_model.h": "extern path::Pose goal; extern double now; extern unsigned id; extern PlanAnswer answer;",
    "route_planning.h": "extern RoutePlanning planning; extern RoutePoints points; extern double now; extern unsigned id;"
                        "extern PlanAnswer answer; extern bool best_order;",
    "route_points.h": "extern path::Pose goal; template <class... T> void plan(const T&...);",
    "footprint_clearance.h": "extern const grid::OccupancyGrid map; extern const ClearanceLimits limits; void halt(const Eigen::Vector2d&);"
                             "extern const vehicle::Footprint footprint; extern const std::vector<Eigen::Vector3d> ahead;",
    "dubins.h": "extern const Eigen::Vector2d from, to; extern const double direction, radius; void add(const Eigen::Vector2d&);",
    "footprint.h": "void search(double radius);", "joystick_loop.h": "extern ros::NodeHandle nh; extern TeleopJoyOptions options;",
    "motions.h": "extern const Path path; extern const Pose start, goal; void check(const vehicle::Motion&);",
    "motion_model.h": "extern const Description vehicle; extern const Eigen::Vector2d position; extern const double yaw;"
                      "extern const base::BodyVelocity command;",
    "commanded_velocity.h": "extern const Description vehicle; extern const double now; extern const base::BodyVelocity command;"
                            "void predict(const base::BodyVelocity&, const std::vector<TimedCommand>&);",
    "motion_check.h": "extern const Description vehicle; extern const grid::GridGeometry geometry; extern const FootprintObstacles obstacles;"
                      "extern const PlanarState state; extern const CommandedVelocity commanded; extern const double period;"
                      "extern base::BodyVelocity command; void slow(base::BodyVelocity&);",
    "motion_gate.h": "extern const vehicle::Description* const vehicle; extern const double now, rate, age; extern following::FollowInput input;"
                     "extern const path::Pose pose_in_map; extern const grid::OccupancyGrid map; extern const following::ClearanceLimits limits;"
                     "extern const base::BodyVelocity velocity;",
    "vehicle_options.h": "extern PlannerOptions options; using vehicle::readDescription;",
    "contradiction.h": "extern Contradiction contradiction; extern const Stamp stamp, now; void warn();",
    "gravity_check.h": "extern GravityCheck check; extern const Stamp stamp; extern const ImuMeasurement imu;"
                       "extern const Eigen::Quaterniond base; void warn(const std::string&);",
    "pose_doubt.h": "extern const FilterSnapshot snapshot; extern const Stamp now; extern const LocalizerOptions options; void say(const std::string&);",
    "localization_gate.h": "extern const double now; extern const DegradedDriving options; void hold(const std::string&);",
    "hold_reasons.h": "extern HoldReasons reasons; extern const NavigatePathOptions options; extern const std::string stop_topic;"
                      "void hold(const std::string&);",
    "start_escape.h": "extern const costmap::CostGrid costs; extern const costmap::KeptDistances kept; extern const Eigen::Vector2d start;"
                      "extern const double start_escape_radius; extern const grid::Cell cell; void take(grid::Cell);",
    "sweep.h": "extern const Footprint footprint; extern const grid::GridGeometry geometry; extern const Motion motion;"
               "extern const FootprintObstacles obstacles; void report(grid::Cell, const Eigen::Vector2d&, double yaw);",
    "fitted_plan.h": "extern const vehicle::Footprint footprint; extern const costmap::CostGrid costs; extern std::size_t memory;"
                     "extern const FittedPlanner::Inflate inflate; extern const PlannerOptions options;"
                     "extern MultiResolutionPlanner search; extern const PoseRequest request;",
    "footprint_check.h": "extern const vehicle::Footprint footprint; extern const costmap::CostGrid costs;"
                         "extern const PlannerOptions options; extern const path::Pose start, goal; extern const path::Path path;",
    "try_costs.h": "extern const costmap::CostGrid costs; extern const Eigen::Vector2d start; extern const Eigen::Vector2d* goal;"
                   "extern std::shared_ptr<const costmap::CostGrid> inflated_by_the_circumscribed_radius; extern bool fails;"
                   "extern const path::Path path; extern const std::vector<vehicle::FootprintContact> contacts;"
                   "extern const double radius; void plan(const costmap::CostGrid&);",
    "curved_path.h": "extern const path::Path path; extern const double start_yaw, goal_yaw, radius; void drive(const path::Path&);"
                     "bool legal(const std::vector<Eigen::Vector2d>&);",
    "cholesky.h": "extern const Eigen::Matrix<double, 6, 6> covariance; extern const Eigen::Matrix<double, 6, 1> error, right;",
    "shown_text.h": "extern std::string message;",
    "guarded_queue.h": "extern ros::NodeHandle nh;", "guarded_timer.h": "extern ros::NodeHandle nh; void checkTime();", "straight_runs.h": "extern const std::vector<Eigen::Vector2d> points;", "occupied_cells.h": "extern const grid::OccupancyGrid map; extern const grid::OccupancyThresholds thresholds; extern const Eigen::Vector2d point;", "clearance_meter.h": "extern std::shared_ptr<const grid::OccupancyGrid> map; extern const grid::OccupancyThresholds thresholds; extern const Path path;", "huge_pages.h": "#include <vector>\nextern std::vector<char> cells; extern const std::size_t count;",
    "log_throttle.h": "#include <ros/console.h>\n", "octree_topic.h": "#include <ros/node_handle.h>\n#include <sensor_msgs/PointCloud2.h>\nextern ros::NodeHandle nh; extern const mapping::MapModel map; extern ros::SubscriberStatusCallback connected; sensor_msgs::PointCloud2 centresOf(const mapping::MapModel&);",
    "master_watch.h": "void halt();", "turning_points.h": "extern std::vector<Cell> cells; extern const CostGrid& map;",
    "map_data.h": "#include <map_msgs/OccupancyGridUpdate.h>\n#include <nav_msgs/OccupancyGrid.h>\n"
                  "extern nav_msgs::OccupancyGrid map; extern map_msgs::OccupancyGridUpdate beat; extern double driven; void hold(const std::string&);",
    "map_order.h": "#include <nav_msgs/OccupancyGrid.h>\nextern MapOrder order; extern std::string publisher; extern RecentUpdates::Update update; "
                   "extern nav_msgs::OccupancyGrid map; extern MapOrder::Clock::time_point asked_at; void askForAWholeMap(); void take(const nav_msgs::OccupancyGrid&);",
    "update_sequence.h": "#include <map_msgs/OccupancyGridUpdate.h>\n#include <ros/message_event.h>\nextern UpdateSequence sequence;"
                         "extern ros::MessageEvent<map_msgs::OccupancyGridUpdate const> event;"
                         "extern map_msgs::OccupancyGridUpdate message; void askForAWholeMap();",
    "drive_loop.h": "extern ros::NodeHandle nh; extern NavigatePathOptions options; extern FrameTransforms transforms;"
                    "extern Path path; void queue(std::function<void()>); void takeReports();",
    "navigator.h": "extern NavigatorOptions options; extern double now; extern path::Path path;"
                   "void carryOut(const NavigatorOrder&);",
    "driven_track.h": "extern path::Pose pose;", "control_thread.h": "#include <ros/node_handle.h>\nextern ros::NodeHandle nh; void tick();"
                     "struct Zero {}; void publish(Zero);",
    "action_caller.h": """#include "grid_path_planner/PlanPathAction.h"
        extern ros::NodeHandle nh; extern const PlanPathGoal goal; extern double timeout;
        void on_result(const PlanPathResult&); void on_feedback(const PlanPathFeedback&);
        void on_lost(const std::string&);""",
    "goals_of_status.h": "extern const actionlib_msgs::GoalStatusArray status; extern const std::string id; void waitForResult();",
    "velocity_message.h": "extern const nav_msgs::Odometry odometry;",
    "go_to_messages.h": "#include <move_base_msgs/MoveBaseGoal.h>\nextern const move_base_msgs::MoveBaseGoal goal;"
                        "extern following::Navigator navigator; extern double now; extern const PlanPathResult plan;"
                        "extern const NavigatePathFeedback feedback; extern const NavigatePathResult result;",
    "kept_file.h": "extern const std::string folder; extern ros::NodeHandle private_nh;",
    "kept_heading.h": "#include \"localization/vehicle_localizer.h\"\nextern const std::string folder; extern ros::NodeHandle private_nh;"
                      "extern localization::VehicleLocalizer localizer; extern const localization::KnownHeading known;",
    "kept_map.h": "#include \"grid_path_planner/mapping/octree_map.h\"\nextern const mapping::OctreeMap octree; extern ros::Time newest_cloud;",
    "request_messages.h": "extern const PlanPathGoal goal; extern const ComparePlans::Request comparison; void ask(const PlanningRequest&);",
    "request_poses.h": "extern const PlanningRequest request; extern const PathPlannerNodeOptions options; extern const FrameLookup transforms;",
    "json_numbers.h": "struct Run { int seed; }; extern Run run; extern const nlohmann::json object;",
    "map_monitor.h": "extern ros::NodeHandle nh;",
    "publisher_watch.h": "extern std::string name_of_publisher; void heard(const std::string& node);", "direct_publisher.h": "#include <geometry_msgs/Twist.h>\nextern ros::NodeHandle nh; extern geometry_msgs::Twist twist;",
    "map_autosave.h": "extern std::string folder; extern ros::NodeHandle private_nh; extern ProjectedMapOptions options;"
                      "extern ros::Time newest_cloud;",
    "path_clearance_check.h": "extern const OccupancyGrid& map; extern std::vector<Eigen::Vector3d> ahead; void halt(const Eigen::Vector2d&);",
    "extent.h": "extern double x, y; extern CellRect cells; extern std::vector<BrickColumn> changed;"
                "extern const OccupancyBricks& bricks; extern ProjectionOptions options;",
    "end_segments.h": "extern const CostGrid& costs; extern Eigen::Vector2d pose, centre;",
    "paid_landmarks.h": "extern SearchResult result; extern const std::shared_ptr<const CostGrid> before, shared_map; extern std::size_t room; extern std::vector<CellRect> changed; extern std::uint32_t goal_index;",
    "bit_maps.h": "extern const CostGrid& map;", "map_differences.h": "extern const OccupancyGrid before, after;",
    "class_changes.h": """#include "grid_path_planner/costmap/cost_grid.h"
        extern const OccupancyGrid map; extern OccupancyThresholds thresholds; extern const CostGrid& costs;
        extern std::vector<CellRect> changed;""",
    "bucket_queue.h": "extern SearchKey f, f_of_the_start; extern unsigned width_shift;extern BucketQueue::Index index;",
    "natural_moves.h": "extern Window window; extern unsigned d;",
    "cloud_filter.h": """#include "grid_path_planner/mapping/octree_map.h"
        extern OctreeMap map; extern Eigen::Isometry3d map_from_sensor, base_from_map;
        extern std::vector<Eigen::Vector3d> points; extern CloudFilterOptions options;""",
    "cloud_reader.h": "extern sensor_msgs::PointCloud2::ConstPtr message;",
    "read_limits.h": "extern ReadOptions options; extern StopToken stop_token; extern std::string file;"
                     "extern std::size_t cells; extern int row, height; void readRow(int);",
    "child_process.h": "extern std::string file; extern ReadLimits limits;",
    "drawn_shapes.h": "extern OccupancyGrid map; extern double resolution; extern std::string file;extern ReadLimits limits;",
    "action_stamps.h": "#include <actionlib_msgs/GoalID.h>\nextern actionlib_msgs::GoalID goal_id;",
    "shutdown_flag.h": """#include "grid_path_planner/simulation/world.h"
        extern std::string file; extern ReadOptions read_options;""",
    "bounded_subscription.h": """#include <map_msgs/OccupancyGridUpdate.h>
        extern ros::NodeHandle nh; extern ros::Subscriber updates;""",
    "claimed_lengths.h": """#include <nav_msgs/OccupancyGrid.h>
        #include <nav_msgs/Path.h>
        extern std::uint8_t* bytes; extern std::uint32_t length; extern ros::NodeHandle nh;
        extern ros::Subscriber subscriber; void onPath(const nav_msgs::Path&);""",
    "advertised_service.h": "#include \"grid_path_planner/SaveFile.h\"\nextern ros::ServiceServer service; extern ros::NodeHandle private_nh; bool saveMap(SaveFile::Request&, SaveFile::Response&);",
    "service_caller.h": """#include <ros/service_server.h>
        #include <nav_msgs/GetPlan.h>
        extern ros::ServiceServer service; bool answered(); void waitAWhile();
        extern ros::ServiceEvent<nav_msgs::GetPlan::Request, nav_msgs::GetPlan::Response> event;""",
    "cost_planner.h": """struct ACostmap { const Cost* getCharMap() const; };
        extern CostPlannerOptions options; extern GridGeometry geometry; extern ACostmap costmap;
        extern double inscribed_radius, tolerance; extern Pose start, goal; extern StopSource source;""",
    "plan_on_costs.h": """extern double timeout; extern PoseRequest request; extern StopSource source; extern CostmapPair costmaps;
        extern MultiResolutionPlanner search; extern CostGrid costs; extern PlannerOptions options;""",
    "planner_adapter.h": """extern geometry_msgs::PoseStamped start, goal; extern GridGeometry geometry;
        extern const planning::Cost* cells; extern double inscribed_radius;""",
    "prepared_planners.h": """extern planners::SearchOptions options; extern std::size_t bytes;
        extern std::size_t bytes_of_current; extern CostmapPair maps;""",
    "planning_lane.h": """#include "planning/map_store.h"
        extern MapReceiver maps; extern std::shared_ptr<planning::MapStore> store; extern FrameTransforms transforms;
        extern PlanningRequest request; extern PathPlannerNodeOptions options; void use(const Plan&);""",
    "avoidance/pilot.h": """extern PilotOptions options; extern VehiclePose pose; extern double time;
        extern base::BodyVelocity velocity; extern Frame frame; struct AVehicle { void command(const base::BodyVelocity&); };
        extern AVehicle vehicle;""",
    "cloud_frames.h": """extern ros::NodeHandle nh; extern FrameTransforms transforms; extern LocalPlannerOptions options;
        using avoidance::Frame; void use(const Frame&); void stand(const std::string&);""",
    "flight_action.h": """extern ros::NodeHandle nh; extern NodeFiles files; extern avoidance::PilotAnswer answer;
        extern avoidance::VehiclePose pose; path::Path fly(const path::Path&, bool); void cancel(const std::string&);
        path::Path read(const nav_msgs::Path&);""",
    "logged_pilot.h": """#include <ros/console.h>
        using avoidance::PilotAnswer, avoidance::PilotInput;
        extern avoidance::PilotOptions options; extern PilotInput input; extern base::OutputFile file;""",
    "map_planner.h": """#include "grid_path_planner/avoidance/pilot.h"
        extern avoidance::Frame frame; extern avoidance::PilotOptions options; extern avoidance::Pilot pilot;""",
    "image_camera.h": """extern const World world; extern ImageCameraOptions options; extern Eigen::Isometry3d map_from_base;
        extern std::uint64_t frame_number; extern int row, column;""",
    "camera_calibration.h": "extern CameraCalibration calibration; extern Eigen::Vector2d corner;",
    "marker_pose.h": """extern GreyImage image; extern CameraCalibration calibration; extern MarkerPoseOptions options;
        extern std::optional<PoseEstimate> prediction; void tell(const std::string&);""",
    "pose_refinement.h": "extern MarkerViews views; extern CameraCalibration calibration; extern Eigen::Isometry3d start;",
    "localization/so3.h": "extern Eigen::Quaterniond attitude; extern Eigen::Vector3d rotation_vector;",
    "localization/state.h": "extern Estimate estimate; extern ErrorVector error; extern State truth;",
    "imu_propagation.h": """extern Estimate estimate; extern Eigen::Vector3d rate, acceleration; extern double seconds;
        extern ImuNoise noise;""",
    "coasting.h": "extern Estimate estimate; extern double seconds; extern CoastingNoise noise;",
    "localization/measurement.h": """#include "localization/lagged_filter.h"
        extern LaggedFilter filter; extern Stamp stamp; extern Eigen::Vector3d velocity; extern Eigen::Matrix3d covariance;
        extern Mounting dvl_in_body;""",
    "mounted_pose.h": "extern Estimate estimate; extern Mounting base_in_body;",
    "rejections.h": "extern Rejections rejections; extern Stamp stamp; extern Deviation deviation; extern double drift, limit; void reset();",
    "kalman_update.h": """extern Estimate estimate; extern Eigen::Vector3d residual; extern Jacobian<3> jacobian;
        extern Eigen::Matrix3d noise; extern double gate;""",
    "filter_step.h": "extern FilterOptions options; extern FilterSnapshot snapshot; extern Measurement measurement; extern TimedImu* next_imu;",
    "lagged_filter.h": "extern FilterOptions options; extern Measurement measurement; extern Stamp now;",
    "measurement_check.h": "extern Measurement measurement; extern FilterOptions options; extern Stamp now; extern double history;",
    "input_statistics.h": "extern LaggedFilter filter; extern Stamp now; void warn(const char*);",
    "vehicle_localizer.h": """extern LocalizerOptions options; extern Measurement measurement; extern Stamp now;
        void drive(const Estimate&);""",
    "sensor_messages.h": """#include "localization/vehicle_localizer.h"
        extern SensorMessages::Lookup lookup; extern VehicleLocalizerOptions options; extern sensor_msgs::Imu message;
        extern localization::VehicleLocalizer localizer;""",
    "transform_rivals.h": "extern ros::Time stamp; extern std::string child; void beSilent(const std::string&);"
                          "extern const tf2_msgs::TFMessage& message; extern std::string node; extern bool is_static;",
    "shutdown_timeout.h": "bool isAskedToEnd();",
    "latched_message.h": """#include <nav_msgs/OccupancyGrid.h>
        extern ros::Publisher maps; extern nav_msgs::OccupancyGrid message;""",
    "input_rules.h": "struct Options { std::string map_frame; double tf_timeout; }; extern Options options;",
    "input.h": """#include <sensor_msgs/LaserScan.h>
        struct Options { double tf_timeout; }; extern Options options;
        extern ros::NodeHandle nh; extern FrameTransforms transforms; void hold(const std::string&);
        void draw(const sensor_msgs::LaserScan&, const Eigen::Isometry3d& in_map, const Eigen::Isometry3d& on_vehicle);""",
    "input_judge.h": """extern InputJudge::Moment now; extern InputRules rules; extern ros::Time stamp; extern std::string frame;
        extern std::size_t bytes; extern boost::shared_ptr<const void> message; extern InputJudge::Place place;
        void tell(const std::string&);""",
    "speed_limit_receiver.h": """struct Loop { void setSpeedLimits(const SpeedLimits&); };
        extern ros::NodeHandle nh; extern Loop loop;""",
    "scan_messages.h": """#include "ros/input/input.h"
        extern Input<sensor_msgs::LaserScan>::Arrival arrival; extern bool inf_clears;""",
    "speed_limit.h": """extern grid::OccupancyGrid limits; extern FollowerOptions options;
        extern std::vector<Eigen::Vector3d> ahead;""",
    "grid_alignment.h": """#include "grid_path_planner/grid/occupancy.h"
        extern OccupancyGrid source, target; extern CellRect changed; void use(Cell, const CellRect&);
        void visitCells(const CellRect&, const std::function<void(Cell)>&);""",
    "polygon_cover.h": """#include "grid_path_planner/grid/occupancy.h"
        extern std::vector<Eigen::Vector2d> corners; extern OccupancyGrid map;""",
    "changed_cells.h": "extern ChangedCells changed; using grid::CellRect;",
    "layer_stack.h": """extern std::shared_ptr<const grid::OccupancyGrid> static_map; extern grid::Cell cell; using grid::CellRect;
        void publish(const grid::OccupancyGrid&, const CellRect&);""",
    "layered_map.h": """extern MapLayersOptions options; extern std::string file; extern LayeredMap::Map static_map, projected_map;
        extern LayeredMap::Changed changed; extern ScanInMap scan; using grid::CellRect;
        void publish(const grid::OccupancyGrid&, const CellRect&);""",
    "ray_cells.h": """#include "grid_path_planner/grid/occupancy.h"
        extern Eigen::Vector2d from, to; extern grid::OccupancyGrid map; using grid::Cell;""",
    "scan_layer.h": """#include "layers/layer_stack.h"
        extern LayerStack stack; extern ScanInMap scan; extern ScanLayerOptions options; extern ChangedCells changed;
        extern double now;""",
    "speed_limits.h": """using grid::GridAlignment; using grid::OccupancyGrid; extern grid::GridGeometry geometry;
        extern Zones zones; extern OccupancyGrid mask;""",
    "camera_messages.h": "extern sensor_msgs::CameraInfo camera_info; extern sensor_msgs::Image image;",
    "marker_poses.h": """extern MarkerImage image; extern vision::MarkerLayout layout; extern FrameTransforms transforms;
        void publish(const localization::MountedPose&); void tell(const std::string&);""",
    "image_camera_publisher.h": """extern ros::NodeHandle nh; extern simulation::World world;
        extern std::vector<simulation::SensorFault> faults; extern simulation::ImageCameraOptions options;
        extern simulation::Vehicle vehicle; extern std::int64_t time_ns; extern std::string frame; extern ros::Time stamp;""",
    "grey_conversion.h": """#include "vision/grey_image.h"
        extern EncodedImage image;""",
    "panel_learning.h": """extern PanelLearningOptions options; extern double seconds; extern Eigen::Isometry3d map_from_base;
        extern Eigen::Isometry3d base_from_camera; extern PoseEstimate pose;""",
    "seen_map.h": """extern SeenMap map; extern avoidance::Frame frame; extern Eigen::Vector3d position, goal;""",
    "flight_hold.h": "#include \"ros/gate/command_gate.h\"\nextern const CommandGate gate;", "command_gate.h": "extern ros::NodeHandle nh; extern const base::BodyVelocity velocity; extern bool drives;", "manager_shutdown.h": "void stopVehicle();",
    "flight_job.h": "extern std::function<void(std::size_t)> progress;", "flight_commander.h": "extern ros::NodeHandle nh;",
    "flight_log.h": """extern std::string file; extern PilotOptions options; extern std::uint64_t limit;
        extern std::vector<Eigen::Vector3d> waypoints; extern PilotInput input; extern PilotAnswer answer;""",
    "moving_bodies.h": """#include "grid_path_planner/simulation/depth_camera.h"
        #include "grid_path_planner/simulation/vehicle.h"
        extern Vehicle vehicle; extern DepthCamera camera; extern Eigen::Isometry3d pose; extern int frame;
        extern std::vector<float> points;""",
    "open_space.h": """extern OpenSpace space; extern VoxelMemory memory; extern double d_safe; extern HeightBand band;
        extern Eigen::Vector3d point;""",
    "surroundings.h": """extern Surroundings surroundings; extern Frame frame; extern double now; extern PilotOptions options;
        extern Eigen::Vector3d position;""",
    "voxel_memory.h": """extern VoxelMemory memory; extern Eigen::Vector3d sensor_position, point; extern int slot;
        extern std::int32_t milliseconds, before;""",
    "braking.h": """extern Motion motion; extern Eigen::Vector3d velocity; extern double yaw_rate; extern PilotOptions options;
        struct AVehicle { void command(const Eigen::Vector3d&, double); }; extern AVehicle vehicle;
        extern const KeptRoom& room; extern std::vector<Eigen::Vector3f> moving;""",
    "marker_errors.h": "extern const TrialStudy study; extern std::vector<SeenFrame> frames; extern std::size_t set; extern int frame;"
                       "extern Noise noise;",
    "marker_views.h": "extern const TrialStudy study; extern const simulation::World& world;",
    "trials/noise.h": "extern int seed;", "navigation_recording.h": "extern NavigationRecording recording; void use(Stamp, Measurement);",
    "panel_drive.h": """#include "simulation/sensors/imu.h"
        extern const TrialStudy study; extern simulation::Imu imu; extern std::int64_t time_ns;""",
    "pose_errors.h": "extern std::vector<Eigen::Vector3d> positions; extern PoseTrack estimate, truth;",
    "sensor_tape.h": """#include "localization/lagged_filter.h"
        extern const TrialStudy study; extern const simulation::World& world; extern std::size_t set; extern int seed;
        extern const MarkerErrors& errors; bool wants(const TapeEntry&); extern localization::LaggedFilter filter;""",
    **dict.fromkeys(["trial_job.h", "recorded_job.h"], "void progress(std::size_t);"),
    "flights/flight.h": """#include "flights/flight_study.h"
        extern const FlightStudy& study; extern std::size_t variant; extern int seed;""",
    "sight_audit.h": """extern const simulation::World& world; extern simulation::DepthCameraOptions camera_options;
        extern Eigen::Vector3d start, position; extern Eigen::Isometry3d map_from_optical; extern int entered;""",
    "backward_guide.h": "extern BackwardGuide guide; extern const CostGrid& map; extern const SearchRequest& request;"
                        " extern double f, g, share; extern std::uint32_t index;",
    "block_bound.h": "extern const CostGrid& map; extern Cell goal, cell;",
    "planning/explanation.h": "void log(const std::string&); extern PathPlanner planner; extern PoseRequest request;",
    "via_plan.h": "extern PathPlanner planner; extern path::Pose start, goal;",
    "visiting_order.h": "constexpr std::size_t via_points = 5; extern std::size_t from, to; double costBetween(std::size_t, std::size_t);",
    "waypoint_formats.h": "extern Datum datum;",
    "map_store.h": """#include "grid_path_planner/planning/path_planner.h"
        extern PlannerOptions options; extern std::shared_ptr<const OccupancyGrid> map, next;
        extern std::vector<CellRect> changed;""",
    "widest_path.h": """extern const CostGrid& costs; extern costmap::CostmapOptions options; extern costmap::KeptDistances kept; extern Cell start, goal;""",
    "connections.h": "extern std::vector<CellRect> rectangles;",
    "conversions.h": "extern geometry_msgs::PoseStamped message; extern Path path;extern ros::Publisher publisher;",
    "cost_to_go.h": "extern std::shared_ptr<const CostGrid> map; extern Cell cell;",
    "dead_reckoning.h": """#include "grid_path_planner/simulation/vehicle.h"
        extern DeadReckoningOptions options; extern Vehicle vehicle;""",
    "decomposition.h": "extern const CostGrid& map;", "bound_choice.h": "extern const CostGrid& map;",
    "laser_scanner.h": """#include <iostream>
        #include "grid_path_planner/simulation/world.h"
        extern const World& world; extern LaserOptions options; extern Vehicle vehicle;""",
    "depth_camera.h": "extern const World& world; extern DepthCameraOptions options;"
                      "extern Eigen::Isometry3d map_from_base; extern int row, column, frame_number;",
    "depth_camera_publisher.h": """#include "grid_path_planner/simulation/vehicle.h"
        extern ros::NodeHandle nh; extern const World& world; extern DepthCameraOptions options;
        extern CameraFrameNames frames; extern Vehicle vehicle; extern std::int64_t time_ns;
        extern ros::Time stamp;""",
    "repair_search.h": "extern const CostGrid& map; extern const BackwardNodes& nodes;"
                       "extern BackwardNodes::Index start; extern SearchKey consistent_below;"
                       "extern SearchResult result; extern StopPoll poll; extern std::uint64_t most;",
    "file_folder.h": '#include "ros/messages/file_kinds.h"\nextern std::string text;',
    "frame_lookup.h": "extern ros::NodeHandle nh; extern double limit; extern geometry_msgs::PoseStamped message;",
    "node_time.h": "#include <geometry_msgs/PoseStamped.h>\n#include \"grid_path_planner/base/errors.h\"\n"
                   "using base::InputError; extern ros::NodeHandle nh; extern geometry_msgs::PoseStamped message; void forgetWhatWasSeen();",
    "foreign_rules.h": "#include \"grid_path_planner/ros/occupancy_conversion.h\"\nextern const MapEvent event;",
    "pose_reading.h": "#include <ros/console.h>\nextern geometry_msgs::Pose message; path::Pose placed(const path::Pose&);",
    "committed.h": "struct Settings { int options; int revision; }; extern int options;",
    "rebuildable.h": "struct Costmaps { explicit Costmaps(int); void update(int); }; extern int map, options; struct Stopped {};",
    "foreign_values.h": "extern std::shared_ptr<const OccupancyGrid> map; extern OccupancyThresholds thresholds;"
                        "void warn(const std::string&);",
    "backward_nodes.h": "extern const BackwardNodes& nodes; extern BackwardNodes::Index index;",
    "backward_search_tree.h": "extern const CostGrid &map, &old_map, &new_map; extern const MovePruning& moves;"
                   "extern Cell goal, start, moved_start; extern double extra; extern SearchResult result; extern CellRect changed;",
    "outdated_cells.h": "extern BackwardNodes& nodes; extern CellRect rect; extern StopPoll poll;",
    "ground_filter.h": "extern std::vector<Eigen::Vector3d> points; extern GroundFilterOptions options;",
    "headings.h": "extern Path path; extern Pose start, goal;",
    "incremental_a_star.h": "extern std::shared_ptr<const CostGrid> map, changed_map;"
                            "extern CellRect changed; extern Cell start, moved_start, goal;",
    "joystick.h": """#include "grid_path_planner/simulation/vehicle.h"
        extern std::vector<double> axes; extern std::vector<bool> buttons; extern Vehicle vehicle;""",
    "straight_jump_table.h": "extern const StraightJumpTable& table; extern std::size_t row; extern unsigned column;"
                    "extern const CostGrid::Weight* weights;",
    "jump_point_bits.h": "extern const CostGrid& map; extern Cell cell;", "jump_point_density.h": "extern const CostGrid& map;",
    "inconsistency_scan.h": "extern const BackwardNodes& nodes; extern CellRect rect;",
    "landmark_table.h": "extern const CostGrid& map; extern std::uint32_t index, goal_index;",
    "map_model.h": "extern ProjectedMapOptions options; extern std::vector<Eigen::Vector3d> points;extern CloudFrames frames;",
    "path_planner.h": """#include "grid_path_planner/grid/map_file.h"
        extern PlannerOptions options; extern Pose start, goal;""",
    "map_sizes.h": "extern const RectangleGraph& map;",
    "double_buffered.h": """#include "grid_path_planner/grid/occupancy.h"
        extern std::shared_ptr<const OccupancyGrid> reader; extern OccupancyGrid map;
        extern CellRect changed; extern Cell cell;""",
    "mapping_thread.h": "extern ProjectedMapOptions options;",
    "bounded_distance_transform.h": "extern const Grid<Occupancy>& classes; extern CellRect sources, rect;extern int reach;",
    "simd_neighbourhood.h": """#include "planners/core/steps.h"
        extern const CostGrid& map; extern CellRect rect; extern const StepRules& rules;
        extern std::vector<std::uint8_t> masks;""",
    "node_arguments.h": "extern int argc; extern char** argv;",
    "network_text.h": "#include <nav_msgs/OccupancyGrid.h>\nextern nav_msgs::OccupancyGrid message;",
    "node_files.h": """#include "grid_path_planner/NavigatePathGoal.h"
        #include "grid_path_planner/SaveWaypoints.h"
        #include "grid_path_planner/path/waypoint_file.h"
        #include "ros/messages/file_kinds.h"
        extern NodeFiles files; extern NavigatePathGoal goal; extern SaveWaypoints::Request request;""",
    "node_heap.h": "struct Node {}; extern Node node; extern double f, limit;",
    "occupancy_bricks.h": "extern OccupancyBricks bricks; extern std::uint16_t x, y, z;extern Brick content;",
    "occupancy_conversion.h": "extern nav_msgs::OccupancyGrid::ConstPtr message;extern ros::Publisher publisher;",
    "octree_map.h": "extern OctreeOptions options; extern octomap::point3d origin;extern std::vector<octomap::point3d> hits, clear_only;",
    "option_text.h": """#include "grid_path_planner/planning/path_planner.h"
        extern OptionInfo info; extern PlannerOptions options;""",
    "base/options.h": "enum class E {}; struct O { double radius; E kernel_rule; };",
    "parameters.h": """#include <grid_path_planner/PathPlannerConfig.h>
        #include "grid_path_planner/planning/path_planner.h\"""",
    "path_follower.h": "extern FollowerOptions options; extern Path path; extern double time;extern Pose pose; extern PathClearanceCheck check;",
    "heap_on_top_queue.h": "extern SearchKey first, width, key, bound; extern std::uint32_t order, index;"
                       "extern bool (*renew)(HeapOnTopQueue::Entry&);",
    "path_image.h": "extern OccupancyGrid map; extern OccupancyThresholds thresholds; extern Path path;"
                 "extern std::vector<Cell> expanded;",
    "plan_record.h": """#include <ros/publisher.h>
        extern ros::Publisher publisher; extern PlanQuestion question; extern grid::OccupancyGrid map;
        extern planning::Plan plan; extern path::Path poses; extern PlanRecord record;""",
    "plan_recorder.h": "extern ros::NodeHandle nh; extern PlanRecord record;",
    "plan_replay.h": """#include <iostream>
        extern std::vector<PlanRecord> records; extern MapsByChecksum maps;""",
    "map_checksum.h": """#include "grid_path_planner/PlanRecord.h"
        #include "ros/input/map_receiver.h"
        extern grid::OccupancyGrid map; extern grid::CellRect rect; extern map_msgs::OccupancyGridUpdate update;
        extern PlanRecord record;""",
    "recorded_maps.h": """using grid::OccupancyGrid; extern nav_msgs::OccupancyGrid message;
        void keep(std::uint64_t, const OccupancyGrid&);""",
    "planning_server.h": "extern ros::NodeHandle nh; extern PathPlannerNodeOptions options;"
                   "extern NodeFiles files;"
                   "extern PlanningRequest request;",
    "task_queue.h": "void plan(const StopSource&); void save(const StopSource&);",
    "planner.h": """#include "grid_path_planner/planners/planner_factory.h"
        extern SearchOptions options; extern std::shared_ptr<const CostGrid> map;
        extern StopSource source;""",
    "precomputed_heuristic.h": "extern AStarOptions options; extern std::shared_ptr<const CostGrid> map;"
                            "extern std::uint32_t goal; SearchResult search(SearchKey);"
                            "extern KeyScale scale; extern std::uint32_t index;",
    "precomputed_table.h": """#include "planners/tables/landmark_table.h"
        extern std::shared_ptr<const CostGrid> map; extern std::uint32_t goal_index;""",
    "process_pool.h": "extern std::vector<int> units; std::string done(int); extern std::size_t task;",
    "projection.h": """#include "grid_path_planner/mapping/octree_map.h"
        extern OctreeMap map; extern ProjectionOptions options; extern Scan scan;
        void send(const OccupancyGrid&, const CellRect&); void sendWhole(const OccupancyGrid&);""",
    "reachable_cells.h": "extern const CostGrid& map; extern Cell start, goal;",
    "rectangle_file.h": "extern RectangleGraph map;",
    "rectangle_graph.h": """#include "grid_path_planner/planners/decomposition.h"
        extern GridGeometry geometry; extern const BitMaps& bits; extern Cell cell;
        extern CellRect changed;""",
    "polyanya_mesh.h": """#include "grid_path_planner/planners/decomposition.h"
        extern const BitMap& free_cells;""",
    "rectangle_messages.h": "extern GridGeometry geometry; extern std::vector<CellRect> rectangles;"
                            "extern RectangleMap message; extern ros::Publisher publisher;",
    "rectangle_publisher.h": "extern ros::NodeHandle nh; extern std::shared_ptr<const CostGrid> costs;extern std::size_t memory_limit;",
    "cost_to_go_publisher.h": "extern ros::NodeHandle private_nh; extern std::shared_ptr<const CostGrid> costs;"
                              "extern Eigen::Vector2d goal; extern std::size_t memory_limit; void postCostToGo();",
    "d_star_keys.h": "extern const BackwardNodes& nodes; extern const CostGrid& map;"
                     "extern Cell start, next_start; extern SearchKey cost; extern DStarKeys::Index index;",
    "run_node.h": '#include "ros/simulation/simulator_node.h"',
    "seabed.h": "extern const OccupancyBricks& bricks; extern std::vector<BrickColumn> changed;"
                "extern BrickColumn column;",
    **dict.fromkeys(["smoothing.h", "zigzags.h"], "extern const CostGrid& map; extern std::vector<SegmentPoint> points;"),
    "costmap_builder.h": "extern CostmapOptions options; extern std::shared_ptr<const OccupancyGrid> map;",
    "tile_nodes.h": "extern GridGeometry geometry; extern Cell cell;",
    "prefetch.h": """#include "grid_path_planner/grid/occupancy.h"
        extern const OccupancyGrid& map; extern CellRect changed;""",
    "triangle_mesh.h": "extern Eigen::Isometry3d pose;",
    "unused_options.h": "extern PlannerOptions options; void warn(const std::string&);",
    "ray_scene.h": """#include "grid_path_planner/simulation/world.h"
        extern const World world; extern Eigen::Vector3f origin, rays[]; extern Eigen::Matrix3f map_from_sensor;
        extern float ranges[];""",
    "noise_stream.h": "#include \"simulation/sensors/pressure_options.h\"\nextern PressureOptions options; extern double truth;",
    "drifting_triad.h": "extern int seed; extern TriadErrors errors;",
    "sensors/imu.h": "extern ImuOptions options; extern Vehicle vehicle;",
    "sensors/dvl.h": "extern const World world; extern DvlOptions options; extern Vehicle vehicle;",
    "pressure_sensor.h": "extern PressureOptions options; extern Vehicle vehicle;",
    "usbl.h": "extern UsblOptions options; extern Vehicle vehicle;",
    "navigation_sensors.h": "extern NavigationSensorOptions options; extern std::shared_ptr<const World> world;"
                            "extern Vehicle vehicle;",
    "sensor_publisher.h": """extern ros::NodeHandle nh; extern simulation::NavigationSensorOptions sensor_options;
        extern std::shared_ptr<const simulation::World> world; extern std::vector<simulation::SensorFault> faults;
        extern simulation::Vehicle vehicle; extern SensorFrameNames frames;
        extern std::function<ros::Time(std::int64_t)> stamp_of;""",
    "vehicle.h": "extern VehicleOptions options; extern std::shared_ptr<const World> world;",
    "path_hash.h": "extern Planner& planner; extern SearchRequest request;",
    "rectangle_map_file.h": "extern GridGeometry geometry;",
    "option_files.h": '#include "ros/planning/path_planner_options.h"',
    "line_of_sight.h": "extern const CostGrid& map; extern SegmentPoint from, to; extern double cost;",
    "study_job.h": "extern StudyJob::MapReader read_map; void progress(std::size_t);",
    "route_progress.h": """#include "following/velocity_controller.h"
        extern Path path; extern FollowerOptions options; extern FollowEvents events; extern Pose pose;
        extern VelocityController& controller; extern double time, seconds;""",
    "velocity_controller.h": "extern const vehicle::Description* const vehicle; extern FollowerOptions options; extern const DrivenRoute& route; extern Pose pose;"
                             "extern std::size_t segment; extern double share, seconds; extern bool at_stop;",
    "radix_heap.h": "extern std::uint32_t f, node;",
    "diagonal_jump_bits.h": "extern const DiagonalJumpBits& bits; extern Cell cell;",
    "hashed_nodes.h": "extern int map_width; extern Cell cell;",
    "pruning_estimate.h": "#include \"planners/tables/block_bound.h\"\nextern PruningEstimate estimate; extern const CostGrid& map;",
    "study_planners.h": "extern SearchOptions options;",
    "vehicle_publisher.h": "extern ros::NodeHandle nh; extern VehicleState truth, measured;"
                           "extern ros::Time stamp; extern VehicleFrameNames frames;",
    "tiled_open_list.h": "extern GridGeometry geometry; extern SearchKey first, width, below;"
                       "extern DStarKeys keys; extern TiledOpenList::Index index;",
    "waypoint_file.h": "extern Path path;", "pose_spacing.h": "extern Path path;",
    "kept_search_tree.h": "extern const CostGrid &map, &before, &after; extern const SearchRequest& request; extern Planner& planner;"
                          "extern const std::vector<CellRect>& changed;",
    "cost_changes.h": "extern const CostGrid &before, &after; extern CellRect changed;",
    "weight_counts.h": "extern Grid<WeightCounts::Weight> weights, next_weights; extern CellRect changed;",
    "weighted_jump_map.h": "extern const CostGrid& map; extern Cell cell, goal; extern std::uint32_t index;"
                           "extern const CostGrid::Weight* weights; constexpr unsigned kEast = 0;",
    "weighted_jump_search.h": "extern const CostGrid& map; extern SearchRequest request;",
    "world.h": """
        #include <iostream>
        extern Eigen::Vector3d position;""",
}
