"""A recorded graph as a scenario: who takes part and on which host. What the graph does not say (when
processes start, the network) is what `stormproof init` assumes, whose text this is built on; which
profile the distribution, the middleware and the environment mean is decided there, too."""

from __future__ import annotations

import contextlib
import os
import re
import textwrap
from collections import Counter
from dataclasses import dataclass, field
from typing import Any, Dict, Iterator, List, Mapping, Set

from .. import _core
from .._errors import InputError

# What each participant has without its user's doing, which the model adds: the first node's rosout,
# parameter events and services of parameters, and ros_discovery_info (model.md, "Participants").
DEFAULT_PUBLICATIONS, DEFAULT_SUBSCRIPTIONS = 9, 8

_PREFIX_BYTES = 12  # of a GID: the participant's; the rest names the endpoint
_FAST_DDS = "010f"  # vendor: its prefixes go on with the host, two bytes (GuidUtils.hpp)


@dataclass
class Participant:
    prefix: str
    publications: int = 0
    subscriptions: int = 0
    nodes: Set[str] = field(default_factory=set)
    types: List[str] = field(default_factory=list)
    host: str = ""


def _known_nodes(endpoints: List[Mapping[str, Any]]) -> Set[str]:
    return {each["node"] for each in endpoints if not each["node"].endswith("_NODE_NAME_UNKNOWN_")}


def participants_of(graph: Mapping[str, Any]) -> List[Participant]:
    """Those with endpoints, in the order of their prefixes, without this command's and without tools of
    the command line."""
    found: Dict[str, Participant] = {}
    for endpoint in graph["endpoints"]:
        prefix = endpoint["gid"][: 2 * _PREFIX_BYTES]
        one = found.setdefault(prefix, Participant(prefix))
        if endpoint["kind"] == "publication":
            one.publications += 1
        else:
            one.subscriptions += 1
        one.nodes |= _known_nodes([endpoint])
        one.types.append(endpoint["type"])
    tools = {graph["own_node"]}

    def is_tool(one: Participant) -> bool:
        return bool(one.nodes) and all(
            node in tools or node.rsplit("/", 1)[-1].startswith("_ros2cli") for node in one.nodes
        )

    return [found[prefix] for prefix in sorted(found) if not is_tool(found[prefix])]


def _namespace(one: Participant) -> str:
    """The first part of its nodes' names: "/robot1/nav/planner" is of "robot1"."""
    if not one.nodes:
        raise InputError("", "a participant without a known node; expected --hosts-by gid")
    return sorted(one.nodes)[0].strip("/").split("/")[0]


def name_hosts(participants: List[Participant], by: str) -> str:
    """Says on which host each runs, and returns how that is known."""
    if by == "gid":
        if not all(one.prefix.startswith(_FAST_DDS) for one in participants):
            raise InputError(
                "--hosts-by gid",
                "these GIDs do not say on which host a participant runs; Fast DDS's do. expected "
                "--hosts-by namespace, with a namespace for each robot",
            )
        for one in participants:
            one.host = one.prefix[4:8]
        return "by the two bytes of Fast DDS's GIDs that stand for the host"
    for one in participants:
        one.host = _namespace(one)
    return "assumed: the first part of a node's name stands for the host"


def _unknown_types(participants: List[Participant]) -> int:
    """Endpoints of a participant with a type that nobody else has, on average, rounded."""
    owners = Counter(kind for one in participants for kind in set(one.types))
    alone = sum(1 for one in participants for kind in one.types if owners[kind] == 1)
    return round(alone / len(participants))


def _never_matching(graph: Mapping[str, Any]) -> List[str]:
    """Topics on which a reader asks for more than a writer offers."""
    offered: Dict[str, List[Mapping[str, Any]]] = {}
    for each in graph["endpoints"]:
        if each["kind"] == "publication":
            offered.setdefault(each["topic"], []).append(each)
    topics = {
        each["topic"]
        for each in graph["endpoints"]
        if each["kind"] == "subscription"
        for writer in offered.get(each["topic"], [])
        if each["reliable"] > writer["reliable"] or each["transient_local"] > writer["transient_local"]
    }
    return sorted(topics)


def remarks_of(graph: Mapping[str, Any], participants: List[Participant], how: str) -> List[str]:
    """What stands at the top of the scenario: what was seen, what could not be, and what is assumed."""
    seen = sum(one.publications + one.subscriptions for one in participants)
    remarks = [
        f"Read from the running graph by `ros2 stormproof`: {len(participants)} participants with "
        f"{seen} endpoints, as one node saw them. Hosts: {how}.",
        "Not seen: when processes start, here and on other hosts (the schedule is assumed); the network "
        "(wireless: is assumed); participants that this node has not discovered; middleware and "
        "settings of other hosts, which are assumed to be those of this one.",
    ]
    few = [
        one
        for one in participants
        if one.publications < DEFAULT_PUBLICATIONS or one.subscriptions < DEFAULT_SUBSCRIPTIONS
    ]
    if few:
        remarks.append(
            f"{len(few)} participants have fewer endpoints than a node with its parameters; they are "
            "modelled with those that every node has."
        )
    never = _never_matching(graph)
    if never:
        remarks.append(
            "QoS: on these topics a subscription asks for more than a publisher offers, and they never "
            "match, however discovery goes: " + ", ".join(never) + "."
        )
    return remarks


