"""
Claims about runs, asked of units in which less is waited for.

A callback that waits holds its thread and its group like one that runs long, and any run may be
long. So a unit without some of the waits, and without locks, does all that the unit itself does
as far as it shows what runs and which groups are closed: what never happens in it never happens.
What may happen in it says nothing, unless the unit may do without these waits itself.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.generator.build import Family, Query
from ros2cc_extract.generator.program_steps import NamedWait, WaitKind
from ros2cc_extract.generator.waits import actors_of, waits_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.client_server_pairs import is_client, server_of
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import Activity, Callback, GroupType, Spec
from ros2cc_extract.verify.results.results import QueryResult
from ros2cc_extract.verify.search.search_results import Key

#: Claims about runs, and the verdict that says that something never happens.
_NEVER: Mapping[Family, Verdict] = {
    Family.EXECUTABLE: Verdict.NOT_SATISFIED,
    Family.CAN_OVERLAP: Verdict.NOT_SATISFIED,
    Family.NEVER_TOGETHER: Verdict.SATISFIED,
    Family.SELF_OVERLAP: Verdict.SATISFIED,
    Family.GROUP_CLOSED: Verdict.SATISFIED,
    Family.GROUP_OPEN: Verdict.SATISFIED,
}


@dataclass(frozen=True)
class Loosened:
    """
    A unit in which less is waited for.

    :param is_exact: what is not waited for a branch of the unit may skip too; then what may happen
        in this one may happen in the unit.
    """

    closed: ClosedSpec
    is_exact: bool

    def decided(self, results: Mapping[Key, QueryResult]) -> dict[Key, QueryResult]:
        """Keep what is decided for the unit too."""
        return {
            key: result
            for key, result in results.items()
            if self.is_exact or result.verdict is _NEVER.get(key[0])
        }


def loosened(closed: ClosedSpec) -> Iterator[Loosened]:
    """
    Give the unit without waits, then with those alone in which a client of it is asked.

    First a node outside answers, whenever it may be; then the services of the unit.
    """
    if not any(callback.blocking or callback.locks for callback in closed.spec.callbacks):
        return
    yield Loosened(_with(closed, lambda callback, spec: ()), is_exact=False)
    yield Loosened(_answered_outside(_with(closed, _questions)), is_exact=False)
    is_exact = all(_may_leave_out(callback, closed.spec) for callback in closed.spec.callbacks)
    yield Loosened(_with(closed, _questions), is_exact)


def is_loose(query: Query, closed: ClosedSpec, max_cycle: int) -> bool:
    """
    Return whether a loosened unit may decide it of ``closed``.

    If several ask one, it runs as often and may overlap itself, if its group allows it. Unasked
    that takes two arrivals.
    """
    if query.family is Family.SELF_OVERLAP and max_cycle == 1:
        spec = closed.spec
        overlapping = {
            c.name for c in spec.callbacks if spec.group_of(c).type is not GroupType.EXCLUSIVE
        }
        return not any(_is_asked_again(name, closed) for name in overlapping & {*query.callbacks})
    return query.family in _NEVER


def _is_asked_again(name: str, closed: ClosedSpec) -> bool:
    """Whether questions may let it run more often than it does if nothing asks."""
    asked, spec = 0, closed.spec
    by_name = {callback.name: callback for callback in spec.callbacks}
    for actor in actors_of(spec):
        runs = closed.arrivals.get(actor.name, 1)
        loops = isinstance(actor, Activity) and actor.loops
        for step in waits_of(actor, spec):
            needed = by_name.get(step.needed)
            if step.needed == name:
                asked += 2 if loops else runs
            elif needed is not None and (server := server_of(needed, spec.callbacks)):
                # A server has arrivals of its own beside those that the unit asks for.
                asked += 2 if server.name == name else 0
    return asked > 1


def _with(closed: ClosedSpec, kept: Callable[[Callback, Spec], Iterable[Blocking]]) -> ClosedSpec:
    spec = closed.spec
    callbacks = tuple(
        replace(callback, blocking=tuple(kept(callback, spec)), locks=())
        for callback in spec.callbacks
    )
    return replace(closed, spec=replace(spec, callbacks=callbacks))


def _answered_outside(closed: ClosedSpec) -> ClosedSpec:
    callbacks = tuple(
        replace(callback, key=None) if is_client(callback) else callback
        for callback in closed.spec.callbacks
    )
    return replace(closed, spec=replace(closed.spec, callbacks=callbacks))


def _questions(callback: Callback, spec: Spec) -> Iterator[Blocking]:
    """Give what it asks, in the order of its steps: a client that nothing asks runs unasked."""
    for step in waits_of(callback, spec):
        if _asks(step, spec):
            block = step.block or Blocking(call='')
            yield Blocking(
                call=_CALLS[step.kind],
                on=step.needed,
                source=block.source,
                chain=block.chain,
                conditional=step.may_skip,
            )


def _asks(step: NamedWait, spec: Spec) -> bool:
    if step.kind not in _CALLS or not step.is_for_callback:
        return False
    return any(other.name == step.needed and is_client(other) for other in spec.callbacks)


def _may_leave_out(callback: Callback, spec: Spec) -> bool:
    """Whether a branch may leave out all but its questions, and no lock is held over any."""
    steps = waits_of(callback, spec)
    has_locks = bool(callback.locks) or any(step.lock or step.held for step in steps)
    return not has_locks and all(
        step.is_signal
        or _asks(step, spec)
        or (step.kind is WaitKind.HELD and step.resource is not None and step.may_skip)
        for step in steps
    )


_CALLS = {WaitKind.HELD: 'client.call', WaitKind.AWAITED: 'await'}
