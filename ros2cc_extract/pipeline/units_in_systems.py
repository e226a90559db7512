"""
What the other processes of a system add to a unit: partners, and how many ask at once.

Units are judged one by one; what their neighbours are known to do stands in them.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.spec.model import Callback, EntityKind, Spec
from ros2cc_extract.spec.system.circles.offers_at_start import with_offers
from ros2cc_extract.spec.system.circles.part_names import renamed_parts
from ros2cc_extract.spec.system.circles.pending_requests import SEVERAL, askers_in
from ros2cc_extract.spec.system.model import Process, System


def with_neighbours(system: System) -> System:
    """The system with units that say what the others do for them, and to them."""
    return _with_askers(with_offers(system))


def _with_askers(system: System) -> System:
    """Services with the number of requests that all processes may have on their way."""
    certain = [each for each in system.processes if _is_certain(each)]
    asking: dict[str, dict[int, Spec]] = defaultdict(dict)
    for unit in renamed_parts(certain):
        if unit.executor.spun is None or unit.executor.unresolved is not None:
            continue
        for callback in unit.callbacks:
            if callback.entity is EntityKind.CLIENT and isinstance(callback.key, str):
                asking[callback.key][id(unit)] = unit
    numbers = {
        key: sum(askers_in(key, unit) for unit in units.values())
        for key, units in asking.items()
        if len(units) >= SEVERAL
    }
    several = {key: number for key, number in numbers.items() if number >= SEVERAL}
    if not several:
        return system
    processes = tuple(_asked(each, several) for each in system.processes)
    return replace(system, processes=processes)


def _is_certain(process: Process) -> bool:
    return process.launched.conditional is None and process.launched.is_beside_others


def _asked(process: Process, numbers: Mapping[str, int]) -> Process:
    known = {
        (end.source, end.written): end.name for node in process.nodes for end in node.endpoints
    }

    def asked(callback: Callback) -> Callback:
        key = callback.key
        name = None if key is None else known.get((callback.source, key))
        number = numbers.get(name, 0) if isinstance(name, str) else 0
        is_more = callback.entity is EntityKind.SERVICE and number > callback.askers
        return replace(callback, askers=number) if is_more else callback

    units = [replace(unit, callbacks=tuple(map(asked, unit.callbacks))) for unit in process.units]
    same = _same(process.units, units)
    return process if same else replace(process, units=tuple(units))


def _same(before: Sequence[Spec], after: Sequence[Spec]) -> bool:
    return all(one == other for one, other in zip(before, after, strict=True))
