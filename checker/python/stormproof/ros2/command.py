"""The command for ros2cli (entry point `ros2cli.command`): reads the running graph, writes a scenario."""

from __future__ import annotations

import json
import sys
from typing import Any

from ros2cli.command import CommandExtension

from .._errors import InputError
from . import graph as graphs
from .draft import scenario_text


class StormproofCommand(CommandExtension):
    """Draft a stormproof scenario of the running system."""

    def add_arguments(self, parser: Any, cli_name: str) -> None:
        parser.description = (
            "Reads the running graph (participants, endpoints with their types and QoS, middleware and "
            "environment) into a scenario for `stormproof simulate`, `check`, `tune` and `fix`."
        )
        parser.add_argument("-o", "--output", metavar="FILE", help="write the scenario here, not to stdout")
        parser.add_argument("--seconds", type=float, default=3.0,
                            help="how long to discover before looking (default 3)")
        parser.add_argument("--hosts-by", choices=["gid", "namespace"], default="gid",
                            help="how hosts are told apart: by Fast DDS's GIDs (default), or by the first "
                                 "part of the names of nodes")
        parser.add_argument("--wireless", default="wifi-80211n", help="wireless profile (default wifi-80211n)")
        parser.add_argument("--graph", metavar="FILE", help="a recorded graph instead of the running one")
        parser.add_argument("--record", metavar="FILE", help="keep the graph that was read, too")

    def main(self, *, parser: Any, args: Any) -> int:
        try:
            graph = _recorded(args.graph) if args.graph else graphs.read_running(args.seconds)
            if args.record:
                _write(args.record, json.dumps(graph, indent=1) + "\n")
            text = scenario_text(graph, hosts_by=args.hosts_by, wireless=args.wireless)
            if args.output:
                _write(args.output, text)
            else:
                sys.stdout.write(text)
        except (InputError, OSError) as error:
            print(f"ros2 stormproof: {error}", file=sys.stderr)
            return 2
        if args.output:
            print(f"ros2 stormproof: next: stormproof simulate {args.output}", file=sys.stderr)
        return 0


def _recorded(path: str) -> Any:
    with open(path, encoding="utf-8") as file:
        try:
            graph = json.load(file)
        except ValueError as error:
            raise InputError(path, f"no JSON: {error}; expected what --record has written") from None
    keys = {"ros_distro", "rmw", "own_node", "environment", "endpoints"}
    missing = sorted(keys - set(graph)) if isinstance(graph, dict) else sorted(keys)
    if missing:
        raise InputError(path, f"without {', '.join(missing)}; expected what --record has written")
    return graph


def _write(path: str, text: str) -> None:
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
