"""What rclpy says of the running graph: a recording that JSON can hold, so that a scenario can be
drafted elsewhere and later, and tests need no ROS.

A recording is
    {"ros_distro": "humble", "rmw": "rmw_fastrtps_cpp", "own_node": "/_stormproof_1234",
     "environment": {"ROS_DOMAIN_ID": "0", …},
     "endpoints": [{"topic": "rt/scan", "type": "sensor_msgs::msg::dds_::LaserScan_",
                    "kind": "publication" | "subscription", "node": "/lidar",
                    "gid": "010f2aa2…" (hexadecimal, 16 bytes), "reliable": true, "transient_local": false}]}
Topics and types are those of DDS: every service, action and parameter server is there with the
endpoints that it really has.
"""

from __future__ import annotations

import os
import time
from typing import Any, Dict, List

# Variables that decide how nodes discover each other; `stormproof init` knows what they mean.
_PREFIXES = ("ROS_", "RMW_", "FASTRTPS_", "FASTDDS_", "CYCLONEDDS_")


def environment() -> Dict[str, str]:
    return {name: value for name, value in sorted(os.environ.items()) if name.startswith(_PREFIXES)}


def _full_name(namespace: str, name: str) -> str:
    return f"{namespace.rstrip('/')}/{name}"


def _is_policy(policy: Any, name: str) -> bool:
    """Policies are enumerations whose names grew and changed their case over the distributions."""
    return str(getattr(policy, "name", policy)).upper().endswith(name)


def _endpoints(infos: List[Any], topic: str, kind: str) -> List[Dict[str, Any]]:
    return [
        {
            "topic": topic,
            "type": info.topic_type,
            "kind": kind,
            "node": _full_name(info.node_namespace, info.node_name),
            "gid": bytes(info.endpoint_gid[:16]).hex(),
            "reliable": _is_policy(info.qos_profile.reliability, "RELIABLE"),
            "transient_local": _is_policy(info.qos_profile.durability, "TRANSIENT_LOCAL"),
        }
        for info in infos
    ]


def record(node: Any, rmw: str) -> Dict[str, Any]:
    """What `node`, an rclpy node that has had time to discover, knows."""
    endpoints: List[Dict[str, Any]] = []
    for topic, _ in node.get_topic_names_and_types(no_demangle=True):
        written = node.get_publishers_info_by_topic(topic, no_mangle=True)
        read = node.get_subscriptions_info_by_topic(topic, no_mangle=True)
        endpoints += _endpoints(written, topic, "publication")
        endpoints += _endpoints(read, topic, "subscription")
    return {
        "ros_distro": os.environ.get("ROS_DISTRO", ""),
        "rmw": rmw,
        "own_node": _full_name(node.get_namespace(), node.get_name()),
        "environment": environment(),
        "endpoints": endpoints,
    }


def read_running(seconds: float) -> Dict[str, Any]:
    """The graph as a node of its own sees it that long after its start."""
    import rclpy
    from rclpy.utilities import get_rmw_implementation_identifier

    rclpy.init()
    try:
        node = rclpy.create_node(f"_stormproof_{os.getpid()}")
        try:
            time.sleep(seconds)
            return record(node, get_rmw_implementation_identifier())
        finally:
            node.destroy_node()
    finally:
        rclpy.shutdown()
