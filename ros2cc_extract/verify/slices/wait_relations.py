"""
Which waits for which in a unit: what slices of it follow.

Found once for each unit, and read by the names of callbacks.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cached_property

from ros2cc_extract.generator.program_steps import Lock, NamedWait, Resource
from ros2cc_extract.generator.waits import actors_of, waits_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.client_server_pairs import server_of
from ros2cc_extract.spec.model import Callback, CallbackType, GroupType, Spec

Names = frozenset[str]


@dataclass(frozen=True)
class WaitRelations:
    """Of the callbacks, and of the activities, of one unit."""

    spec: Spec

    @cached_property
    def places(self) -> dict[str, int]:
        """Place of each callback in the unit."""
        return {callback.name: place for place, callback in enumerate(self.spec.callbacks)}

    @cached_property
    def exclusive(self) -> Names:
        """Names of the exclusive groups."""
        groups = self.spec.groups
        return frozenset(g.name for g in groups if g.type is GroupType.EXCLUSIVE)

    @cached_property
    def by_name(self) -> dict[str, Callback]:
        """Callbacks by their names."""
        return {callback.name: callback for callback in self.spec.callbacks}

    @cached_property
    def waits(self) -> dict[str, tuple[NamedWait, ...]]:
        """What each callback waits for."""
        return {
            callback.name: without_signals(self.steps[callback.name])
            for callback in self.spec.callbacks
        }

    @cached_property
    def steps(self) -> dict[str, tuple[NamedWait, ...]]:
        """Steps of callbacks and of activities."""
        return {actor.name: tuple(waits_of(actor, self.spec)) for actor in actors_of(self.spec)}

    def is_client(self, name: str) -> bool:
        """Return whether it is a client of the unit."""
        callback = self.by_name.get(name)
        return callback is not None and callback.type is CallbackType.CLT

    @cached_property
    def sharers(self) -> dict[Resource | None, Names]:
        """What gives signals to a resource; and what takes them away from others that wait."""
        found: dict[Resource | None, set[str]] = {}
        for name, steps in self.steps.items():
            for step in steps:
                if step.resource is not None and (step.is_signal or step.resource.is_each):
                    found.setdefault(step.resource, set()).add(name)
        return {resource: frozenset(names) for resource, names in found.items()}

    @cached_property
    def callers(self) -> dict[str, Names]:
        """For each client those that wait for it, for each service its clients in the unit."""
        found: dict[str, set[str]] = {name: set() for name in self.by_name}
        for name, steps in self.steps.items():
            for wait in without_signals(steps):
                if wait.resource is None and self.is_client(wait.needed):
                    found[wait.needed].add(name)
        for callback in self.spec.callbacks:
            server = self.servers[callback.name]
            if server is not None:
                found[server].add(callback.name)
        return {name: frozenset(callers) for name, callers in found.items()}

    @cached_property
    def lock_holders(self) -> dict[Lock | None, Names]:
        """What keeps a lock over a wait."""
        found: dict[Lock | None, set[str]] = {}
        for name, waits in self.steps.items():
            for wait in waits:
                for lock in wait.held:
                    found.setdefault(lock, set()).add(name)
        return {lock: frozenset(names) for lock, names in found.items()}

    def needed(self, callback: Callback) -> Iterator[str]:
        """What it waits for, also for a lock, and what answers it."""
        for wait in self.waits[callback.name]:
            yield wait.needed
            yield from self.lock_holders.get(wait.lock, ())
            yield from self.sharers.get(wait.resource, ())
        server = self.servers[callback.name]
        if server is not None:
            yield server

    @cached_property
    def servers(self) -> dict[str, str | None]:
        """For each client the service of the unit that answers it."""
        callbacks = self.spec.callbacks
        servers = {callback.name: server_of(callback, callbacks) for callback in callbacks}
        return {name: None if s is None else s.name for name, s in servers.items()}

    def holders(self, callback: Callback) -> Iterator[str]:
        """Members of its exclusive group that wait; a reentrant group is never held."""
        if callback.group in self.exclusive:
            for other in self.spec.callbacks:
                if other.group == callback.group and self.waits[other.name]:
                    yield other.name


def without_signals(steps: Iterable[NamedWait]) -> tuple[NamedWait, ...]:
    """
    Leave out signals.

    A slice without the callbacks that wait for a signal does not have it.
    """
    return tuple(step for step in steps if not step.is_signal)
