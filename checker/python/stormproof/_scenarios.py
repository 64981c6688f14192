"""Scenarios by name, file, text or keyword arguments."""

from __future__ import annotations

import json
import os
from typing import Any, Mapping, Optional, Union

from ._core import Scenario


def _text(value: Any) -> str:
    """A value as an override has it: JSON, which is YAML; a plain text as it is."""
    return value if isinstance(value, str) else json.dumps(value)


def scenario(
    source: Union[None, str, "os.PathLike[str]", Scenario] = None,
    *,
    text: Optional[str] = None,
    set: Optional[Mapping[str, Any]] = None,
    **keys: Any,
) -> Scenario:
    """A scenario, as the command line would read it.

    source  name of a shipped one ("wifi-5x20") or path of a file; a Scenario to change by `set`
    text    YAML or JSON instead
    keys    the keys of a scenario file instead: deployment={"hosts": 2, …}, dds="humble", …
    set     overrides by path: {"dds.sedp.heartbeat_period": "1s"}; `--set` of the command line

    Raises InputError with file, line and column of the mistake.
    """
    given = sum([source is not None, text is not None, bool(keys)])
    if given != 1:
        raise TypeError("expected one of a name or path, text=…, or keys of a scenario")
    overrides = [f"{path}={_text(value)}" for path, value in (set or {}).items()]
    if isinstance(source, Scenario):
        overrides = source.overrides + overrides
        if source.text:
            return Scenario.parse(source.text, source.reference, overrides)
        return Scenario.read(source.reference, overrides)
    if source is not None:
        return Scenario.read(os.fspath(source), overrides)
    if text is not None:
        return Scenario.parse(text, "<text>", overrides)
    return Scenario.parse(json.dumps(keys, indent=1), "<keys>", overrides)
