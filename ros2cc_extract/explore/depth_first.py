"""
All orders of the first steps of a small node, up to the order of independent steps.

A depth-first search over schedules, each of them a process of its own, with sleep sets (Godefroid,
Partial-Order Methods for the Verification of Concurrent Systems, LNCS 1032, 1996): what was tried
first at a branch is not tried again below another one, until a step that depends on it. Two steps
depend on each other where they are of one activity, access the same shared data and one of them
writes, wait for the same lock, or begin callbacks of one exclusive group; what waits for anything
else than a lock depends on every step.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import field

from ros2cc_extract.explore.exploring import Budget, Exploration, note
from ros2cc_extract.explore.scenario import Row
from ros2cc_extract.explore.watching import Process, Seen
from ros2cc_extract.extract.live.exploring.policies import BEGIN, callback_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.model import Activity, Callback, GroupType, Spec

Step = tuple[str, str]
"""The key of an activity, and where it stands."""
# On a busy machine a message or a thread may be late. A run that strays says nothing, so it is
# repeated this often.
_MOST_REPEATED = 3
# For all that may be ready soon: a timer of a second has to come first.
GATHERS_S, SECONDS = 1.3, 6.0


@dataclass(frozen=True)
class Dependence:
    """
    :param groups: the group of each callback by the name of its function; one in a re-entrant
        group has a name for itself. What has none depends on every begin.
    :param locks: names of waits that are locks.
    """

    groups: Mapping[str, str] = field(default_factory=dict)
    locks: Collection[str] = ()

    def depend(self, one: Step, other: Step) -> bool:
        """Whether the order of two steps may matter."""
        if one[0] == other[0]:
            return True
        (kind, name), (other_kind, other_name) = _does(one[1]), _does(other[1])
        if BEGIN in (kind, other_kind):
            own, others = self._group(one[0]), self._group(other[0])
            return kind == other_kind and (None in (own, others) or own == others)
        if 'wait' in (kind, other_kind):
            if not {n for k, n in ((kind, name), (other_kind, other_name)) if k == 'wait'} <= set(
                self.locks
            ):
                return True
            # Releasing a lock is no step: the thread that waits for it goes on then.
            return (kind, name) == (other_kind, other_name)
        return name == other_name and 'write' in (kind, other_kind)

    def _group(self, key: str) -> str | None:
        return self.groups.get(callback_of(key).partition(' (')[0])


def dependence_of(units: Iterable[Spec]) -> Dependence:
    """Read from specifications which callbacks exclude each other, and which waits are locks."""
    groups: dict[str, set[str]] = {}
    locks: set[str] = set()
    for unit in units:
        for callback in unit.callbacks:
            exclusive = unit.group_of(callback).type is GroupType.EXCLUSIVE
            name = f'{unit.name}.{callback.group if exclusive else callback.name}'
            groups.setdefault(callback.display_name, set()).add(name)
        doers: tuple[Callback | Activity, ...] = (*unit.callbacks, *unit.activities)
        locks |= {a.name for each in doers for a in each.locks if isinstance(a.name, str)}
    # One function in several groups: it is not known in which of them it begins.
    known = {name: found.pop() for name, found in groups.items() if len(found) == 1}
    return Dependence(known, frozenset(locks))


def _does(at: str) -> tuple[str, str]:
    if at == BEGIN:
        return BEGIN, ''
    _, kind, name = [*at.split(' ', 2), '', ''][:3]
    return kind, name


@dataclass
class _Branch:
    """
    A moment at which a thread was chosen.

    :param enabled: those that could be chosen.
    :param sleeping: those that need not be chosen.
    """

    enabled: tuple[Step, ...]
    chosen: Step
    sleeping: frozenset[Step]


@dataclass
class Search:
    """
    How far a search has come.

    :param runs: processes; ``distinct`` of them had an order of their own.
    :param strayed: prefixes that the program did not repeat, however often it was run.
    :param cut: runs that went on after their last step.
    :param expected: callbacks that had begun when the program ran as it comes.
    """

    steps: int
    expected: frozenset[str] = frozenset()
    runs: int = 0
    distinct: int = 0
    strayed: int = 0
    cut: int = 0
    is_over: bool = False
    _begun: set[str] = field(default_factory=set)

    def has_met_all(self, steps: Iterable[Sequence[Step]]) -> bool:
        """Note which callbacks could be chosen; whether these were all that are expected."""
        met = {callback_of(key) for each in steps for key, _ in each}
        self._begun |= met
        return self.expected <= met

    @property
    def words(self) -> str:
        """What was explored, and no more."""
        what = f'first {self.steps} steps' if self.cut else 'first run of each callback'
        if not self.is_over:
            return f'not complete: {self.distinct} orders of the {what} were run'
        never = ', '.join(sorted(self.expected - self._begun))
        if never:
            return f'not complete: {self.distinct} orders were run, and {never} did not begin'
        if self.strayed:
            return (
                f'not complete: {self.distinct} orders of the {what} were run, and the program '
                f'did not repeat {self.strayed} of them in {1 + _MOST_REPEATED} runs each'
            )
        return (
            f'complete: all {self.distinct} orders of the {what}, up to the order of steps that '
            'are independent as far as the source names what they share, for the messages of '
            'these runs'
        )


def search(
    run: Callable[[Sequence[Row]], Process],
    dependence: Dependence,
    search_: Search,
    budget: Budget,
    into: Exploration,
    progress: Callable[[Exploration], None] = lambda so_far: None,
) -> None:
    """
    Run schedules depth first, until all are run or the budget is used up.

    :param search_: is filled as it goes, as ``into`` is.
    """
    path: list[_Branch] = []
    repeated = 0
    while not into.why_ended:
        if into.done >= budget.schedules:
            into.why_ended = 'all schedules of the budget were run'
        elif time.monotonic() > budget.deadline:
            into.why_ended = 'the time is over'
        else:
            process = run([_row(into.done + 1, path, search_.steps)])
            note(process, into)
            progress(into)
            if not process.schedules:
                into.why_ended = 'the program did not get to a schedule'
                return
            if into.found and budget.only_first:
                into.why_ended = 'a failure was found'
                return
            may_repeat = repeated < _MOST_REPEATED
            follows = _meets(path, process.schedules[0], search_) or not may_repeat
            follows = follows and _follow(path, process.schedules[0], dependence, search_)
            if not follows and may_repeat:
                repeated += 1
                continue
            search_.strayed += not follows
            repeated = 0
            if not _next(path, dependence):
                search_.is_over = True
                into.why_ended = 'there are no other orders'


def _row(number: int, path: Sequence[_Branch], steps: int) -> Row:
    return {
        'number': number,
        'policy': 'prefix',
        'choices': [list(each.chosen) for each in path],
        'steps': steps,
        'gather_s': GATHERS_S,
        'seconds': SECONDS,
    }


def _meets(path: Sequence[_Branch], seen: Seen, search_: Search) -> bool:
    """Whether a first run has met all callbacks that it may, unless something goes wrong in it."""
    search_.runs += 1
    has_met_all = search_.has_met_all(seen.choosable)
    return bool(path) or has_met_all or bool(seen.failures)


def _follow(path: list[_Branch], seen: Seen, dependence: Dependence, search_: Search) -> bool:
    """
    Add the moments that the run has come to behind the prefix that it was given.

    :return: whether it has followed the prefix. More may be ready than in an earlier run: then
        that is tried too.
    """
    given = len(path)
    steps = list(zip(seen.choices, seen.choosable, strict=True))
    if len(steps) < given or not all(map(_is_repeated, path, steps)):
        return False
    search_.cut += len(steps) >= search_.steps
    for branch, (_, enabled) in zip(path, steps, strict=False):
        branch.enabled = tuple(enabled)
    for chosen, enabled in steps[given:]:
        sleeping = _asleep_after(path, dependence)
        if chosen in sleeping:
            return True  # the same, but for independent steps, as a run before
        path.append(_Branch(tuple(enabled), chosen, sleeping))
    search_.distinct += 1
    return True


def _is_repeated(branch: _Branch, step: tuple[Step, Sequence[Step]]) -> bool:
    chosen, enabled = step
    return chosen == branch.chosen and set(branch.enabled) <= set(enabled)


def _asleep_after(path: Sequence[_Branch], dependence: Dependence) -> frozenset[Step]:
    if not path:
        return frozenset()
    last = path[-1]
    return frozenset(each for each in last.sleeping if not dependence.depend(each, last.chosen))


def _next(path: list[_Branch], dependence: Dependence) -> bool:
    """Change to the last branch that has another step to try; whether there is one."""
    while path:
        last = path.pop()
        tried = last.sleeping | {last.chosen}
        left = [each for each in last.enabled if each not in tried]
        if left:
            path.append(_Branch(last.enabled, left[0], tried))
            return True
    return False
