"""A closed specification as the templates see it: names, numbers and types, nothing else."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence

from ros2cc_extract.generator.executor_kinds import ExecutorKind, executor_kind, rank_of
from ros2cc_extract.generator.nested_spins import Refusal, Spun
from ros2cc_extract.generator.omissions import (
    is_entered_unseen,
    left_out_of_models,
    unexplained_runs,
)
from ros2cc_extract.generator.program_steps import Lock, NamedWait, Resource, gives
from ros2cc_extract.generator.resources import start_of
from ros2cc_extract.generator.unit_waits import SpinForm, UnitResource, UnitWait
from ros2cc_extract.generator.waits import (
    actors_of,
    foreign_wakes,
    modelled_activities,
    waits_of,
)
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.client_server_pairs import server_of
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.model import Activity, Callback, Spec


@dataclass(frozen=True, kw_only=True)
class UnitCallback:
    """
    A callback of the model.

    :param index: its place in the model's tables, from 0.
    :param group: place of its group.
    :param node: place of its node.
    :param rank: when it is served among what is ready, 0 first.
    :param waits: what it waits for while it runs, in order.
    :param server: place of the service that answers a client of the unit.
    :param is_groupless: it is in no group; the model has a reentrant one for it.
    :param left_out: what may hold it forever and is not in the model, in words.
    :param unexplained: that of ``left_out`` which a run has shown, and no published model has.
    :param is_entered: others may run inside it where the model does not show it.
    :param is_one_shot: it arrives no more than once.
    :param arrivals: how often it may become ready, where there is a bound.
    """

    index: int
    name: str
    type: str
    group: int
    node: int
    rank: int
    waits: tuple[UnitWait, ...]
    server: int | None
    is_groupless: bool = False
    left_out: tuple[str, ...] = ()
    unexplained: tuple[str, ...] = ()
    is_entered: bool = False
    is_one_shot: bool = False
    arrivals: int = 1

    @property
    def needs(self) -> tuple[int, ...]:
        """Places of the callbacks it waits for."""
        return tuple(wait.place for wait in self.waits if not wait.is_signal)


@dataclass(frozen=True, kw_only=True)
class UnitActivity:
    """
    What runs beside the executor, on a thread of its own.

    :param start: place of the resource whose signals start it; ``None`` from the beginning.
    :param rests: its loop begins with a wait, at which it is at rest.
    :param is_asked: all its waits are known, and whether they end is asked.
    """

    name: str
    waits: tuple[UnitWait, ...]
    loops: bool
    start: int | None
    rests: bool
    is_asked: bool


@dataclass(frozen=True, kw_only=True)
class UnitGroup:
    """A callback group of the model; ``index`` is its place in the model's tables."""

    index: int
    name: str
    type: str


