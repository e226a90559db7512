"""Where reads and writes come in the order of the text, if not where they stand in it."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.source_locations import Place


@contextmanager
def stored_after(
    machine: Machine, behind: object, value: ast.expr, frame: Frame
) -> Iterator[None]:
    """
    What is stored inside is stored where its value ends, if that was waited for.

    Code that is called to store it begins there in any case.
    """
    reading = machine.world.reading
    before = reading.waited, reading.value_end
    has_waited = machine.last_wait() != behind
    reading.value_end = frame.end_of(value)
    reading.waited = reading.value_end if has_waited else None
    try:
        yield
    finally:
        reading.waited, reading.value_end = before


class Asked:
    """
    Reads in what is called or awaited at ``place``: they come before what that waits for.

    The call stands in front of its arguments in the text, and so would all that it does.
    """

    def __init__(self, machine: Machine, place: Place) -> None:
        self.machine = machine
        self.place = place
        self.effects = machine.world.effects
        self.behind = machine.last_wait()
        self.begin = self.end = len(self.effects.reads) if self.effects is not None else 0

    def all_read(self) -> None:
        """The arguments are evaluated; what was read behind a wait in them is new."""
        if self.effects is not None and not self.has_waited():
            self.end = len(self.effects.reads)

    def has_waited(self) -> bool:
        """Whether there was a wait by now."""
        return self.machine.last_wait() != self.behind

    def done(self) -> None:
        """The call is over, or what was awaited is there."""
        effects, machine = self.effects, self.machine
        if effects is None or self.begin == self.end or not self.has_waited():
            return
        turn = (*machine.world.chain[1:], self.place)
        effects.reads[self.begin : self.end] = [
            replace(read, turn=read.turn or turn) for read in effects.reads[self.begin : self.end]
        ]
