"""
Which thread goes on next: the policies of a schedule.

Random priorities are those of PCT (Burckhardt, Kothari, Musuvathi, Nagarakatte: A Randomized
Scheduler with Probabilistic Guarantees of Finding Bugs, ASPLOS 2010): each activity gets a random
priority, the highest one goes on, and at depth - 1 steps, chosen at random among as many as the
schedule is expected to have, the thread about to go on falls below all others. Bounded preemption
is that of CHESS (Musuvathi, Qadeer: Iterative Context Bounding, PLDI 2007).

Runs inside the user's process: the standard library only.
"""

from __future__ import annotations

import random
import time
from collections.abc import Sequence
from typing import Any, Protocol

BEGIN = 'begin'
"""Where a callback stands that its group is asked for."""
# In a replay: how long to wait for a due candidate. Slow timers have a second.
PATIENCE_S = 1.6


class Candidate(Protocol):
    """A thread or callback that may go on."""

    @property
    def key(self) -> str:
        """Names the activity: its callback, and which run of it in this schedule."""

    @property
    def at(self) -> str:
        """Where it stands: ``begin``, or file, line and what it is about to do."""


class Policy(Protocol):
    """Chooses; the same candidates in the same order give the same choice for one seed."""

    def choose(self, candidates: Sequence[Candidate], last: str) -> Candidate | None:
        """
        Choose the candidate that goes on; `None` to wait for another one.

        :param candidates: at least one, in the order of their keys.
        :param last: the key of the one that went on before.
        """

    @property
    def is_over(self) -> bool:
        """Whether all threads may go on from now on."""


class Priorities:
    """PCT."""

    is_over = False

    def __init__(self, seed: str, depth: int, steps: int) -> None:
        self._seed = seed
        self._known: dict[str, float] = {}
        places = random.Random(seed)
        self._falls = {places.randrange(1, max(2, steps)) for _ in range(depth - 1)}
        self._lowest = 0.0
        self._step = 0

    def choose(self, candidates: Sequence[Candidate], last: str) -> Candidate | None:
        self._step += 1
        best = max(candidates, key=self._priority)
        if self._step in self._falls:
            self._lowest -= 1.0
            self._known[best.key] = self._lowest
            best = max(candidates, key=self._priority)
        return best

    def _priority(self, candidate: Candidate) -> float:
        key = candidate.key
        if key not in self._known:
            # By name, so that it does not depend on which comes first.
            self._known[key] = random.Random(f'{self._seed}/{key}').random()
        return self._known[key]


class RandomWalk:
    """Each choice at random."""

    is_over = False

    def __init__(self, seed: str) -> None:
        self._random = random.Random(seed)

    def choose(self, candidates: Sequence[Candidate], last: str) -> Candidate | None:
        return self._random.choice(candidates)


class FewPreemptions:
    """The current thread goes on, except at a few steps, chosen at random."""

    is_over = False

    def __init__(self, seed: str, bound: int, steps: int) -> None:
        self._random = random.Random(seed)
        self._switches = {self._random.randrange(1, max(2, steps)) for _ in range(bound)}
        self._step = 0

    def choose(self, candidates: Sequence[Candidate], last: str) -> Candidate | None:
        self._step += 1
        own = next((each for each in candidates if each.key == last), None)
        others = [each for each in candidates if each.key != last]
        if own is not None and (self._step not in self._switches or not others):
            return own
        return self._random.choice(others)


class Recorded:
    """
    The choices of a recorded schedule, in their order.

    Runs of one callback are alike: which of them goes on is not recorded. One that is due but does
    not come in time is left out, as another process may have begun elsewhere.

    :param ends_at_miss: all go on from the first one that does not come in time.
    """

    def __init__(self, choices: Sequence[Sequence[str]], *, ends_at_miss: bool = False) -> None:
        self._left = [(callback_of(key), at) for key, at in choices]
        self._since = time.monotonic()
        self._ends_at_miss = ends_at_miss
        self.left_out = 0

    @property
    def is_over(self) -> bool:
        return not self._left

    def choose(self, candidates: Sequence[Candidate], last: str) -> Candidate | None:
        while self._left:
            found = self._due(candidates)
            if found is not None:
                self._left.pop(0)
                self._since = time.monotonic()
                return found
            if time.monotonic() - self._since < PATIENCE_S:
                return None
            del self._left[: len(self._left) if self._ends_at_miss else 1]
            self.left_out += 1
            self._since = time.monotonic()
        return candidates[0]

    def _due(self, candidates: Sequence[Candidate]) -> Candidate | None:
        due = self._left[0]
        return next((c for c in candidates if (callback_of(c.key), c.at) == due), None)


class Prefix:
    """
    Fixed first choices, then the current thread goes on: one leaf of a depth-first search.

    :param steps: after so many choices it is over.
    """

    def __init__(self, choices: Sequence[Sequence[str]], steps: int) -> None:
        self._left = [(str(key), str(at)) for key, at in choices]
        self._steps = steps
        self._since = time.monotonic()

    @property
    def is_over(self) -> bool:
        return self._steps <= 0

    def choose(self, candidates: Sequence[Candidate], last: str) -> Candidate | None:
        found = next((each for each in candidates if each.key == last), candidates[0])
        if self._left:
            due = next((each for each in candidates if (each.key, each.at) == self._left[0]), None)
            if due is None:
                if time.monotonic() - self._since > PATIENCE_S:
                    self._steps = 0  # the program does not do the same again
                return None
            found = due
            self._left.pop(0)
        self._since = time.monotonic()
        self._steps -= 1
        return found


def callback_of(key: str) -> str:
    """The key without the number of the run."""
    return key.rpartition('#')[0] or key


def policy_of(row: dict[str, Any]) -> Policy:
    """
    Make the policy of a schedule.

    :raises KeyError, ValueError, TypeError: where it is none.
    """
    kind, seed = str(row['policy']), str(row.get('seed', 0))
    steps, depth = int(row.get('steps', 40)), int(row.get('depth', 2))
    if kind == 'pct':
        return Priorities(seed, depth, steps)
    if kind == 'random':
        return RandomWalk(seed)
    if kind == 'preemptions':
        return FewPreemptions(seed, depth, steps)
    if kind == 'recorded':
        return Recorded(row['choices'], ends_at_miss=bool(row.get('ends_at_miss')))
    if kind == 'prefix':
        return Prefix(row['choices'], steps)
    raise ValueError(f'{kind} is no policy')
