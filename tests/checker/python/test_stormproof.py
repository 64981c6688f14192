"""The Python module: scenarios, runs as columns, verbs, mistakes with their place, Ctrl-C."""

import importlib.util
import math
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import tempfile
import textwrap
import threading
import time
import unittest

import stormproof

HAS_NUMPY = importlib.util.find_spec("numpy") is not None
HAS_PANDAS = importlib.util.find_spec("pandas") is not None

FLEET = """\
deployment: {hosts: 2, participants_per_host: 1, endpoints_per_participant: 2}
dds: paper
wireless: wifi-80211n-paper
time_limit: 200s
"""


class Scenarios(unittest.TestCase):
    def test_one_scenario_four_ways(self):
        deployment = {"hosts": 2, "participants_per_host": 1, "endpoints_per_participant": 2}
        by_keys = stormproof.scenario(deployment=deployment, dds="paper", wireless="wifi-80211n-paper",
                                      time_limit="200s")
        self.assertEqual(by_keys, stormproof.scenario(text=FLEET))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "fleet.yaml"
            path.write_text(FLEET, encoding="utf-8")
            self.assertEqual(by_keys, stormproof.scenario(path))
        larger = stormproof.scenario("wifi-5x20", set={"deployment.participants_per_host": 1,
                                                       "deployment.endpoints_per_participant": 2})
        self.assertEqual(larger.participants, by_keys.participants)
        self.assertNotEqual(by_keys, stormproof.scenario("wifi-5x20"))
        self.assertEqual(by_keys, stormproof.scenario(text=by_keys.yaml))

    def test_a_scenario_is_changed_by_overrides(self):
        base = stormproof.scenario("wifi-5x20")
        changed = stormproof.scenario(base, set={"deployment.participants_per_host": 2})
        self.assertEqual((base.participants, changed.participants), (10, 4))

    def test_mistakes_have_their_place(self):
        with self.assertRaises(stormproof.InputError) as raised:
            stormproof.scenario(text=FLEET.replace("hosts: 2", "hosts: two"))
        error = raised.exception
        self.assertEqual((error.file, error.line, error.column), ("<text>", 1, 21))
        self.assertIn("two", str(error))
        self.assertIsNotNone(error.expected)
        self.assertIsInstance(error, ValueError)
        self.assertEqual(str(pickle.loads(pickle.dumps(error))), str(error))
        with self.assertRaises(stormproof.InputError) as raised:
            stormproof.scenario("wifi-5x21")
        self.assertIn("wifi-5x20", str(raised.exception))
        with self.assertRaises(TypeError):
            stormproof.scenario("wifi-5x20", text=FLEET)
        with self.assertRaises(TypeError):
            stormproof.scenario()


class Runs(unittest.TestCase):
    def test_a_run_is_the_one_of_the_command_line(self):
        runs = stormproof.simulate("smallest")
        answer = stormproof.verb("simulate", "smallest")
        self.assertEqual(runs.rows, 1)
        self.assertEqual(round(runs["completion"][0] * 1e9), answer["t_disc_ns"])
        self.assertEqual(runs["messages"][0], answer["counts"]["total"])
        self.assertEqual(runs["completion"][-1], runs["completion"][0])
        with self.assertRaises(IndexError):
            runs["completion"][1]

    def test_seeds_are_rows_and_the_same_again(self):
        one = stormproof.simulate("live-5x20", seeds=range(3), threads=1)
        again = stormproof.simulate("live-5x20", seeds=[2, 1, 0])
        self.assertEqual(list(one["seed"]), [0, 1, 2])
        self.assertEqual(list(one["completion"]), list(again["completion"])[::-1])
        self.assertEqual(len(set(one["completion"])), 3)
        self.assertTrue(set(one.words["health"]) >= {"fine", "storm"})

    def test_what_draws_nothing_has_one_run(self):
        with self.assertRaises(stormproof.InputError):
            stormproof.simulate("smallest", seeds=range(2))
        self.assertEqual(stormproof.simulate("smallest", seeds=range(2), start_jitter=0.1).rows, 2)
        with self.assertRaises(ValueError):
            stormproof.simulate("smallest", start_jitter=-1)

    def test_a_run_that_does_not_complete_has_no_time(self):
        runs = stormproof.simulate(stormproof.scenario("wifi-5x20", set={"time_limit": "10ms"}))
        self.assertTrue(math.isnan(runs["completion"][0]) and math.isnan(runs["took"][0]))

    def test_a_recording_has_every_packet(self):
        run = stormproof.record("wifi-5x20")
        self.assertEqual(run.completion, stormproof.simulate("wifi-5x20")["completion"][0])
        kinds = [run.packets.words["kind"][kind] for kind in run.packets["kind"]]
        answer = stormproof.verb("simulate", "wifi-5x20")["counts"]
        self.assertEqual(kinds.count("acknack"), answer["acknack"])
        self.assertEqual(kinds.count("spdp_multicast"), answer["spdp_multicast"])
        self.assertTrue(0 < kinds.count("heartbeat") <= answer["heartbeat"])  # others ride on DATA
        arrived = zip(run.packets["emitted_ns"], run.packets["arrived_ns"])
        self.assertTrue(all(at == -1 or at >= since for since, at in arrived))
        self.assertEqual(run.progress["missing"][-1], 0)
        self.assertGreater(run.transitions.rows, 1000)
        self.assertEqual(len(run.transitions["before"]), len(run.transitions["after"]))

    @unittest.skipUnless(HAS_NUMPY, "numpy is not installed")
    def test_numpy_shares_the_memory(self):
        import numpy

        runs = stormproof.simulate("live-5x20", seeds=range(2))
        one, other = numpy.asarray(runs["completion"]), runs.numpy()["completion"]
        self.assertTrue(numpy.shares_memory(one, other))
        self.assertEqual((one.dtype, one.shape), (numpy.float64, (2,)))
        with self.assertRaises(ValueError):
            other[0] = 0
        with self.assertRaises(ValueError):
            one[0] = 0

    @unittest.skipUnless(HAS_PANDAS, "pandas is not installed")
    def test_pandas_shares_it_too_and_has_words(self):
        import numpy

        runs = stormproof.simulate("live-5x20", seeds=range(2))
        frame = runs.pandas()
        self.assertTrue(numpy.shares_memory(frame["completion"].to_numpy(), runs.numpy()["completion"]))
        self.assertTrue(set(frame["health"]) <= set(runs.words["health"]))


