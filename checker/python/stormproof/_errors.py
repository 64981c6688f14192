"""What is raised for bad input: the place of the mistake and what was expected, taken apart."""

from __future__ import annotations

import re
from typing import Optional

_PLACE = re.compile(r"(?P<file>.*):(?P<line>\d+):(?P<column>\d+)", re.DOTALL)


class InputError(ValueError):
    """Something that the user wrote is refused; the text is the one of the command line.

    where     "file:line:column", a file, an option, or ""
    file, line, column   of `where`, if it has them; they count from 1
    message   the offending value and what was expected
    expected  the part of the message that says so, or None
    """

    def __init__(self, where: str, message: str) -> None:
        super().__init__(f"{where}: {message}" if where else message)
        self.where = where
        self.message = message
        place = _PLACE.fullmatch(where)
        self.file: Optional[str] = place["file"] if place else None
        self.line: Optional[int] = int(place["line"]) if place else None
        self.column: Optional[int] = int(place["column"]) if place else None
        before, word, after = message.partition("expected ")
        self.expected: Optional[str] = after if word else None

    def __reduce__(self):
        return type(self), (self.where, self.message)

    @classmethod
    def of_complaint(cls, said: str) -> "InputError":
        """Of a line "stormproof: where: message" on standard error, the last one."""
        complaints = said.split("stormproof: ")
        text = complaints[-1].rstrip("\n")
        found = re.match(r"(.+?:\d+:\d+): (.*)", text, re.DOTALL)
        return cls(found[1], found[2]) if found else cls("", text)