@dataclass(frozen=True, kw_only=True)
class Unit:
    """
    What a model is made of.

    :param max_cycle: how often each callback may become ready; ``None`` for no bound.
    :param locks: names of those that are held over a wait, and that others take.
    :param foreign_wakes: a thread of the user's own that makes a future done wakes the executor.
    """

    name: str
    kind: ExecutorKind
    num_nodes: int
    callbacks: tuple[UnitCallback, ...]
    groups: tuple[UnitGroup, ...]
    threads: tuple[str, ...]
    executor: str
    max_cycle: int | None
    locks: tuple[str, ...] = ()
    foreign_wakes: bool = False
    resources: tuple[UnitResource, ...] = ()
    activities: tuple[UnitActivity, ...] = ()

    @property
    def actors(self) -> tuple[UnitCallback | UnitActivity, ...]:
        """Callbacks, and what runs beside the executor, as the model numbers them."""
        return (*self.callbacks, *self.activities)

    @property
    def num_waits(self) -> int:
        """The largest number of steps of one callback."""
        return max(len(actor.waits) for actor in self.actors)

    @property
    def has_resources(self) -> bool:
        """True when callbacks wait for signals of others."""
        return bool(self.resources)

    @property
    def has_tokens(self) -> bool:
        """Return whether code that gives a signal may have to give another one."""
        return any(resource.counts for resource in self.resources)

    @property
    def has_counts(self) -> bool:
        """True when a wait ends by several signals only."""
        return any(resource.least > 1 for resource in self.resources)

    @property
    def counted(self) -> str:
        """The table of what each waiting callback is counted for."""
        return 'resource_counts' if self.has_counts else 'resource_each'

    @property
    def has_forgetful(self) -> bool:
        """True if signals without a waiter are lost."""
        return any(resource.forgets for resource in self.resources)

    @property
    def has_skips(self) -> bool:
        """True when a branch may skip a step."""
        return any(wait.may_skip for wait in self.waits)

    @property
    def has_ways(self) -> bool:
        """True when a branch that skips a signal skips waits behind it as well."""
        return any(wait.past is not None for wait in self.waits)

    @property
    def has_doubts(self) -> bool:
        """True when it is not known of a wait whether it ends, or of a signal whether it comes."""
        return any(w.is_open or (w.is_signal and w.may_skip) for w in self.waits)

    @property
    def has_begun(self) -> bool:
        """True when a callback waits for the end of what others start."""
        return any(wait.begun for wait in self.waits)

    @property
    def has_awaits(self) -> bool:
        """True when a callback suspends itself."""
        return any(wait.frees_thread for wait in self.waits)

    @property
    def has_concurrent_awaits(self) -> bool:
        """True when a loop of asyncio begins runs of a callback while others are suspended."""
        return self.kind is ExecutorKind.ASYNCIO and any(
            wait.frees_thread
            for callback in self.callbacks
            if self.group_of(callback).type != 'EXCLUSIVE' and not callback.is_one_shot
            for wait in callback.waits
        )

    @property
    def waits(self) -> tuple[UnitWait, ...]:
        """All steps of all callbacks."""
        return tuple(wait for actor in self.actors for wait in actor.waits)

    @property
    def has_locks(self) -> bool:
        """True when callbacks wait for locks that others hold while they wait."""
        return bool(self.locks)

    @property
    def has_foreign(self) -> bool:
        """True when a coroutine waits for a thread of the user's own."""
        return any(wait.is_foreign for wait in self.waits)

    @property
    def has_absent(self) -> bool:
        """True when a callback waits for a service that may not be there."""
        return any(wait.is_absent for wait in self.waits)

    @property
    def has_spins(self) -> bool:
        """True when a callback spins an executor."""
        return any(wait.spin for wait in self.waits)

    @property
    def has_own_spins(self) -> bool:
        """True when a callback spins the executor that runs it."""
        return any(wait.spin and wait.spin.spun is Spun.OWN for wait in self.waits)

    @property
    def has_global_spins(self) -> bool:
        """True when a callback gives a node to the global executor."""
        return any(wait.spin and wait.spin.spun is Spun.GLOBAL for wait in self.waits)

    @property
    def has_refusals(self) -> bool:
        """True when an executor may refuse to be spun."""
        return any(wait.spin and wait.spin.refusal is not Refusal.NEVER for wait in self.waits)

    @property
    def spin_forms(self) -> tuple[SpinForm, ...]:
        """The kinds of nested spins that there are."""
        found = {SpinForm(wait.spun, wait.is_for_callback) for wait in self.waits if wait.spin}
        return tuple(sorted(found))

    @property
    def nested_runs(self) -> int:
        """
        How many callbacks can spin at a time on one thread, one inside the other.

        A member of an exclusive group can only once; more than so many is not modelled.
        """
        most = 0
        for callback in self.callbacks:
            if any(wait.spin for wait in callback.waits):
                is_exclusive = self.group_of(callback).type == 'EXCLUSIVE'
                most += 1 if is_exclusive else callback.arrivals
        return most

    @property
    def called(self) -> frozenset[int]:
        """Places of the clients whose answers a callback waits for: nothing else arrives there."""
        needed = {wait.place for wait in self.waits if wait.is_for_callback}
        return frozenset(place for place in needed if self.callbacks[place].type == 'CLT')

    @property
    def related(self) -> frozenset[int]:
        """Places of the callbacks that wait for another one or are waited for."""
        waiting = {callback.index for callback in self.callbacks if callback.waits}
        needed = (wait.place for wait in self.waits if not wait.is_signal)
        return frozenset(waiting.union(needed))

    @property
    def once(self) -> bool:
        """True when something arrives no more than once."""
        return any(callback.is_one_shot for callback in self.callbacks)

    @property
    def recurring(self) -> frozenset[int]:
        """Places of the callbacks for which something arrives again and again."""
        return frozenset(c.index for c in self.callbacks if not c.is_one_shot)

    def flags(self, places: Collection[int]) -> str:
        """Write a truth value for each callback: whether its place is among ``places``."""
        return ', '.join(str(c.index in places).lower() for c in self.callbacks)

    @property
    def queue_depth(self) -> int:
        """
        How much can wait for one callback.

        That is what arrives by itself, and one request or answer for each callback that can wait
        at the same time: on a thread, or suspended.
        """
        by_itself = self.most_arrivals
        if not self.num_waits:
            return by_itself
        return by_itself + len(self.threads) + len(self.actors)

    @property
    def most_arrivals(self) -> int:
        """How often a callback may become ready, where there is a bound."""
        return max(callback.arrivals for callback in self.callbacks)

    @property
    def has_arrivals_of_their_own(self) -> bool:
        """True when some callbacks become ready more often than others."""
        return any(c.arrivals != (self.max_cycle or 1) for c in self.callbacks)

    @property
    def servers(self) -> tuple[str, ...]:
        """The instances that serve callbacks, in system order: executor, threads, groups."""
        return (self.executor, *self.threads, *(group.name for group in self.groups))

    @property
    def processes(self) -> tuple[str, ...]:
        """All instances in system order: executor, threads, groups, callbacks."""
        return (
            *self.servers,
            *(activity.name for activity in self.activities),
            *(c.name for c in self.callbacks),
        )

    def group_of(self, callback: UnitCallback) -> UnitGroup:
        """The group of a callback of this unit."""
        return self.groups[callback.group]


