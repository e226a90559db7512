"""From what a run leaves behind to verification units: one executor with its nodes each."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    LOOP_KIND,
    RosWorld,
    Spin,
    nodes_of,
)
from ros2cc_extract.extract.static.python.machine.world import Cut
from ros2cc_extract.extract.static.python.values.exclusive_paths import Branches, exclusive
from ros2cc_extract.extract.static.python.values.values import Class, Instance, options_of
from ros2cc_extract.extract.static.python.values.values import Value as AnyValue
from ros2cc_extract.extract.static.units.callbacks import UnitBuilder
from ros2cc_extract.extract.static.units.executor import Unit, is_handed_over
from ros2cc_extract.extract.static.units.handler_locks import note_handler_locks
from ros2cc_extract.extract.static.units.set_up_waits import share_out
from ros2cc_extract.extract.static.units.whole_program.double_spins import are_concurrent
from ros2cc_extract.spec.joined_executors import KINDS, Joined, joined
from ros2cc_extract.spec.model import Executor, Spec, collect_unresolved
from ros2cc_extract.spec.system.circles.pending_requests import with_askers


def specs_of(world: RosWorld, entry: str | None) -> list[Spec]:
    """The specifications of one run."""
    found = []
    units = units_of(world)
    share_out(world, units)
    note_handler_locks(world)
    for unit in units:
        unit.is_only = len(units) == 1
        is_lost = unit.spin is None and not any(node.state.nested for node in unit.nodes)
        if entry is not None and unit.executor is not None and is_lost:
            world.diagnostics.append(_not_spun(unit.executor))
        spec = UnitBuilder(world, unit).build(entry)
        found.append(_with_unresolved(spec))
    found = with_askers(found)
    reported = {(fact.reason, fact.source) for spec in found for fact in spec.unresolved}
    reported |= {(diagnostic.message, diagnostic.place) for diagnostic in world.diagnostics}
    lost = [cut for cut in world.cut if (cut.reason, cut.place) not in reported]
    world.diagnostics.extend(_as_diagnostic(cut) for cut in lost)
    return found


def joined_of(world: RosWorld, entry: str | None, specs: Sequence[Spec]) -> Iterator[Joined]:
    """
    Units that run at the same time and wait for each other, as one.

    :param specs: the specifications of the same run.
    """
    pairs = [
        (unit, spec)
        for unit, spec in zip(units_of(world), specs, strict=True)
        if _is_known(spec.executor)
    ]
    threads = [pair for pair in pairs if pair[1].executor.in_thread]
    others = [pair for pair in pairs if pair not in threads]
    beside = [*threads, *others] if len(others) == 1 else threads
    if entry is None or len(beside) < 2:
        return
    units, own = [unit for unit, _ in beside], [spec for _, spec in beside]
    nodes = [node for unit in units for node in unit.nodes]
    whole = Unit(None, nodes, None, is_only=len(units) == len(specs))
    found = joined(UnitBuilder(world, whole).build(entry), own)
    if found is not None:
        yield found


def wholes_of(world: RosWorld, entry: str | None, specs: Sequence[Spec]) -> Iterator[Spec]:
    """
    The working units of one program in one, with the names that they have together.

    Only of several; what one wakes or holds up of another is seen in no unit alone.

    :param specs: the specifications of the same run.
    """
    pairs = [pair for pair in zip(units_of(world), specs, strict=True) if pair[1].has_work]
    if entry is not None and len(pairs) > 1 and all(_is_known(s.executor) for _, s in pairs):
        nodes = [node for unit, _ in pairs for node in unit.nodes]
        yield UnitBuilder(world, Unit(None, nodes, None, is_only=True)).build(entry)


def _is_known(executor: Executor) -> bool:
    """Whether it is spun on every branch, and serves as those of rclpy do."""
    is_spun = executor.spun is not None and executor.alternative is None
    return is_spun and executor.unresolved is None and executor.kind in KINDS


def _as_diagnostic(cut: Cut) -> Diagnostic:
    """What no unit can carry: there may be no node at all."""
    return Diagnostic(
        severity=Severity.WARNING,
        slug='not-followed',
        place=cut.place,
        message=f'{cut.reason}: its object is not known to be a node',
        help='what it would create is missing from the units',
    )


def _not_spun(executor: Instance) -> Diagnostic:
    if executor.state.kind == LOOP_KIND:
        return _not_run(executor)
    name = executor.hint or 'executor'
    return Diagnostic(
        severity=Severity.WARNING,
        slug='executor-not-spun',
        place=executor.place,
        message=f'{name} has nodes, and no known call spins it',
        help=f'call {name}.spin()',
    )


def _not_run(loop: Instance) -> Diagnostic:
    """Source: rclpy 10.0.10, ``experimental/async_node.py`` (``__aenter__`` starts the tasks)."""
    return Diagnostic(
        severity=Severity.WARNING,
        slug='executor-not-spun',
        place=loop.place,
        message='no known call runs this AsyncNode: none of its callbacks ever runs',
        help='enter it by `async with node:`, or `await node.run()`',
    )


def _with_unresolved(spec: Spec) -> Spec:
    collected = collect_unresolved(replace(spec, unresolved=()))
    own = tuple(fact for fact in spec.unresolved if fact not in collected)
    return replace(spec, unresolved=(*collected, *own))


def units_of(world: RosWorld) -> list[Unit]:
    """One unit for each executor that is spun; then nodes that are not spun."""
    units = [unit for unit in _spun_units(world) if unit.nodes]
    served = {id(node) for unit in units for node in unit.nodes}
    for executor in world.executors:
        nodes = [n for n in _filled_nodes(executor, world) if id(n) not in served]
        if not nodes:
            continue
        served.update(id(node) for node in nodes)
        spun = next((unit for unit in units if unit.executor is executor), None)
        if spun is not None:
            spun.nodes.extend(nodes)
        else:
            units.append(Unit(executor, nodes, _spin_in_thread(executor, world)))
    seen: set[object] = set()
    for node in world.nodes:
        if id(node) in served:
            continue
        key = _class_key(node)
        if key in seen:
            continue
        seen.add(key)
        units.append(Unit(None, [node], None))
    _mark_alternatives(units)
    return units


def _mark_alternatives(units: list[Unit]) -> None:
    """Spins on branches of one statement: the program has only one of these units."""
    branches = Branches(unit.spin.path for unit in units if unit.spin is not None)
    for unit in units:
        if unit.spin is not None:
            unit.mark = branches.mark_of(unit.spin.path)


def _spin_in_thread(executor: Instance, world: RosWorld) -> Spin | None:
    """A thread that spins on also serves the nodes that are added after its start."""
    spins = (s for s in world.spins.values() if s.executor is executor and s.in_thread)
    return next((spin for spin in spins if spin.for_ever), None)


def _class_key(node: Instance) -> object:
    if isinstance(node.cls, Class) and node.state.ghost is None:
        return (id(node.cls), str(node.state.name))
    return id(node)


def _filled_nodes(executor: Instance, world: RosWorld) -> list[Instance]:
    return [
        node
        for node in nodes_of(executor)
        if isinstance(owner := node.slots.get('__owner__'), AnyValue)
        and executor in options_of(owner)
    ]


def _spun_units(world: RosWorld) -> list[Unit]:
    """Spins of one executor become one unit; of the global one, those that share nodes."""
    units: list[Unit] = []
    spins = list(world.spins.values())
    for spin in sorted(spins, key=lambda spin: (not spin.for_ever, not spin.repeated)):
        nodes = [node for node in spin.nodes if _is_final(spin, node, spins)]
        if not nodes:
            continue
        unit = next((u for u in units if _same_unit(world, u, spin, nodes)), None)
        if unit is None:
            units.append(Unit(spin.executor, nodes, spin))
        else:
            unit.nodes.extend(node for node in nodes if node not in unit.nodes)
    order = {id(spin): index for index, spin in enumerate(spins)}
    return sorted(units, key=lambda u: order[id(u.spin)])


def _same_unit(world: RosWorld, unit: Unit, spin: Spin, nodes: list[Instance]) -> bool:
    if unit.executor is not spin.executor or unit.spin is None:
        return False
    if not spin.executor.state.is_global:
        return True
    if any(node in unit.nodes for node in nodes) or _at_once(world, unit.spin, spin):
        return True
    if any(is_handed_over(node) for node in (*unit.nodes, *nodes)):
        return False
    return not unit.spin.for_ever and not spin.for_ever


def _at_once(world: RosWorld, one: Spin, other: Spin) -> bool:
    return are_concurrent(world, one, other) or are_concurrent(world, other, one)


def _is_final(spin: Spin, node: Instance, spins: list[Spin]) -> bool:
    """Whether ``spin`` serves ``node`` in the end: a spin forever, later ones first."""
    rivals = [
        other
        for other in spins
        if node in other.nodes
        and other.executor is not spin.executor
        and not exclusive(other.path, spin.path)
    ]
    mine = spins.index(spin)
    best_of_mine = any(
        other.for_ever
        for other in spins
        if other.executor is spin.executor and node in other.nodes
    )
    for rival in rivals:
        if rival.for_ever and not best_of_mine:
            return False
        if rival.for_ever == best_of_mine and spins.index(rival) > mine:
            return False
    return True
