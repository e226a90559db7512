"""
Decides whether a sequence of observations is a path of a model.

The model takes steps that are not observed; and observations of different threads may stand in the
trace in another order than they happened. So paths are searched, depth first, in the order of
the clock as long as that will do; begins and ends in one exclusive group never stand in another
order. What arrives is only made to arrive when it is collected:
more of it would allow nothing more.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import field
from enum import Enum
from math import inf

from ros2cc_extract.conform.observable_model import Move, ObservedModel
from ros2cc_extract.conform.observations import Act, Observation
from ros2cc_extract.light_dataclasses import dataclass

#: How far observations of different threads may be out of order, in time and past how many others:
#: tried one after the other.
SLACKS = ((0, 0), (1_000_000, 3), (20_000_000, 6))
PASSED = max(passed for _, passed in SLACKS)
#: States looked at before the question stays open.
STATES = 100_000


class Outcome(Enum):
    """Whether the execution is a path of the model."""

    CONFORMS = 'conforms'
    DIVERGES = 'diverges'
    UNDECIDED = 'undecided'


@dataclass(frozen=True, kw_only=True)
class Answer:
    """
    What came of a search.

    :param steps: how many observations were followed at most.
    :param path: those, in the order in which the model took them.
    :param states: where the model can be after them, packed.
    :param next: the observation that no path goes on with, by the clock.
    :param reordered_ns: how far observations of different threads had to be moved.
    :param seen: how many states were looked at.
    """

    outcome: Outcome
    steps: int
    path: tuple[Observation, ...]
    states: tuple[int, ...]
    next: Observation | None
    reordered_ns: int
    seen: int


#: How many observations of each thread are behind us.
Positions = tuple[int, ...]


@dataclass(eq=False)
class _Node:
    positions: Positions
    packed: int
    parent: _Node | None
    observation: Observation | None


def conform(
    model: ObservedModel, observations: Sequence[Observation], *, states: int = STATES
) -> Answer:
    """Search for a path of ``model`` that shows ``observations``."""
    answer = None
    threads = {each.thread for each in observations if not _has_arrived(each)}
    for slack_ns, passed in SLACKS if len(threads) > 1 else SLACKS[:1]:
        answer = _Search(model, observations, slack_ns, passed, states).run()
        if answer.outcome is not Outcome.DIVERGES:
            return answer
    assert answer is not None
    return answer


@dataclass(eq=False)
class _Search:
    model: ObservedModel
    observations: Sequence[Observation]
    slack_ns: int
    passed: int
    limit: int
    _threads: list[list[Observation]] = field(init=False)
    _clocks: list[list[int]] = field(init=False)
    _deepest: list[_Node] = field(default_factory=list)
    _depth: int = -1

    def __post_init__(self) -> None:
        by_thread: dict[int, list[Observation]] = {}
        for observation in self.observations:
            by_thread.setdefault(observation.thread, []).append(observation)
        self._threads = list(by_thread.values())
        self._clocks = [[each.clock_ns for each in thread] for thread in self._threads]

    def run(self) -> Answer:
        root = _Node((0,) * len(self._threads), self.model.initial(), None, None)
        seen = {(root.positions, root.packed)}
        stack = [iter((root,))]
        while stack:
            node = next(stack[-1], None)
            if node is None:
                stack.pop()
                continue
            depth = sum(node.positions)
            self._note(node, depth)
            if depth == len(self.observations):
                return self._answer(Outcome.CONFORMS, len(seen))
            if len(seen) > self.limit:
                return self._answer(Outcome.UNDECIDED, len(seen))
            stack.append(self._children(node, seen))
        return self._answer(Outcome.DIVERGES, len(seen))

    def _children(self, node: _Node, seen: set[tuple[Positions, int]]) -> Iterator[_Node]:
        for thread, observation in self._candidates(node.positions):
            positions = tuple(at + (number == thread) for number, at in enumerate(node.positions))
            for target in follow(self.model, node.packed, observation):
                key = positions, target
                if key not in seen:
                    seen.add(key)
                    yield _Node(positions, target, node, observation)

    def _candidates(self, positions: Positions) -> list[tuple[int, Observation]]:
        """What may come next, by the clock: the next of each thread that is near enough."""
        heads = [
            (number, thread[at])
            for number, (thread, at) in enumerate(zip(self._threads, positions, strict=True))
            if at < len(thread)
        ]
        if not heads:
            return []
        heads.sort(key=lambda head: head[1].clock_ns)
        first = heads[0][1].clock_ns
        # What has arrived is there, even if threads report other steps late.
        arrived = min((each.clock_ns for _, each in heads if _has_arrived(each)), default=inf)
        return [
            head
            for head in heads
            if head[1].clock_ns == first
            or (head[1].earliest_ns <= arrived and self._may_pass(head[1], first, positions))
        ]

    def _may_pass(self, observation: Observation, first_ns: int, positions: Positions) -> bool:
        """Whether it may have happened before others that stand before it."""
        if observation.earliest_ns > first_ns + self.slack_ns:
            return False
        passed = list(self._passed(observation.clock_ns, positions))
        if observation.group and any(each.group == observation.group for each in passed):
            return False
        return observation.earliest_ns < observation.clock_ns or len(passed) <= self.passed

    def _passed(self, clock_ns: int, positions: Positions) -> Iterator[Observation]:
        """What stands before a clock and was not followed yet."""
        for thread, clocks, at in zip(self._threads, self._clocks, positions, strict=True):
            yield from thread[at : bisect_left(clocks, clock_ns)]

    def _note(self, node: _Node, depth: int) -> None:
        if depth > self._depth:
            self._depth, self._deepest = depth, []
        if depth == self._depth:
            self._deepest.append(node)

    def _answer(self, outcome: Outcome, seen: int) -> Answer:
        node: _Node | None = self._deepest[0]
        rest = self._candidates(self._deepest[0].positions)
        path: list[Observation] = []
        while node is not None and node.observation is not None:
            path.append(node.observation)
            node = node.parent
        path.reverse()
        return Answer(
            outcome=outcome,
            steps=self._depth,
            path=tuple(path),
            states=tuple(dict.fromkeys(node.packed for node in self._deepest)),
            next=rest[0][1] if rest else None,
            reordered_ns=_reordered_ns(path),
            seen=seen,
        )


def _reordered_ns(path: Sequence[Observation]) -> int:
    """How long after others a step was reported that a path has before them."""
    most, first_ns = 0, path[-1].clock_ns if path else 0
    for each in reversed(path):
        most = max(most, each.earliest_ns - first_ns)
        first_ns = min(first_ns, each.clock_ns)
    return most


def _has_arrived(observation: Observation) -> bool:
    return observation.act is Act.ARRIVE and not observation.is_task


def follow(model: ObservedModel, packed: int, observation: Observation) -> Iterator[int]:
    """Give the states after an observation, with as few steps before it as possible first."""
    wanted = observation.found
    begins = observation.act is Act.BEGIN and not observation.has_arrived
    if not model.has_waits and begins and observation.callback is not None:
        wanted = frozenset({observation.callback})
    states: Iterable[int] = unseen(model, packed, wanted)
    if observation.act is Act.WAKE and model.has_tasks:
        # A spin hands over all tasks before it waits; the model would do with one of a kind.
        states = sorted(states, key=model.unserved_tasks)
    for state in states:
        if observation.act is Act.WAKE and not _are_waiting(model, state, observation.found):
            continue
        for move in model.moves(state):
            if _shows(move, observation):
                yield move.target


def _are_waiting(model: ObservedModel, packed: int, callbacks: frozenset[int]) -> bool:
    return all(model.is_waiting(packed, callback) for callback in callbacks)


def unseen(model: ObservedModel, packed: int, wanted: frozenset[int]) -> Iterator[int]:
    """
    Give the states that can be reached without being seen, nearest first.

    :param wanted: places of callbacks for which something must arrive.
    """
    todo = _sooner_or_later(model, packed, wanted)
    found = set(todo)
    for state in todo:
        yield state
        for move in model.moves(state):
            if _is_unseen(model, state, move):
                for target in _sooner_or_later(model, move.target, wanted):
                    if target not in found:
                        found.add(target)
                        todo.append(target)


def _sooner_or_later(model: ObservedModel, packed: int, wanted: frozenset[int]) -> list[int]:
    """Let arrive what is wanted; a nested spin asks unseen, and its own answer comes later."""
    arrived = _arrivals(model, packed, wanted)
    return list(dict.fromkeys((*arrived, packed))) if model.has_nested_spins else arrived


def _arrivals(model: ObservedModel, packed: int, wanted: frozenset[int]) -> list[int]:
    """
    Let arrive what is wanted and can; arrivals do not interact, so in any order.

    Where something can arrive that was sent as well as something else, what was sent is first.
    """
    states = [packed]
    for callback in sorted(wanted):
        if not model.is_waiting(packed, callback):
            states = [after for state in states for after in _arrive(model, state, callback)]
    return states


def _arrive(model: ObservedModel, packed: int, callback: int) -> list[int]:
    moves = [m for m in model.moves(packed) if m.act is Act.ARRIVE and m.callback == callback]
    return [move.target for move in reversed(moves)] or [packed]


def _is_unseen(model: ObservedModel, packed: int, move: Move) -> bool:
    if move.taken:
        return False
    if move.act is Act.COLLECT:
        return move.callback is not None and model.collects_unseen(packed, move.callback)
    return move.act is None


def _shows(move: Move, observation: Observation) -> bool:
    if observation.act is Act.PAUSE:
        fits = move.act in (Act.END, Act.SUSPEND)
    elif observation.act is Act.BEGIN and observation.is_task:
        fits = move.act in (Act.BEGIN, Act.RESUME)
    else:
        fits = move.act is observation.act
    if not fits or (observation.callback is not None and move.callback != observation.callback):
        return False
    if observation.act is Act.BEGIN:
        return not observation.takes or observation.callback in move.taken
    return not move.taken
