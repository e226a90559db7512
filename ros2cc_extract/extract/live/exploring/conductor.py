"""
Runs one schedule after the other in this process, and looks at it where it comes to a stop.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import random
import sys
import threading
import time
from collections.abc import Callable
from typing import Any

from ..hang_analysis import probe
from ..steering.surroundings import Surroundings
from .control import Control
from .policies import policy_of

PLAIN = 'plain'
"""The policy of a schedule in which everything goes on as it comes."""
RECORDED, PREFIX = 'recorded', 'prefix'
# How long others that may be ready soon are waited for before a round; of each schedule one.
GATHERS_S = (0.02, 0.12, 0.12, 0.5)
TICK_S, RESTS_S = 0.004, 0.4
# A callback that has not ended so long after its schedule stands, as far as is known.
STANDS_S = 0.7
LOOKS_APART_S = 1.0
MOST_LOOKS, LOOKS_AT_IDLENESS = 7, 4
Write = Callable[..., None]


class Limits:
    """
    When a schedule is over.

    :param rounds: how often all threads have come to their ends; 0 for no such limit.
    """

    def __init__(self, row: dict[str, Any]) -> None:
        self.seconds = float(row.get('seconds', 1.5))
        self.steps = int(row.get('steps', 300))
        self.rounds = int(row.get('rounds', 3))


class Conductor:
    """
    :param write: writes a row of the report.
    """

    def __init__(self, control: Control, write: Write, limits: Limits) -> None:
        self._control = control
        self._write = write
        self._limits = limits
        self._explained: set[int] = set()
        self._idleness_is_explained = False
        self.schedule = 0

    def wait_for(self, surroundings: Surroundings) -> None:
        """Hold everything until what the node meets is there, and a schedule begins."""
        self._control.hold_all()
        while not surroundings.are_ready():
            time.sleep(0.02)

    def run(self, row: dict[str, Any]) -> None:
        """
        Run one schedule: take control, let go, and look where threads stand.

        :raises KeyError, ValueError, TypeError: where the row is no schedule.
        """
        self.begin(row)
        until = time.monotonic() + float(row.get('seconds', self._limits.seconds))
        while time.monotonic() < until and not self._is_over(row):
            time.sleep(TICK_S)
            self._control.look_at_the_clock()
        self.end()
        self._look_while_it_stands()
        self._write('done', schedule=self.schedule)

    def begin(self, row: dict[str, Any]) -> None:
        self.schedule = int(row['number'])
        self._write('schedule', schedule=self.schedule)
        if row['policy'] == PLAIN:
            self._control.watch()
        else:
            self._come_to_rest()
            gather = random.Random(f'gather/{row.get("seed", 0)}').choice(GATHERS_S)
            gather_s, once = float(row.get('gather_s', gather)), row['policy'] == PREFIX
            self._control.take(policy_of(row), gather_s, once=once)

    def _come_to_rest(self) -> None:
        """Let what is at work come to its end, so that all begins are of the schedule."""
        self._control.hold_all()
        until = time.monotonic() + RESTS_S
        while not self._control.is_quiet and time.monotonic() < until:
            time.sleep(TICK_S)

    def end(self) -> None:
        control = self._control
        control.let_go()
        self._write('choices', **self.so_far(), choosable=control.choosable, begins=control.begins)

    def so_far(self) -> dict[str, Any]:
        """What was chosen in this schedule."""
        control = self._control
        return {
            'schedule': self.schedule,
            'choices': list(control.choices),
            'rounds': list(control.rounds),
        }

    def _is_over(self, row: dict[str, Any]) -> bool:
        control = self._control
        if row['policy'] in (PLAIN, RECORDED):
            return control.is_over
        if row['policy'] == PREFIX:
            return control.is_over or control.is_exhausted
        enough = 0 < self._limits.rounds < len(control.rounds) and control.is_quiet
        return control.is_over or len(control.choices) >= self._limits.steps or enough

    def _look_while_it_stands(self) -> None:
        """Look again and again, as long as something that has begun does not come to its end."""
        since = time.monotonic()
        while time.monotonic() - since < STANDS_S:
            if not self._standing() and (self._control.begins or self._idleness_is_explained):
                return
            time.sleep(0.02)
        before = self._standing()
        for _ in range(MOST_LOOKS if before else LOOKS_AT_IDLENESS):
            self._write(
                'looks', schedule=self.schedule, looks=look_twice(), running=sorted(before)
            )
            time.sleep(LOOKS_APART_S - probe.APART_S)
            if before and not (before := before & self._standing()):
                return
        self._explained |= before
        self._idleness_is_explained = True
        if before:
            self._write('stands', schedule=self.schedule, running=sorted(before))

    def _standing(self) -> set[int]:
        return set(self._control.running) - self._explained


def look_twice() -> list[dict[str, Any]]:
    """Two looks at this process, as ``why`` compares them."""
    looks = [probe.look()]
    time.sleep(probe.APART_S)
    looks.append(probe.look())
    return looks


def conducted(control: Control, conductor: Conductor, run: Callable[[], None]) -> threading.Thread:
    """Run schedules in a thread of their own, which never outlives the program."""

    def work() -> None:
        sys.settrace(None)  # this thread is not of the program
        try:
            run()
        finally:
            control.let_go()

    thread = threading.Thread(target=work, name='ros2cc schedules', daemon=True)
    thread.start()
    return thread
