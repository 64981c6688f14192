"""The verbs of the command line: the same work in this process, and its JSON as a dictionary."""

from __future__ import annotations

import contextlib
import json
import os
import tempfile
from typing import Any, Dict, Iterator, List, Union

from . import _core
from ._core import Scenario
from ._errors import InputError

Subject = Union[str, "os.PathLike[str]", Scenario]

_BAD_INPUT = 2


@contextlib.contextmanager
def _words(subject: Subject) -> Iterator[List[str]]:
    """How the command line names it; a scenario that is no file is one as long as the verb runs."""
    if not isinstance(subject, Scenario):
        yield [os.fspath(subject)]
        return
    overrides = [word for override in subject.overrides for word in ("--set", override)]
    if not subject.text:
        yield [subject.reference, *overrides]
        return
    with tempfile.TemporaryDirectory(prefix="stormproof-") as folder:
        path = os.path.join(folder, "scenario.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(subject.text)
        yield [path, *overrides]


def _options(options: Dict[str, Any]) -> List[str]:
    """max_memory="4GiB" → --max-memory 4GiB; True: the option alone; a list: once for each; `set` may
    be a dictionary."""
    words: List[str] = []
    for name, value in options.items():
        option = "--" + name.rstrip("_").replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            words.append(option)
            continue
        if isinstance(value, dict):
            value = [f"{key}={each}" for key, each in value.items()]
        each_value = value if isinstance(value, (list, tuple)) else [value]
        for each in each_value:
            words += [option, os.fspath(each) if isinstance(each, os.PathLike) else str(each)]
    return words


def verb(name: str, *subjects: Subject, **options: Any) -> Dict[str, Any]:
    """`stormproof NAME SUBJECT… --OPTION VALUE… --format json`, as a dictionary.

    Keys are those of specs/guide/output.md; "exit_code" says what the command line would end with.
    Raises InputError where it would refuse its input, with the place of the mistake.
    """
    with contextlib.ExitStack() as files:
        words = name.split()
        for subject in subjects:
            words += files.enter_context(_words(subject))
        code, printed, said = _core.run(words + _options(options) + ["--format", "json"])
    if code == _BAD_INPUT:
        raise InputError.of_complaint(said.decode("utf-8", "replace"))
    try:
        return json.loads(printed)
    except ValueError:
        raise RuntimeError(said.decode("utf-8", "replace") or f"no answer; exit code {code}") from None


def check(scenario: Subject, **options: Any) -> Dict[str, Any]:
    """Which guarantees hold: `stormproof check`."""
    return verb("check", scenario, **options)


def diff(base: Subject, candidate: Subject, **options: Any) -> Dict[str, Any]:
    """What a change of a DDS profile does: `stormproof diff`."""
    return verb("diff", base, candidate, **options)


def conform(*captures: Subject, **options: Any) -> Dict[str, Any]:
    """Whether captures follow the model: `stormproof conform`."""
    return verb("conform", *captures, **options)


def tune(scenario: Subject, **options: Any) -> Dict[str, Any]:
    """The best settings that a user can make: `stormproof tune`."""
    return verb("tune", scenario, **options)


def fix(scenario: Subject, **options: Any) -> Dict[str, Any]:
    """What cures a deployment: `stormproof fix`."""
    return verb("fix", scenario, **options)


def doctor(*captures: Subject, **options: Any) -> Dict[str, Any]:
    """Who is there, is it a storm, and why: `stormproof doctor`."""
    return verb("doctor", *captures, **options)
