"""
Slices of a unit: for a question, the callbacks that can make a difference to its answer.

A slice is a unit of its own, with the same executor. A run of it is a run of the whole unit in
which the others get no data; and what the whole unit does to the callbacks of a slice, the slice
does too, as docs/profile-rclpy.md (*Slices*) argues. Where that does not hold there is no slice.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from enum import Enum
from functools import cached_property

from ros2cc_extract.generator.build import Family, Query
from ros2cc_extract.generator.executor_kinds import ExecutorKind, executor_kind, runs_of_an_arrival
from ros2cc_extract.generator.nested_spins import Refusal, SpinEnd, Spun
from ros2cc_extract.generator.program_steps import WaitKind
from ros2cc_extract.generator.waits import asks_the_graph, is_absent, waits_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.client_server_pairs import (
    client_before,
    is_client,
    is_done_callback,
    server_of,
)
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.model import Callback, Spec
from ros2cc_extract.verify.slices.slice_shapes import (
    Facts,
    Outline,
    Setting,
    facts_of,
    outline,
    outline_of,
    setting_of,
)
from ros2cc_extract.verify.slices.wait_relations import Names, WaitRelations, without_signals

#: Claims that rest on others coming to an end, and on a free thread.
OF_ENDS = (Family.STARVATION, Family.PROGRESS)
#: Claims about what a run ends in.
OF_STANDSTILLS = (Family.DEADLOCK, Family.POOL_EXHAUSTION)
#: Claims about all callbacks at once.
OF_THE_UNIT = (*OF_STANDSTILLS, Family.SERIAL)


class Rests(Enum):
    """What a claim about a callback rests on."""

    ON_RUNS = 'what it does when it runs'
    ON_START = 'that it comes to run'
    ON_END = 'that it comes to its end'


@dataclass(frozen=True)
class Slicer:
    """Slices of one unit whose callbacks get at most ``max_cycle`` arrivals each."""

    closed: ClosedSpec
    max_cycle: int

    def slice_for(self, query: Query) -> Names | None:
        """
        Name the callbacks that ``query`` depends on; ``None`` where all of them may matter.

        What depends on activities beside the executor is asked of the whole unit.
        """
        if not self._of.by_name.keys() >= set(query.callbacks):
            return None
        names = self._names_for(query)
        return names if names is not None and names <= self._of.by_name.keys() else None

    def _names_for(self, query: Query) -> Names | None:
        if self._has_spins_of_the_unit:
            return None
        if query.family in (*OF_ENDS, *OF_STANDSTILLS) and not self.has_threads_to_spare:
            return self._with_all_that_wait(query) if self._spinning else None
        if query.family in OF_THE_UNIT:
            return None
        if query.family not in OF_ENDS:
            names = (*query.callbacks, *self._closers(query), *self._spinning)
            return frozenset().union(*map(self._cone_of_runs, names))
        rests = Rests.ON_END if query.family is Family.PROGRESS else Rests.ON_START
        return self._cone(query.callbacks, rests)

    def _with_all_that_wait(self, query: Query) -> Names | None:
        """
        Add all that wait: nothing else keeps a thread, a group or the executor forever.

        Not where a callback that waits for nothing may end a wait: any that runs ends a
        ``spin_once``, and wakes a coroutine whose future a thread of the user has made done.
        """
        waits = [wait for waits in self._of.waits.values() for wait in waits]
        if any(wait.kind is WaitKind.FOREIGN for wait in waits) or any(
            wait.spin.end is SpinEnd.ONE_CALLBACK for wait in waits if wait.spin
        ):
            return None
        names = self._cone((*self.waiting, *query.callbacks), Rests.ON_END)
        if not names <= self._of.by_name.keys():
            return None
        threads = self.cut(names).spec.executor.threads
        is_full = len(threads) == self._threads
        return names if is_full or query.family is not Family.POOL_EXHAUSTION else None

    def has_waits_of(self, part: Spec) -> bool:
        """
        Return whether a part waits for what the unit waits for.

        What the model of a unit leaves out because of others may be in that of a part without
        them, and then they say different things.
        """
        return all(
            without_signals(waits_of(c, part)) == self._of.waits[c.name] for c in part.callbacks
        )

    @property
    def _threads(self) -> int:
        has_pool = executor_kind(self._spec) is ExecutorKind.MULTI_THREADED
        return len(self._spec.executor.threads) if has_pool else 1

    def holders(self, name: str) -> Names:
        """Members of its exclusive group, itself too, that hold it while they wait."""
        return frozenset(self._of.holders(self._of.by_name[name]))

    def holders_from(self, name: str) -> Names:
        """
        Name what may hold the group of ``name`` forever before it starts.

        A run of its own that waits keeps it from being started again: not where it runs once.
        """
        is_kept = name in self.waiting and not self._runs_once(name)
        holders = self.holders(name) - {name}
        return holders | {name} if is_kept else holders

    def _runs_once(self, name: str) -> bool:
        """Return whether data arrives for it once; for a giver of signals it may arrive again."""
        if self._of.callers[name] or any(step.is_signal for step in self._of.steps[name]):
            return False
        return self._runs_by_arrivals(self._of.by_name[name]) == 1

    def only_asks(self, names: Names) -> bool:
        """
        Return whether all that ``names`` wait for arrives because it was asked for.

        A message or a timer that would set an event may also never come.
        """
        return all(
            self._of.is_client(wait.needed) and wait.lock is None and wait.resource is None
            for name in self._cone(names, Rests.ON_END)
            for wait in self._of.steps[name]
            if not wait.is_signal
        )

    @cached_property
    def waiting(self) -> Names:
        """The callbacks that wait for another callback of the unit."""
        return frozenset(name for name, waits in self._of.waits.items() if waits)

    @cached_property
    def asked(self) -> Names:
        """The names asked whether they end; an activity only if all its waits are known."""
        open_ones = {name for name, own in self._of.steps.items() if any(w.is_open for w in own)}
        beside = self._of.steps.keys() - self._of.by_name.keys() - open_ones
        return self.waiting | {name for name in beside if without_signals(self._of.steps[name])}

    @cached_property
    def _spinning(self) -> Names:
        """The callbacks that spin an executor: others run inside, and inside these yet others."""
        return frozenset(n for n, waits in self._of.waits.items() if any(w.spin for w in waits))

    @cached_property
    def _has_spins_of_the_unit(self) -> bool:
        """
        Whether a nested spin may concern callbacks that it does not run.

        On a pool they may be queued twice, the global executor takes them out of theirs, and an
        executor that is refused stops for all.
        """
        spins = [wait.spin for waits in self._of.waits.values() for wait in waits if wait.spin]
        has_pool = executor_kind(self._spec) is ExecutorKind.MULTI_THREADED
        return any(
            has_pool or spin.spun is Spun.GLOBAL or spin.refusal is not Refusal.NEVER
            for spin in spins
        )

    @cached_property
    def has_threads_to_spare(self) -> bool:
        """
        True when callbacks that wait can never hold every thread.

        Not known where one spins an executor, or waits for what no callback gives. A member of
        a reentrant group holds one for each run that its arrivals can give, and a service that
        others of the unit call is asked by them too: then nothing is certain.
        """
        kinds = {wait.kind for waits in self._of.waits.values() for wait in waits}
        if not kinds <= {WaitKind.HELD, WaitKind.AWAITED, WaitKind.LOCKED}:
            return False
        holders: dict[object, int] = {}
        for callback in self._spec.callbacks:
            if all(wait.frees_thread for wait in self._of.waits[callback.name]):
                continue
            if callback.group in self._of.exclusive:
                holders[callback.group] = 1
            elif self._of.callers[callback.name]:
                return False
            else:
                holders[callback.name, callback.group] = self._runs_by_arrivals(callback)
        return self._threads > sum(holders.values())

    def crowd(self, first: Sequence[str], rather: Names, without: Names) -> tuple[str, ...] | None:
        """
        Name callbacks that may hold all threads while they wait, one of each exclusive group.

        A callback that may overlap itself is named as often as data arrives for it.

        :param first: what has to be among them.
        :param rather: what is taken before others; ``without`` are those that are not taken.
        """
        if not self._may_be_crowded:
            return None
        waits = {
            name
            for name, own in self._of.waits.items()
            if any(not wait.frees_thread for wait in own) and name not in without
        }
        others = [name for name in self._of.by_name if name not in first]
        order = [*first, *sorted(others, key=lambda name: name not in rather)]
        taken: list[str] = []
        groups: set[object] = set()
        for name in order:
            group = self._of.by_name[name].group
            if name in waits and group not in groups:
                is_alone = group in self._of.exclusive
                runs = 1 if is_alone else self.closed.arrivals.get(name, self.max_cycle)
                taken += [name] * min(runs, self._threads - len(taken))
                groups.update({group} & self._of.exclusive)
        return tuple(taken) if len(taken) == self._threads else None

    @cached_property
    def _may_be_crowded(self) -> bool:
        """Activities run in every run of the unit, and a spin serves others while it waits."""
        has_pool = executor_kind(self._spec) is ExecutorKind.MULTI_THREADED
        has_activities = len(self._of.steps) > len(self._of.by_name)
        return has_pool and not self._spinning and not has_activities

    def part_of_crowd(self, names: Iterable[str]) -> ClosedSpec | None:
        """Cut them out with all that may end their waits; ``None`` if that is no part."""
        cone = self._cone(names, Rests.ON_RUNS)
        if not cone <= self._of.by_name.keys():
            return None
        part = self.cut(cone)
        is_full = len(part.spec.executor.threads) == self._threads
        return part if is_full and self.has_waits_of(part.spec) else None

    def part_of_end(self, name: str) -> ClosedSpec | None:
        """
        Give the slice that is asked whether ``name`` ends, or the whole if there is no slice.

        ``None`` where others run while one waits on the only thread, or beside the executor.
        """
        if self._spinning or len(self._of.steps) > len(self._of.by_name):
            return None
        if not self.has_threads_to_spare:
            return self.closed
        cone = self._cone((name,), Rests.ON_END)
        part = self.cut(cone) if cone <= self._of.by_name.keys() else None
        return part if part is not None and self.has_waits_of(part.spec) else None

    def callback(self, name: str) -> Callback:
        """Give a callback by its name."""
        return self._of.by_name[name]

    def waits_alone(self, name: str) -> bool:
        """Return whether nothing else that its end depends on waits, and it runs once."""
        if not self.has_threads_to_spare or not self._runs_once(name):
            return False
        return self._cone((name,), Rests.ON_END) & self.waiting <= {name}

    def held_steps(self, name: str) -> Iterator[int]:
        """Number the steps in which it holds a thread until another callback has run."""
        for number, step in enumerate(self._of.steps[name]):
            if step.kind is WaitKind.HELD:
                yield number

    @property
    def spins(self) -> bool:
        """Whether a callback spins an executor, so that others run while it waits."""
        return bool(self._spinning)

    @property
    def by_request(self) -> Names:
        """Clients that get data only where a callback of the unit asks."""
        return frozenset(
            n for n, callers in self._of.callers.items() if callers and self._of.is_client(n)
        )

    def gets_data(self, name: str) -> bool:
        """Whether something may arrive for it that nothing in the unit has asked for."""
        return not self._of.callers[name]

    def cut(self, names: Names) -> ClosedSpec:
        """Give the slice as a unit, with no more threads than can ever be at work in it."""
        spec = self._spec
        kept = sorted(names, key=self._of.places.__getitem__)
        callbacks = tuple(self._unpaired_by_name(name) for name in kept)
        groups = {c.group for c in callbacks}
        threads = spec.executor.threads[: self._at_work(callbacks)]
        part = replace(
            spec,
            callbacks=callbacks,
            activities=(),
            groups=tuple(group for group in spec.groups if group.name in groups),
            executor=replace(spec.executor, kind=executor_kind(spec).value, threads=threads),
        )
        own = {name: n for name, n in self.closed.arrivals.items() if name in names}
        return replace(self.closed, spec=part, arrivals=own)

    def outline(self, names: Names) -> Outline | None:
        """
        Give the shape of a slice; ``None`` where it does not wait for what the unit waits for.

        What is known of callbacks that wait for nothing, in any part, is not looked up again.
        """
        plain = [self._plain_facts.get(name) for name in names]
        facts = [each for each in plain if each is not None]
        if len(facts) == len(plain):
            threads = self._at_work([self._of.by_name[name] for name in names])
            setting = replace(self._setting, threads=min(threads, self._setting.threads))
            return outline(facts, setting)
        part = self.cut(names)
        return outline_of(part, self.max_cycle) if self.has_waits_of(part.spec) else None

    @cached_property
    def _setting(self) -> Setting:
        return setting_of(self._spec, self.max_cycle)

    @cached_property
    def _plain_facts(self) -> dict[str, Facts]:
        """
        Of callbacks that neither wait nor take locks, in any part of such callbacks.

        They signal nothing there.
        """
        spec = self._spec
        return {
            callback.name: replace(facts_of(callback, place, spec), server=None, waits=())
            for place, callback in enumerate(spec.callbacks)
            if not callback.blocking and not callback.locks
        }

    def _unpaired_by_name(self, name: str) -> Callback:
        if name not in self._unpaired_callbacks:
            self._unpaired_callbacks[name] = self._unpaired(self._of.by_name[name])
        return self._unpaired_callbacks[name]

    @cached_property
    def _unpaired_callbacks(self) -> dict[str, Callback]:
        return {}

    def _unpaired(self, callback: Callback) -> Callback:
        """
        One without a partner in the unit, since several have its name, gets none in a slice.

        And a service is not absent in a slice that is there in the unit.
        """
        callbacks = self._spec.callbacks
        blocking = tuple(
            replace(block, on=None)
            if asks_the_graph(block) and not is_absent(block, self._spec)
            else block
            for block in callback.blocking
        )
        callback = replace(callback, blocking=blocking)
        has_partner = server_of(callback, callbacks) or client_before(callback, callbacks)
        pairs = is_client(callback) or is_done_callback(callback)
        return replace(callback, key=None) if pairs and not has_partner else callback

    def _at_work(self, callbacks: Sequence[Callback]) -> int:
        """One member of each exclusive group; each arrival of any other callback."""
        most: dict[object, int] = {}
        for callback in callbacks:
            if callback.group in self._of.exclusive:
                most[callback.group] = 1
            else:
                asked = len(self._of.callers[callback.name]) * len(callbacks)
                most[callback.name, callback.group] = self._runs_by_arrivals(callback) + asked
        return sum(most.values())

    def _runs_by_arrivals(self, callback: Callback) -> int:
        """How often it may run at one time because of what arrives by itself."""
        arrivals = self.closed.arrivals.get(callback.name, self.max_cycle)
        return arrivals * runs_of_an_arrival(callback)

    @cached_property
    def _of(self) -> WaitRelations:
        return WaitRelations(self.closed.spec)

    @property
    def _spec(self) -> Spec:
        return self.closed.spec

    def _closers(self, query: Query) -> Iterator[str]:
        """What may close the groups a query is about; a reentrant one never closes."""
        if query.family is Family.GROUP_CLOSED:
            return
        for group in query.groups:
            members = [c.name for c in self._spec.callbacks if c.group == group]
            yield from members if group in self._of.exclusive else members[:1]

    def _cone_of_runs(self, name: str) -> Names:
        if name not in self._cones:
            self._cones[name] = self._cone((name,), Rests.ON_RUNS)
        return self._cones[name]

    @cached_property
    def _cones(self) -> dict[str, Names]:
        return {}

    def _cone(self, names: Iterable[str], rests: Rests) -> Names:
        """Follow partners; of those that have to run, also what may keep their group closed."""
        cone: dict[str, bool] = {}
        waiting = [(name, rests is Rests.ON_START) for name in names]
        while waiting:
            name, has_to_run = waiting.pop()
            if cone.get(name, False) or (name in cone and not has_to_run):
                continue
            cone[name] = has_to_run
            callback = self._of.by_name.get(name)
            if callback is None:
                continue  # then there is no slice
            follows = rests is not Rests.ON_RUNS
            waiting.extend((needed, follows) for needed in self._of.needed(callback))
            waiting.extend((caller, False) for caller in self._of.callers[name])
            if has_to_run:
                waiting.extend((holder, False) for holder in self._of.holders(callback))
        return frozenset(cone)
