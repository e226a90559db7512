"""What is found in the graph of a whole system, which no unit shows."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.base.rule import Hit, Rule
from ros2cc_extract.findings.base.wording import called
from ros2cc_extract.findings.rules.deadlocks.undecided_wait import UNDECIDED
from ros2cc_extract.findings.rules.systems import (
    life_cycle,
    near_names,
    parameter_types,
    qos,
    same_node_name,
    sim_time,
    start_order,
    two_types,
    unused_settings,
)
from ros2cc_extract.spec.node_graph import EndpointKind
from ros2cc_extract.spec.system.circles.joined_processes import circle_waits, circles_of
from ros2cc_extract.spec.system.model import Process, System

_CHECKS: tuple[tuple[Rule, Callable[[System], Iterator[Hit]]], ...] = (
    (near_names.RULE, near_names.find),
    (two_types.RULE, two_types.find),
    (qos.RULE, qos.find),
    (sim_time.RULE, sim_time.find),
    (same_node_name.RULE, same_node_name.find),
    (unused_settings.RULE, unused_settings.find),
    (start_order.RULE, start_order.find),
    (life_cycle.RULE, life_cycle.find),
    (parameter_types.RULE, parameter_types.find),
)

_OFFERS = (EndpointKind.SERVICE, EndpointKind.ACTION_SERVER, EndpointKind.PUBLISHER)


def undecided_circles(system: System) -> Iterator[Finding]:
    """Waits in circles of processes that cannot be put into one model: nothing is claimed."""
    for circle, why in circles_of(system).open:
        offered = {name for process in circle for name in _offered(process, system)}
        for process in circle:
            for wait in circle_waits(process):
                if (wait.what, wait.name) not in offered:
                    continue
                place = wait.block.source or process.launched.source
                yield Finding(
                    code=UNDECIDED.code,
                    severity=UNDECIDED.severity,
                    place=place,
                    message=f'not decided: {called(wait.doer)} waits in {wait.block.call} for '
                    f'{wait.what} {wait.name}, whose process waits for this one; they are not '
                    f'judged together: {why}',
                    help='give the wait a time-out, or let what is not followed be seen',
                    unit=wait.unit.name,
                    subjects=(wait.doer.name,),
                )


def _offered(process: Process, system: System) -> Iterator[tuple[str, str]]:
    for connection in system.connections:
        for kind in _OFFERS:
            if any(end.process is process for end in connection.of_kind(kind)):
                yield connection.what, connection.name


def findings_of_system(system: System) -> tuple[Finding, ...]:
    """The findings of the graph, rule by rule."""
    return tuple(
        Finding(
            code=rule.code,
            severity=hit.severity or rule.severity,
            place=hit.place,
            message=hit.message,
            help=hit.help,
            subjects=hit.subjects,
            related=tuple(dict.fromkeys(hit.related)),
        )
        for rule, find in _CHECKS
        for hit in find(system)
    ) + tuple(undecided_circles(system))
