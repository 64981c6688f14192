"""What `ros2 stormproof` needs of ROS, for machines without it: ros2cli's CommandExtension, whose two
functions ros2cli calls, and of rclpy a node that answers from a recorded graph as rclpy's does."""

import sys
import types
from collections import namedtuple
from enum import Enum


def install() -> None:
    package, module = types.ModuleType("ros2cli"), types.ModuleType("ros2cli.command")

    class CommandExtension:
        def add_arguments(self, parser, cli_name):
            pass

        def main(self, *, parser, args):
            raise NotImplementedError

    module.CommandExtension = CommandExtension
    package.command = module
    sys.modules.update({"ros2cli": package, "ros2cli.command": module})


class Reliability(Enum):
    RELIABLE = 1
    BEST_EFFORT = 2


class Durability(Enum):
    TRANSIENT_LOCAL = 1
    VOLATILE = 2


Qos = namedtuple("Qos", "reliability durability")
Info = namedtuple("Info", "node_name node_namespace topic_type endpoint_gid qos_profile")


class Node:
    """Answers from endpoints of a recording; a GID of Humble has 24 bytes, of which 16 count."""

    def __init__(self, graph):
        self._graph = graph

    def get_name(self):
        return self._graph["own_node"].rsplit("/", 1)[1]

    def get_namespace(self):
        return self._graph["own_node"].rsplit("/", 1)[0] or "/"

    def get_topic_names_and_types(self, no_demangle=False):
        assert no_demangle
        topics = {}
        for each in self._graph["endpoints"]:
            topics.setdefault(each["topic"], set()).add(each["type"])
        return [(topic, sorted(kinds)) for topic, kinds in topics.items()]

    def _infos(self, topic, kind):
        for each in self._graph["endpoints"]:
            if each["topic"] != topic or each["kind"] != kind:
                continue
            namespace, name = each["node"].rsplit("/", 1)
            qos = Qos(
                Reliability.RELIABLE if each["reliable"] else Reliability.BEST_EFFORT,
                Durability.TRANSIENT_LOCAL if each["transient_local"] else Durability.VOLATILE,
            )
            yield Info(name, namespace or "/", each["type"], list(bytes.fromhex(each["gid"])) + [0] * 8, qos)

    def get_publishers_info_by_topic(self, topic, no_mangle=False):
        assert no_mangle
        return list(self._infos(topic, "publication"))

    def get_subscriptions_info_by_topic(self, topic, no_mangle=False):
        assert no_mangle
        return list(self._infos(topic, "subscription"))
