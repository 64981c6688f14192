#!/usr/bin/env python3
"""Sends the packets of simulated runs through ns-3's Wi-Fi and compares their delays.

Open loop: what a participant sent in our run, at the time at which it sent it, is given to ns-3
(replay.cc), which has its own medium access, aggregation, Block Acks and random backoff. Compared is, packet by
packet, the time from being sent to the last fragment's arrival at its (last) receiver.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

BUILT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../build")
SKIPPED = 77
# What of a wireless profile ns-3 calls differently.
RADIOS = {
    "wifi-80211n": ["--standard=80211n", "--mode=HtMcs15", "--width=20", "--ampdu=0"],
    "wifi-80211n-ampdu": ["--standard=80211n", "--mode=HtMcs15", "--width=20", "--ampdu=65535"],
    "wifi-80211ac-80": ["--standard=80211ac", "--mode=VhtMcs9", "--width=80", "--ampdu=1048575"],
    "wifi-80211ax": ["--standard=80211ax", "--mode=HeMcs11", "--width=20", "--ampdu=4194303", "--window=256"],
}
# Deployments of two hosts with Fast DDS 2.6.11: participants a host, user endpoints a participant.
SIZES = [(1, 20), (3, 20), (5, 20), (6, 30)]


def fail(message):
    sys.exit(f"compare: {message}")


class Packet:
    def __init__(self, sender, host, to, size, sent):
        self.sender, self.host, self.to, self.size, self.sent = sender, host, to, size, sent
        self.arrived = None


def run_of(program, radio, size, folder):
    """The packets of a run that left their host, by number, and the options of the same run in ns-3."""
    trace = f"{folder}/run.jsonl"
    command = [program, "simulate", "wifi-5x20-fastdds", "--set", f"wireless={radio}",
               "--set", f"deployment.participants_per_host={size[0]}",
               "--set", f"deployment.endpoints_per_participant={size[1]}", "--trace", trace]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 3):
        fail(f"{' '.join(command)}: {done.stderr}")
    with open(trace, encoding="utf-8") as lines:
        scenario = json.loads(next(lines))["scenario"]
        hosts = [participant["host"] for participant in scenario["deployment"]["participants"]]
        packets = packets_of(lines, hosts)
    wireless = scenario["wireless"]
    options = [f"--hosts={max(hosts) + 1}",
               f"--fragment={wireless['mtu_payload_bytes']}",
               f"--buffer={wireless['source_queue_bytes']}",
               f"--link={wireless['link_overhead_bytes']}"]
    return packets, options + RADIOS[radio]


def packets_of(lines, host_of):
    packets = {}
    for line in lines:
        event = json.loads(line)
        for emitted in event.get("emitted", []):
            receivers = ["multicast"] if emitted["to"] == "multicast" else emitted["to"]
            for k, receiver in enumerate(receivers):
                to = -1 if receiver == "multicast" else host_of[receiver]
                packets[emitted["packet"] + k] = Packet(emitted["from"], host_of[emitted["from"]], to,
                                                        emitted["bytes"], event["t"])
        arrived = event.get("arrived", [])
        for one in arrived if isinstance(arrived, list) else [arrived]:
            number = one["packet"] if isinstance(one, dict) else one
            packets[number].arrived = event["t"]
    return packets


def replayed(replay, packets, options, seed):
    """When ns-3 delivers each packet, by number; None for those that it lost."""
    lines = "".join(f"datagram {p.sent} {p.sender} {p.host} {p.to} {p.size}\n" for p in packets.values())
    done = subprocess.run([replay, *options, f"--seed={seed}"], input=lines, capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        fail(f"replay ended with {done.returncode}: {done.stderr}")
    times = [int(line.split()[0]) for line in done.stdout.splitlines()]
    if len(times) != len(packets):
        fail(f"replay answered {len(times)} of {len(packets)} datagrams")
    return {number: None if time < 0 else time for number, time in zip(packets, times)}


def ratios(packets, times):
    """Ours over ns-3's, of the packets that both delivered: mean delay, 90th percentile, last arrival."""
    both = [(p.arrived - p.sent, times[n] - p.sent, p.arrived, times[n]) for n, p in packets.items()
            if p.arrived is not None and times[n] is not None]
    ours, theirs = sorted(b[0] for b in both), sorted(b[1] for b in both)
    at = int(0.9 * (len(both) - 1))
    return {"mean": statistics.fmean(ours) / statistics.fmean(theirs),
            "p90": ours[at] / theirs[at],
            "last": max(b[2] for b in both) / max(b[3] for b in both),
            "delay_ms": statistics.fmean(theirs) / 1e6,
            "lost": sum(time is None for time in times.values())}


def span(values, digits=2):
    low, high = f"{min(values):.{digits}f}", f"{max(values):.{digits}f}"
    return low if low == high else f"{low} to {high}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default=f"{BUILT}/bin/stormproof", help="stormproof")
    parser.add_argument("--replay", default=f"{BUILT}/bin/stormproof_ns3_replay", help="replay.cc, compiled")
    parser.add_argument("--seeds", type=int, default=5, help="of ns-3's backoff")
    parser.add_argument("--radio", choices=RADIOS, action="append", help="default: all")
    parser.add_argument("--size", action="append", help="such as 5x20; default: all")
    parser.add_argument("--within", type=float, help="exit with 1 unless mean delays are within this factor")
    arguments = parser.parse_args()
    if not os.path.exists(arguments.replay):
        print("skipped: ns-3 (Debian's libns3-dev) was not there when the tests were built")
        sys.exit(SKIPPED)
    sizes = [tuple(map(int, size.split("x"))) for size in arguments.size or []] or SIZES

    print("| radio | 2 x N_P x N_E | packets | mean delay in ns-3, ms | ours / ns-3: mean | 90 % | last arrival |"
          " lost in ns-3 |")
    print("|---|---|---|---|---|---|---|---|")
    farthest = 1.0
    for radio in arguments.radio or RADIOS:
        for size in sizes:
            with tempfile.TemporaryDirectory() as folder:
                packets, options = run_of(arguments.program, radio, size, folder)
            rows = [ratios(packets, replayed(arguments.replay, packets, options, seed))
                    for seed in range(1, arguments.seeds + 1)]
            of = {key: [row[key] for row in rows] for key in rows[0]}
            farthest = max([farthest, *of["mean"], *(1 / mean for mean in of["mean"])])
            print(f"| `{radio}` | 2x{size[0]}x{size[1]} | {len(packets)} | {span(of['delay_ms'], 1)} | "
                  f"{span(of['mean'])} | {span(of['p90'])} | {span(of['last'])} | {span(of['lost'], 0)} |",
                  flush=True)
    if arguments.within is not None and farthest > arguments.within:
        fail(f"a mean delay is {farthest:.2f} times the other; expected at most {arguments.within}")


main()
