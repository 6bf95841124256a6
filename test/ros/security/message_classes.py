"""Python's class of a message type. Debian has the C++ messages of some packages without Python's: those that the
nodes hear are made here of their definitions."""
from genpy.dynamic import generate_dynamic
from roslib.message import get_message_class

def part(kind, fields):
    return "=" * 80 + "\nMSG: %s\n%s" % (kind, fields)


HEADER = part("std_msgs/Header", "uint32 seq\ntime stamp\nstring frame_id\n")
VECTOR3 = part("geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n")
QUATERNION = part("geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n")
TRANSFORM = (part("geometry_msgs/TransformStamped", "Header header\nstring child_frame_id\nTransform transform\n") + HEADER
             + part("geometry_msgs/Transform", "Vector3 translation\nQuaternion rotation\n") + VECTOR3 + QUATERNION)
POINT_FIELD = part("sensor_msgs/PointField", "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\n"
                   "uint8 INT32=5\nuint8 UINT32=6\nuint8 FLOAT32=7\nuint8 FLOAT64=8\n"
                   "string name\nuint32 offset\nuint8 datatype\nuint32 count\n")
REGION = part("sensor_msgs/RegionOfInterest", "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\n"
              "bool do_rectify\n")
DEFINITIONS = {
    "sensor_msgs/Imu": "Header header\ngeometry_msgs/Quaternion orientation\nfloat64[9] orientation_covariance\n"
                       "geometry_msgs/Vector3 angular_velocity\nfloat64[9] angular_velocity_covariance\n"
                       "geometry_msgs/Vector3 linear_acceleration\nfloat64[9] linear_acceleration_covariance\n"
                       + HEADER + VECTOR3 + QUATERNION,
    "map_msgs/OccupancyGridUpdate": "Header header\nint32 x\nint32 y\nuint32 width\nuint32 height\nint8[] data\n"
                                    + HEADER,
    "sensor_msgs/CameraInfo": "Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] D\n"
                              "float64[9] K\nfloat64[9] R\nfloat64[12] P\nuint32 binning_x\nuint32 binning_y\n"
                              "RegionOfInterest roi\n" + HEADER + REGION,
    "sensor_msgs/FluidPressure": "Header header\nfloat64 fluid_pressure\nfloat64 variance\n" + HEADER,
    "sensor_msgs/Image": "Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\n"
                         "uint32 step\nuint8[] data\n" + HEADER,
    "sensor_msgs/Joy": "Header header\nfloat32[] axes\nint32[] buttons\n" + HEADER,
    "sensor_msgs/LaserScan": "Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\n"
                             "float32 time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\n"
                             "float32[] ranges\nfloat32[] intensities\n" + HEADER,
    "sensor_msgs/PointCloud2": "Header header\nuint32 height\nuint32 width\nPointField[] fields\nbool is_bigendian\n"
                               "uint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n"
                               + HEADER + POINT_FIELD,
    "tf2_msgs/TFMessage": "geometry_msgs/TransformStamped[] transforms\n" + TRANSFORM,
}


MADE = {name: made for kind, text in DEFINITIONS.items() if get_message_class(kind) is None
        for name, made in generate_dynamic(kind, text).items()}


def message_class(kind):
    """None where there is none."""
    return MADE.get(kind) or get_message_class(kind)