class Verbs(unittest.TestCase):
    def test_check_of_a_text(self):
        answer = stormproof.check(stormproof.scenario(text=FLEET), property=["storm.free-threshold"])
        self.assertEqual(answer["command"].split()[1], "check")
        self.assertEqual([each["id"] for each in answer["verdicts"]], ["storm.free-threshold"])

    def test_diff_of_a_profile_with_itself(self):
        with tempfile.TemporaryDirectory() as folder:
            answer = stormproof.diff("paper", "paper", no_check=True, output=folder)
        self.assertEqual((answer["exit_code"], answer["verdict"]), (0, "same"))

    def test_conform_of_a_capture(self):
        specs = pathlib.Path(__file__).resolve().parents[3] / "specs"
        capture = specs / "captures/fastdds291_veth_np1_ne2_r0.pcap.xz"
        self.assertEqual(stormproof.conform(capture, dds="fastdds-2.9.1")["verdict"], "conforms")

    def test_tune_finds_something(self):
        answer = stormproof.tune("live-5x20", budget=50)
        self.assertEqual((answer["exit_code"], answer["verdict"]), (0, "better"))

    def test_a_verb_refuses_with_the_place(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "fleet.yaml"
            path.write_text(FLEET.replace("time_limit", "tyme_limit"), encoding="utf-8")
            with self.assertRaises(stormproof.InputError) as raised:
                stormproof.check(path)
            self.assertEqual((raised.exception.file, raised.exception.line), (str(path), 4))
        with self.assertRaises(stormproof.InputError) as raised:
            stormproof.verb("simulat", "smallest")
        self.assertIn("simulate", str(raised.exception))

    def test_memory_of_the_process_stays_its_own(self):
        import resource

        before = resource.getrlimit(resource.RLIMIT_DATA)
        stormproof.verb("simulate", "smallest", max_memory="20GB")
        self.assertEqual(resource.getrlimit(resource.RLIMIT_DATA), before)

    def test_nothing_is_printed(self):
        code = "import stormproof; stormproof.verb('simulate', 'smallest')"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True)
        self.assertEqual((done.stdout, done.stderr), (b"", b""))


class Patience(unittest.TestCase):
    """Long work: other threads go on, and Ctrl-C ends it."""

    STORM = 'stormproof.scenario("wifi-5x20", set={"deployment.participants_per_host": 40})'

    def test_other_threads_run_meanwhile(self):
        counted = 0
        is_done = threading.Event()

        def count():
            nonlocal counted
            while not is_done.is_set():
                counted += 1
                time.sleep(0.001)

        counter = threading.Thread(target=count)
        counter.start()
        stormproof.simulate("live-5x20", seeds=range(20), threads=1)
        is_done.set()
        counter.join()
        self.assertGreater(counted, 10)

    def interrupted(self, work):
        """Has `work` interrupted once it runs; it must end by KeyboardInterrupt."""
        code = textwrap.dedent(
            """
            import stormproof
            fleet = {fleet}
            print("ready", flush=True)
            try:
                {work}
            except KeyboardInterrupt:
                print("interrupted", flush=True)
            """
        ).format(fleet=self.STORM, work=work)
        process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
        try:
            self.assertEqual(process.stdout.readline(), "ready\n")
            time.sleep(0.3)
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.communicate(timeout=60)[0], "interrupted\n")
            self.assertEqual(process.returncode, 0)
        finally:
            process.kill()

    def test_interrupt_of_runs(self):
        self.interrupted("stormproof.simulate(fleet, seeds=range(1000), start_jitter=1)")

    def test_interrupt_of_a_recording(self):
        self.interrupted("stormproof.record(fleet)")

    def test_interrupt_of_a_verb(self):
        self.interrupted("stormproof.tune('wifi-5x20-fastdds')")

    def test_interrupt_of_proofs(self):
        self.interrupted("stormproof.check('wifi-5x20')")


class Package(unittest.TestCase):
    def test_it_says_its_types(self):
        folder = pathlib.Path(stormproof.__file__).parent
        self.assertTrue((folder / "py.typed").is_file())
        stub = (folder / "_core.pyi").read_text(encoding="utf-8")
        from stormproof import _core

        for name in dir(_core):
            if not name.startswith("__"):
                self.assertRegex(stub, rf"\b{name}\b", f"{name} has no type")

    def test_every_verb_can_be_called(self):
        for verb in ("check", "conform", "diff", "doctor", "fix", "tune"):
            with self.assertRaises(stormproof.InputError):
                getattr(stormproof, verb)("/no/such/file.yaml", *(["paper"] if verb == "diff" else []))


if __name__ == "__main__":
    unittest.main()