@contextlib.contextmanager
def _environment(variables: Mapping[str, str]) -> Iterator[None]:
    """As where the graph was read; also for the C++ half, which asks the process."""
    before = dict(os.environ)
    for name in before:
        if name in variables or name.startswith(("ROS_", "RMW_", "FASTRTPS_", "FASTDDS_", "CYCLONEDDS_")):
            del os.environ[name]
    os.environ.update(variables)
    try:
        yield
    finally:
        os.environ.clear()
        os.environ.update(before)


def _drafted(graph: Mapping[str, Any], participants: List[Participant], wireless: str) -> str:
    """What `stormproof init` makes of the numbers and the environment."""
    hosts = Counter(one.host for one in participants)
    largest = max(_user_endpoints(one) for one in participants)
    words = ["init", "--from-environment", "--wireless", wireless]
    words += ["--hosts", str(len(hosts)), "--participants", str(max(hosts.values()))]
    words += ["--endpoints", str(largest), "--unknown-types", str(_unknown_types(participants))]
    if graph["ros_distro"]:
        words += ["--ros", graph["ros_distro"]]
    if graph["rmw"].startswith("rmw_cyclonedds"):
        words += ["--rmw", "cyclonedds"]
    elif graph["rmw"].startswith("rmw_fastrtps"):
        words += ["--rmw", "fastrtps"]
    else:
        raise InputError("RMW_IMPLEMENTATION", f"'{graph['rmw']}' is in no profile; expected "
                         "rmw_fastrtps_cpp or rmw_cyclonedds_cpp")
    with _environment(graph["environment"]):
        code, printed, said = _core.run(words)
    if code != 0:
        raise InputError.of_complaint(said.decode("utf-8", "replace"))
    return printed.decode("utf-8")


def _user_publications(one: Participant) -> int:
    return max(0, one.publications - DEFAULT_PUBLICATIONS)


def _user_subscriptions(one: Participant) -> int:
    return max(0, one.subscriptions - DEFAULT_SUBSCRIPTIONS)


def _user_endpoints(one: Participant) -> int:
    return _user_publications(one) + _user_subscriptions(one)


def _deployment(participants: List[Participant]) -> str:
    hosts = sorted({one.host for one in participants})
    lines = ["  participants:"]
    for one in sorted(participants, key=lambda each: (each.host, each.prefix)):
        names = " ".join(sorted(one.nodes)) or "no node is known"
        lines.append(
            f"    - {{host: {hosts.index(one.host)}, publications: {_user_publications(one)}, "
            f"subscriptions: {_user_subscriptions(one)}}}   # {_on_one_line(names)}"
        )
    return "\n".join(lines) + "\n"


def _on_one_line(text: str, width: int = 60) -> str:
    """Names come from anywhere: no line feeds, and not too long."""
    shown = "".join(c if c.isprintable() else "?" for c in text)
    return shown if len(shown) <= width else shown[: width - 1] + "…"


def scenario_text(graph: Mapping[str, Any], *, hosts_by: str = "gid", wireless: str = "wifi-80211n") -> str:
    """The scenario, which has been read back. Raises InputError."""
    participants = participants_of(graph)
    if not participants:
        raise InputError("", "no participant was seen; expected running nodes and a longer --seconds")
    how = name_hosts(participants, hosts_by)
    text = _drafted(graph, participants, wireless)
    # The numbers of `init` stand for those that were counted.
    counted = re.compile(r"^  hosts: .*?(?=^  (?:types|loopback_delay|schedule):)", re.DOTALL | re.MULTILINE)
    text, places = counted.subn(lambda _: _deployment(participants), text)
    assert places == 1, text
    text = re.sub(r"^# Drafted by `stormproof init`\.", "# Drafted by `ros2 stormproof`.", text)
    text = re.sub(r"^description: .*$", f"description: {len(participants)} participants that were running",
                  text, flags=re.MULTILINE)
    remarks = [textwrap.fill(remark, 110, initial_indent="# ", subsequent_indent="# ")
               for remark in remarks_of(graph, participants, how)]
    text = "\n".join(_on_one_line(line, 1000) for part in remarks for line in part.split("\n")) + "\n" + text
    _core.Scenario.parse(text, "ros2 stormproof", [])
    return text
