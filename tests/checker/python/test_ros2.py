"""`ros2 stormproof` against a recorded graph: three participants of two hosts, and two tools."""

import argparse
import contextlib
import io
import json
import os
import tempfile
import unittest

import ros2cli_stand_in

ros2cli_stand_in.install()

import stormproof  # noqa: E402
from stormproof.ros2 import draft, graph as graphs  # noqa: E402
from stormproof.ros2.command import StormproofCommand  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))


def recorded():
    with open(os.path.join(HERE, "graph.json"), encoding="utf-8") as file:
        return json.load(file)


class Graph(unittest.TestCase):
    def test_what_rclpy_answers_becomes_the_recording(self):
        expected = recorded()
        made = graphs.record(ros2cli_stand_in.Node(expected), expected["rmw"])
        self.assertEqual(made["own_node"], expected["own_node"])
        key = lambda each: (each["gid"], each["topic"])  # noqa: E731
        self.assertEqual(sorted(made["endpoints"], key=key), sorted(expected["endpoints"], key=key))


class Draft(unittest.TestCase):
    def text(self, change=lambda graph: None, **options):
        graph = recorded()
        change(graph)
        return draft.scenario_text(graph, **options)

    def test_participants_are_counted_with_their_endpoints(self):
        text = self.text()
        self.assertIn("{host: 0, publications: 1, subscriptions: 0}   # /robot1/lidar", text)
        # A second node brings 8 publications and 7 subscriptions of its own.
        self.assertIn("{host: 0, publications: 9, subscriptions: 9}   # /robot1/controller /robot1/planner", text)
        self.assertIn("{host: 1, publications: 1, subscriptions: 2}   # /station/monitor", text)
        self.assertNotIn("_ros2cli", text)
        self.assertNotIn("_stormproof", text)

    def test_it_is_a_scenario_that_runs(self):
        scenario = stormproof.scenario(text=self.text())
        self.assertEqual(scenario.participants, 3)
        runs = stormproof.simulate(scenario, seeds=range(2))
        self.assertTrue(all(completion > 0 for completion in runs["completion"]))

    def test_the_distribution_and_the_environment_choose_the_profile(self):
        self.assertIn("dds: 'fastdds-2.6.11'", self.text())

        def lyrical(graph):
            graph["ros_distro"] = graph["environment"]["ROS_DISTRO"] = "lyrical"

        later = self.text(lyrical)
        self.assertIn("fastdds-3.6", later)
        # Types that one participant alone has: map, twist and nothing else, over three participants.
        self.assertIn("unknown_per_participant: 1}", later)

        def cyclone(graph):
            graph["rmw"] = "rmw_cyclonedds_cpp"

        self.assertIn("cyclonedds", self.text(cyclone))

    def test_the_environment_of_this_process_stays_as_it_was(self):
        os.environ["ROS_DISTRO"] = "nowhere"
        try:
            self.assertIn("dds: 'fastdds-2.6.11'", self.text())
            self.assertEqual(os.environ["ROS_DISTRO"], "nowhere")
        finally:
            del os.environ["ROS_DISTRO"]

    def test_it_says_what_it_cannot_see_and_what_never_matches(self):
        text = self.text()
        self.assertRegex(text, r"Not seen: when processes start")
        self.assertIn("rt/robot1/scan", text)

    def test_without_hosts_in_the_gids_names_tell_them_apart(self):
        def cyclone(graph):
            for each in graph["endpoints"]:
                each["gid"] = "0110" + each["gid"][4:]

        with self.assertRaises(stormproof.InputError) as raised:
            self.text(cyclone)
        self.assertIn("--hosts-by namespace", str(raised.exception))
        self.assertIn("{host: 1, publications: 1, subscriptions: 2}", self.text(cyclone, hosts_by="namespace"))

    def test_one_host_and_nobody_are_refused(self):
        def one_host(graph):
            graph["endpoints"] = [each for each in graph["endpoints"] if each["gid"].startswith("010f2aa2")]

        with self.assertRaises(stormproof.InputError) as raised:
            self.text(one_host)
        self.assertIn("single host", str(raised.exception))

        def nobody(graph):
            graph["endpoints"] = []

        with self.assertRaises(stormproof.InputError):
            self.text(nobody)

    def test_names_are_no_markup(self):
        def hostile(graph):
            for each in graph["endpoints"]:
                each["node"] = each["node"].replace("lidar", "lidar\n- x: [")

        self.assertEqual(stormproof.scenario(text=self.text(hostile)).participants, 3)


class Command(unittest.TestCase):
    def run_command(self, *words):
        command = StormproofCommand()
        parser = argparse.ArgumentParser()
        command.add_arguments(parser, "ros2 stormproof")
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = command.main(parser=parser, args=parser.parse_args(words))
        return code, out.getvalue(), err.getvalue()

    def test_it_writes_what_it_says(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "fleet.yaml")
            code, out, err = self.run_command("--graph", os.path.join(HERE, "graph.json"), "-o", path)
            self.assertEqual((code, out), (0, ""))
            self.assertIn("stormproof simulate " + path, err)
            self.assertEqual(stormproof.scenario(path).participants, 3)

    def test_a_file_that_is_no_recording_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "graph.json")
            for text in ("", "[]", '{"rmw": "x"}'):
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
                code, _, err = self.run_command("--graph", path)
                self.assertEqual(code, 2)
                self.assertIn("expected what --record has written", err)


if __name__ == "__main__":
    unittest.main()
