"""Runs as tables: columns that numpy and pandas take without a copy."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Dict, Iterable, Iterator, Optional, Union

from . import _core
from ._core import Scenario
from ._scenarios import scenario as _scenario


class Table(Mapping):
    """Columns by name. Each has the buffer protocol, so numpy.asarray(table["completion"]) shares its
    memory. Columns of `words` are numbers of words: words["health"][table["health"][0]]."""

    def __init__(self, columns: Dict[str, Any], words: Mapping[str, list]) -> None:
        self._columns = columns
        self.words = {name: words[name] for name in columns if name in words}

    def __getitem__(self, name: str) -> Any:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    @property
    def rows(self) -> int:
        return len(next(iter(self._columns.values())))

    def __repr__(self) -> str:
        return f"<stormproof.Table {self.rows} rows: {', '.join(self)}>"

    def numpy(self) -> Dict[str, Any]:
        """Arrays by name, without a copy; read-only, as they are the table's."""
        import numpy

        arrays = {name: numpy.asarray(column) for name, column in self.items()}
        for array in arrays.values():
            array.flags.writeable = False
        return arrays

    def pandas(self) -> Any:
        """A DataFrame over the same memory; words become categories."""
        import pandas

        columns: Dict[str, Any] = self.numpy()
        for name, words in self.words.items():
            columns[name] = pandas.Categorical.from_codes(columns[name], categories=words)
        return pandas.DataFrame(columns, copy=False)


class Recording:
    """One run: `packets`, `transitions` and `progress` are tables, times in ns from the first start.
    `completion` is in seconds, or None if discovery did not complete."""

    def __init__(self, made: Dict[str, Any]) -> None:
        words = made.pop("words")
        self.packets = Table(made.pop("packets"), words)
        self.transitions = Table(made.pop("transitions"), words)
        self.progress = Table(made.pop("progress"), words)
        self.completion: Optional[float] = made["completion"]
        self.end: str = made["end"]
        self.messages: int = made["messages"]
        self.events: int = made["events"]

    def __repr__(self) -> str:
        when = "not complete" if self.completion is None else f"complete after {self.completion:.6f} s"
        return f"<stormproof.Recording {when}, {self.messages} messages>"


def _read(given: Union[str, Scenario]) -> Scenario:
    return given if isinstance(given, Scenario) else _scenario(given)


def simulate(
    scenario: Union[str, Scenario],
    *,
    seeds: Union[None, int, Iterable[int]] = None,
    start_jitter: float = 0.0,
    threads: int = 0,
) -> Table:
    """Runs a scenario once for each seed, on all cores, and returns a row for each.

    seeds         what is drawn (start times, losses) is drawn from these; None: the scenario's own
    start_jitter  seconds; each participant starts up to this much later
    threads       0: one for each core

    `completion` (s from the first start; NaN: not complete), `took` (s from the last start), messages
    by class, `needless` traffic over everything sent once, `busy` share of the channel, `health`.
    """
    if isinstance(seeds, int):
        seeds = [seeds]
    wanted = None if seeds is None else [int(seed) for seed in seeds]
    made = _core.simulate(_read(scenario), wanted, start_jitter, threads)
    return Table(made, {"health": _core.health_words})


def record(scenario: Union[str, Scenario], *, seed: Optional[int] = None) -> Recording:
    """One run with every packet and every transition of a machine."""
    return Recording(_core.record(_read(scenario), seed))