def _arrivals(closed: ClosedSpec, actors: Iterable[str], max_cycle: int | None) -> dict[str, int]:
    """How often each becomes ready, if there is a bound: what runs once only once."""
    if not max_cycle:
        return dict.fromkeys(actors, 1)
    once = {callback.name: 1 for callback in closed.spec.callbacks if callback.one_shot}
    return {**dict.fromkeys(actors, max_cycle), **once, **closed.arrivals}


def number_unit(closed: ClosedSpec, max_cycle: int | None) -> Unit:
    """Give every callback and group of ``closed`` its place, in the order of the spec."""
    spec = closed.spec
    places = {callback.name: index for index, callback in enumerate(spec.callbacks)}
    groups = {group.name: index for index, group in enumerate(spec.groups)}
    nodes = {callback.node: 0 for callback in spec.callbacks}
    nodes = {node: index for index, node in enumerate(nodes)}
    waits = {actor.name: tuple(waits_of(actor, spec)) for actor in actors_of(spec)}
    locks = tuple(dict.fromkeys(w.lock for own in waits.values() for w in own if w.lock))
    resources = resources_of(waits)
    arrivals = _arrivals(closed, waits, max_cycle)
    return Unit(
        name=spec.name,
        kind=executor_kind(spec),
        num_nodes=len(nodes),
        callbacks=tuple(
            UnitCallback(
                index=index,
                name=callback.name,
                type=callback.type.value,
                group=groups[callback.group],
                node=nodes[callback.node],
                rank=rank_of(callback),
                waits=tuple(
                    _number_wait(wait, places, nodes, locks, resources)
                    for wait in waits[callback.name]
                ),
                server=_place_of(server_of(callback, spec.callbacks), places),
                is_groupless=callback.groupless,
                left_out=left_out_of_models(callback, spec),
                unexplained=unexplained_runs(callback),
                is_entered=is_entered_unseen(callback, spec),
                is_one_shot=callback.one_shot,
                arrivals=arrivals[callback.name],
            )
            for index, callback in enumerate(spec.callbacks)
        ),
        groups=tuple(
            UnitGroup(index=index, name=group.name, type=group.type.value)
            for index, group in enumerate(spec.groups)
        ),
        threads=spec.executor.threads,
        executor=spec.executor.name,
        max_cycle=max_cycle,
        locks=tuple(lock.name for lock in locks),
        foreign_wakes=foreign_wakes(spec),
        activities=tuple(
            _number_activity(
                activity,
                spec,
                waits,
                lambda wait: _number_wait(wait, places, nodes, locks, resources),
            )
            for activity in modelled_activities(spec)
        ),
        resources=tuple(_number_resource(each, waits, arrivals) for each in resources),
    )


