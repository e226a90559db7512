"""CC704: simulated time that no node provides."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Hit, Rule
from ros2cc_extract.spec.model import EntityKind, Spec
from ros2cc_extract.spec.node_graph import EndpointKind
from ros2cc_extract.spec.system.model import Process, System

PARAMETER = 'use_sim_time'
_CLOCK = '/clock'
_SLEEPS = ('Clock.sleep_for', 'Clock.sleep_until', 'Rate.sleep')


def find(system: System) -> Iterator[Hit]:
    """Report nothing where something unknown may provide the time."""
    if not system.is_whole or any(_gives_time(end.endpoint) for end in system.ends):
        return
    waiting = [each for each in system.processes if _is_simulated(each) and _needs_time(each)]
    if waiting:
        names = ', '.join(str(node.name) for process in waiting for node in process.nodes)
        yield Hit(
            place=waiting[0].launched.source,
            message=f'{names}: {PARAMETER} is true, and nobody in the system publishes {_CLOCK}: '
            'their time stands still, and their timers and sleeps do not end until something '
            'does, as a simulator or a bag that is started apart',
            help=f'start a node that publishes {_CLOCK}, or leave {PARAMETER} false',
            subjects=tuple(process.name for process in waiting),
        )


def _gives_time(endpoint: object) -> bool:
    kind, name = getattr(endpoint, 'kind', None), getattr(endpoint, 'name', None)
    return kind is EndpointKind.PUBLISHER and name == _CLOCK


def _is_simulated(process: Process) -> bool:
    values = [each.value for each in process.launched.parameters if each.name == PARAMETER]
    return bool(values) and values[-1] is True


def _needs_time(process: Process) -> bool:
    """Whether anything waits for it; nothing is lost for one that only takes messages."""
    return any(_has_timer(unit) or _sleeps(unit) for unit in process.units)


def _has_timer(unit: Spec) -> bool:
    return any(callback.entity is EntityKind.TIMER for callback in unit.callbacks)


def _sleeps(unit: Spec) -> bool:
    doers = (*(each.blocking for each in unit.callbacks), *(a.blocking for a in unit.activities))
    return any(wait.call in _SLEEPS for waits in doers for wait in waits)


RULE = Rule(
    code='CC704',
    slug='sim-time-without-clock',
    severity=Severity.NOTE,
    title='Simulated time that nobody provides',
    what='The launch file sets `use_sim_time` for a node with a timer, a rate or a `sleep_for`; '
    'all code of the system is known, and nothing in it publishes `/clock`. A note, as the '
    'simulator, or the bag that is played, is often started apart.',
    why='A node with simulated time takes its time from `/clock` and starts at zero; without '
    'messages there the time stands still, and timers, rates and `sleep_for` of the node never '
    'wake. Source: design.ros2.org, "Clock and Time"; rclpy 7.1.6, `time_source.py`.',
    bad="""\
Node(package='arm', executable='driver', parameters=[{'use_sim_time': True}])   # and no simulator
""",
    good="""\
Node(package='arm', executable='driver', parameters=[{'use_sim_time': False}])
""",
    mend='Start a node that publishes `/clock`, or leave `use_sim_time` false.',
)
