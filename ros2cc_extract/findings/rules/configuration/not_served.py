"""CC407: a node that no executor ever serves."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePath

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import listing, shown
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.client_server_pairs import is_client
from ros2cc_extract.spec.model import NO_EXECUTOR

EXECUTOR = 'executor'
_HIDING = frozenset({'entities', 'node', 'function'})
"""Facts that, if missing, may hide what serves a node."""


def find(context: Context) -> Iterator[Hit]:
    if not is_not_served(context):
        return
    unit = context.unit
    kind = unit.executor.kind
    place = kind.at if isinstance(kind, Unknown) else None
    it = 'it' if len(unit.nodes) == 1 else 'them'
    yield Hit(
        place=place or context.home(),
        message=f'no executor serves {listing(unit.nodes)}, and nothing spins {it}: '
        f'{shown(context.written)} never run{"s" if len(context.written) == 1 else ""}',
        help='add the node to the executor that is spun',
        subjects=unit.nodes,
    )


def is_not_served(context: Context) -> bool:
    """
    True where a program was followed to its end, and its node is in no executor.

    A test may well call the functions of a node by itself; a client alone has nothing to run,
    and a wait for its answer is reported where it waits.
    """
    unit = context.unit
    kind = unit.executor.kind
    if not isinstance(kind, Unknown) or kind.reason != NO_EXECUTOR or unit.entry is None:
        return False
    idle = all(is_client(callback) for callback in context.written)
    if not unit.nodes or idle or _is_test(unit.entry):
        return False
    if kind.at is None or kind.at.file != unit.entry.rpartition(':')[0]:
        return False  # a framework made it, and serves it in ways of its own
    return not any(fact.fact in _HIDING for fact in unit.unresolved)


def _is_test(entry: str) -> bool:
    file, _, function = entry.rpartition(':')
    path = PurePath(file)
    in_tests = any(part in ('test', 'tests') for part in path.parts[:-1])
    is_named_so = path.name.startswith(('test_', 'conftest')) or path.stem.endswith('_test')
    return in_tests or is_named_so or function.rpartition('.')[2].startswith('test')


RULE = Rule(
    code='CC407',
    slug='not-served',
    severity=Severity.WARNING,
    title='Node that no executor serves',
    what='A program creates a node with callbacks and was followed to its end, but neither adds '
    'the node to an executor that is spun nor spins it. None of its callbacks ever runs.',
    why='Callbacks run in an executor, and an executor serves only the nodes that were added to '
    'it. Sources: rclpy 7.1.6 and 9.1.2, `executors.py` (`add_node`, '
    '`_wait_for_ready_callbacks`), `__init__.py` (`spin`).',
    bad="""\
arm, leg = Arm(), Leg()
executor = SingleThreadedExecutor()
executor.add_node(arm)
executor.spin()
""",
    good="""\
arm, leg = Arm(), Leg()
executor = SingleThreadedExecutor()
executor.add_node(arm)
executor.add_node(leg)
executor.spin()
""",
    mend='Add the node to the executor that is spun.',
    find=find,
)
