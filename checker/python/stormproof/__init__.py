"""Will these ROS 2 / DDS participants discover each other in time?

    import stormproof
    fleet = stormproof.scenario("wifi-5x20-fastdds")
    runs = stormproof.simulate(fleet, seeds=range(100))
    runs.pandas().completion.describe()

`simulate` and `record` call the simulator; `check`, `diff`, `conform`, `tune` and all other verbs are
those of the command line, with its options as keyword arguments, and return what it prints with
`--format json` (specs/guide/output.md). The guide is specs/guide/python.ipynb.
"""

from ._core import Scenario, __version__
from ._errors import InputError
from ._runs import Recording, Table, record, simulate
from ._scenarios import scenario
from ._verbs import check, conform, diff, doctor, fix, tune, verb

__all__ = [
    "InputError",
    "Recording",
    "Scenario",
    "Table",
    "__version__",
    "check",
    "conform",
    "diff",
    "doctor",
    "fix",
    "record",
    "scenario",
    "simulate",
    "tune",
    "verb",
]
