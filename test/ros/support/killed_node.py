"""What a test has killed, at the master.

A master goes on to know it, and calls its ports, where a node of another test, with another master, may be by then: it
is told that its topics have no publishers any more, or to shut down (killed_node.h is the same for tests in C++).
"""
import rosgraph
import rospy


def forget(name):
    """Who registers a name takes all that was registered by it, cached parameters too."""
    master = rosgraph.Master(name)
    master.registerSubscriber("/nobody", "std_msgs/Empty", rospy.get_node_uri())
    master.unregisterSubscriber("/nobody", rospy.get_node_uri())