def _number_wait(
    wait: NamedWait,
    places: Mapping[str, int],
    nodes: Mapping[str | Unknown | None, int],
    locks: Sequence[Lock],
    resources: Sequence[Resource],
) -> UnitWait:
    spun_node = wait.spin.node if wait.spin else None
    resource = None if wait.resource is None else resources.index(wait.resource)
    return UnitWait(
        place=places.get(wait.needed, 0),
        kind=wait.kind,
        frees_thread=wait.frees_thread,
        is_for_callback=wait.is_for_callback,
        spin=wait.spin,
        node=nodes.get(spun_node, 0),
        lock=locks.index(wait.lock) if wait.lock else None,
        # A lock that nothing waits for keeps nothing out.
        held=frozenset(locks.index(lock) for lock in wait.held if lock in locks),
        resource=resource,
        begun=frozenset(resources.index(each) for each in wait.begun if each in resources),
        is_signal=wait.is_signal,
        may_skip=wait.may_skip,
        past=wait.past,
        is_open=wait.is_open,
        wakers=wait.wakers,
    )


def _number_resource(
    resource: Resource, steps: Mapping[str, Sequence[NamedWait]], arrivals: Mapping[str, int]
) -> UnitResource:
    return UnitResource(
        name=resource.name,
        is_each=resource.is_each,
        initial=resource.initial,
        most=_most_signals(resource, steps, arrivals),
        forgets=resource.forgets,
        least=resource.least,
    )


def _number_activity(
    activity: Activity,
    spec: Spec,
    steps: Mapping[str, Sequence[NamedWait]],
    number: Callable[[NamedWait], UnitWait],
) -> UnitActivity:
    own = steps[activity.name]
    return UnitActivity(
        name=activity.name,
        waits=tuple(map(number, own)),
        loops=bool(activity.loops),
        start=_start_of(activity, spec, resources_of(steps)),
        rests=bool(activity.loops) and _begins_with_wait(own, steps),
        is_asked=_is_asked(own),
    )


def _start_of(activity: Activity, spec: Spec, resources: Sequence[Resource]) -> int | None:
    start = start_of(activity, spec)
    return resources.index(start) if start is not None and start in resources else None


def _begins_with_wait(own: Sequence[NamedWait], steps: Mapping[str, Sequence[NamedWait]]) -> bool:
    """True where the first step is a wait for a signal that is given."""
    resource = own[0].resource if own and not own[0].is_signal else None
    return resource is not None and any(gives(other, resource) for other in steps.values())


def _is_asked(own: Sequence[NamedWait]) -> bool:
    waits = [step for step in own if not step.is_signal]
    return bool(waits) and not any(step.is_open for step in waits)


def resources_of(steps: Mapping[str, Sequence[NamedWait]]) -> tuple[Resource, ...]:
    """What callbacks wait for and signal, in the order in which the model numbers it."""
    found = (step.resource for own in steps.values() for step in own)
    return tuple(dict.fromkeys(resource for resource in found if resource is not None))


def _most_signals(
    resource: Resource, steps: Mapping[str, Sequence[NamedWait]], arrivals: Mapping[str, int]
) -> int:
    """One for each arrival of its giver; one for good where the first ends all waits."""
    if not resource.is_each:
        return resource.least
    given = sum(
        arrivals[name]
        for name, own in steps.items()
        for step in own
        if step.is_signal and step.resource == resource
    )
    return max(1, resource.initial + given)


def _place_of(callback: Callback | None, places: Mapping[str, int]) -> int | None:
    return None if callback is None else places[callback.name]
