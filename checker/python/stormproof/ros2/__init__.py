"""`ros2 stormproof`: the running graph of ROS 2 as a scenario, so that nobody counts endpoints by hand.

graph    what rclpy says of the graph, as data that can be kept in a file
draft    that data as a scenario, with what it cannot know said beside it
command  the command for ros2cli
"""
