"""CC706: a remap or a parameter of the launch file that no code uses."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from difflib import get_close_matches

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Hit, Rule
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.system.launched import ANY_NODE
from ros2cc_extract.spec.system.model import Process, System, SystemNode
from ros2cc_extract.spec.system.names import NAMESPACE, NODE, Remap, expanded
from ros2cc_extract.spec.system.parameters import matches

_OF_RCLPY = ('use_sim_time', 'start_type_description_service')
_MADE_BY_LIBRARIES = frozenset(
    ['tf', 'tf_static', 'clock', 'rosout', 'parameter_events', 'diagnostics', 'robot_description']
)


def find(system: System) -> Iterator[Hit]:
    for process in system.processes:
        if _is_known(process):
            yield from _remaps(process)
            yield from _parameters(process)


def _is_known(process: Process) -> bool:
    """Whether all that the process has in the graph is known."""
    is_whole = process.outside is None and bool(process.nodes) and not process.launched.open
    return is_whole and all(
        node.open is None
        and node.naming is not None
        and all(isinstance(end.written, str) for end in node.endpoints)
        for node in process.nodes
    )


def _remaps(process: Process) -> Iterator[Hit]:
    for remap in process.launched.remaps:
        is_own = remap.source == process.launched.source
        last = remap.old.rpartition('/')[2]
        is_of_node = remap.old in (NODE, NAMESPACE) or last in _MADE_BY_LIBRARIES
        if is_own and not is_of_node and not any(_uses(node, remap) for node in process.nodes):
            known = [str(end.written) for node in process.nodes for end in node.endpoints]
            yield _hit(process, f'remap {remap}', remap.old, known, process.launched.source)


def _uses(node: SystemNode, remap: Remap) -> bool:
    naming = node.naming
    assert naming is not None
    if remap.node not in (None, naming.own_name):
        return False
    whole = expanded(remap.old, naming.namespace, naming.name)
    names = (expanded(str(e.written), naming.namespace, naming.name) for e in node.endpoints)
    # A rule may name one of the services and topics of an action, or of a library's own.
    return any(name == whole or whole.startswith(f'{name}/') for name in names)


def _parameters(process: Process) -> Iterator[Hit]:
    known: list[str] = []
    for node in process.nodes:
        if node.parameters is None:
            return
        known += node.parameters
    for each in process.launched.parameters:
        is_for_all = each.node == ANY_NODE
        is_own = each.source == process.launched.source if is_for_all else _is_meant(each, process)
        is_used = each.name in known or each.name in _OF_RCLPY
        if is_own and not is_used and not each.name.startswith('qos_overrides.'):
            place = process.launched.source if is_for_all else each.source
            yield _hit(
                process,
                f'parameter {each.name}',
                each.name,
                known,
                place or process.launched.source,
            )


def _is_meant(parameter: object, process: Process) -> bool:
    pattern = str(getattr(parameter, 'node', ''))
    return any(isinstance(n.name, str) and matches(pattern, n.name) for n in process.nodes)


def _hit(process: Process, what: str, name: str, known: Sequence[str], place: Place) -> Hit:
    near = get_close_matches(name, known, n=1)
    nodes = ', '.join(str(node.name) for node in process.nodes)
    return Hit(
        place=place,
        message=f'{what}: no code of {nodes} uses that' + (f', but {near[0]!r}' if near else ''),
        help=f'write {near[0]}' if near else 'leave it out, or use it in the code',
        severity=Severity.WARNING if near else None,
        subjects=(process.name, name),
    )


RULE = Rule(
    code='CC706',
    slug='unused-setting',
    severity=Severity.NOTE,
    title='Remap or parameter of the launch file that no code uses',
    what='A launch file remaps a name that no node of the process uses, or sets a parameter that '
    'none of them declares or asks for, and all code of the process is known. A warning where '
    'nearly the same name is used, a note elsewhere.',
    why='A rule that matches nothing is ignored without a word, and so is a parameter that a node '
    'does not declare. Source: design.ros2.org, "Remapping Names"; rclpy 7.1.6, `node.py` '
    '(`declare_parameters`: only declared parameters take what is set).',
    bad="""\
Node(package='arm', executable='driver', parameters=[{'max_speeed': 2.0}])   # declares max_speed
""",
    good="""\
Node(package='arm', executable='driver', parameters=[{'max_speed': 2.0}])
""",
    mend='Write the name as the code has it, leave it out, or use it in the code.',
)
