"""CC106: ``rclpy.spin…(node)`` inside a callback of that node."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at, served_at, shown
from ros2cc_extract.findings.waits.verdicts import NODE_KEPT, refuting_run
from ros2cc_extract.findings.waits.waits import (
    Wait,
    WaitKind,
    callers_of,
    waits_of,
    ways_of_others,
)
from ros2cc_extract.findings.waits.workers import SINGLE
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Callback, GroupType, Spec
from ros2cc_extract.spec.node_moves import named_executor
from ros2cc_extract.spec.releases.table import NODE_STAYS, SPIN_REFUSED_TWICE


def find(context: Context) -> Iterator[Hit]:
    alike: dict[object, list[Wait]] = {}
    for wait in waits_of(context):
        is_of_node = wait.block.on is None or wait.block.on in context.unit.nodes
        if wait.kind is WaitKind.SPIN and is_of_node and not is_executor_call(wait):
            key = (wait.place, wait.block.call, wait.block.on, _consequence(wait, context))
            alike.setdefault(key, []).append(wait)
    for waits in alike.values():
        yield _hit(waits, context)


def is_executor_call(wait: Wait) -> bool:
    """True for ``executor.spin_once()`` and its kin, which name an executor themselves."""
    return wait.block.call.startswith('executor.')


def _hit(waits: Sequence[Wait], context: Context) -> Hit:
    """One for all callbacks that come to this line: mended there, it is mended for all."""
    unit, wait = context.unit, waits[0]
    is_own, callers = wait.block.on in unit.nodes, callers_of(waits)
    names = shown(each.caller for each in waits)
    calls, where = ('calls', 'a callback') if len(callers) == 1 else ('call', 'callbacks')
    node = f'node {wait.block.on!r}' if is_own else 'a node that could not be followed'
    return Hit(
        place=wait.place,
        message=f'{names} {calls} {wait.block.call} on {node} inside {where}: '
        f'{_consequence(wait, context)}',
        help='do not spin in a callback: use call_async and continue in a done-callback, or await '
        'in a coroutine callback, with what it awaits in another group',
        severity=_severity(wait, unit, is_own),
        subjects=callers,
        chain=wait.chain,
        related=(
            *made_at(wait.caller),
            *served_at(unit.executor, wait.place),
            *dict.fromkeys(ways_of_others(waits)),
        ),
        run=refuting_run(NODE_KEPT, context, wait.caller),
    )


def _consequence(wait: Wait, context: Context) -> str:
    unit = context.unit
    if _is_named(wait):
        return 'the node leaves the executor it is in, and none of its callbacks runs again'
    if isinstance(unit.executor.kind, Unknown):
        return (
            'with its own executor, the node leaves that executor and none of its callbacks '
            'runs again; under rclpy.spin, other callbacks run inside this one'
        )
    if is_global(unit) and not _loses_node(unit):
        return _spun_twice(wait.caller, context)
    return f'the node leaves its {unit.executor.kind}, and none of its callbacks runs again'


def _spun_twice(caller: Callback, context: Context) -> str:
    refused = SPIN_REFUSED_TWICE.holds(context.unit.rclpy)
    if refused:
        return 'it raises RuntimeError, because that executor is already spinning'
    inside = _runs_inside(caller, context)
    if refused is None:
        return f'{inside}, and from rclpy 7.1.9 on the executor refuses to be spun twice'
    return inside


def _runs_inside(caller: Callback, context: Context) -> str:
    group = context.group_of(caller)
    is_open = group.type is GroupType.REENTRANT and group.unresolved is None
    if caller.groupless or is_open:
        return 'callbacks of the node run inside this one'
    return 'callbacks of other groups run inside this one, members of its own group do not'


def _is_named(wait: Wait) -> bool:
    """True where it names another executor than the one that serves the node."""
    return named_executor(wait.block, wait.caller) is not None


def _severity(wait: Wait, unit: Spec, is_own: bool) -> Severity | None:
    if not is_own:
        return Severity.NOTE
    is_known = not isinstance(unit.executor.kind, Unknown)
    is_refused = SPIN_REFUSED_TWICE.holds(unit.rclpy) is True
    is_lost = not is_global(unit) or _loses_node(unit) or _is_named(wait)
    is_certain = is_known and (is_lost or is_refused)
    return None if is_certain else Severity.WARNING


def _loses_node(unit: Spec) -> bool:
    """True in old releases, which took the node out of the global executor as well."""
    return NODE_STAYS.holds(unit.rclpy) is False


def is_global(unit: Spec) -> bool:
    """True when the unit is run by ``rclpy.spin(node)``, the executor that nested spins use."""
    executor = unit.executor
    return (executor.spun or '').startswith('rclpy.') and executor.kind == SINGLE


RULE = Rule(
    code='CC106',
    slug='nested-spin',
    severity=Severity.ERROR,
    title='Node spun inside its own callback',
    what='A callback calls `rclpy.spin_until_future_complete`, `rclpy.spin_once` or `rclpy.spin` '
    'on the node it belongs to.',
    why='These functions add the node to the global executor, or to the one that `executor=` '
    'names, which removes it from its current executor, and remove it again afterwards. Then the '
    'node is in no executor, and none of its callbacks runs again. Under plain `rclpy.spin` it '
    'is the same executor: callbacks of other groups run inside this one, members of its own '
    'group do not. Before 3.3.15 (Humble) and 7.1.2 (Jazzy) the node was lost there too; from '
    '7.1.9 on this raises `RuntimeError: Executor is already spinning`. Sources: rclpy 7.1.6 and '
    '9.1.2, `__init__.py` (`spin_until_future_complete`), `node.py` (setter of `executor`), '
    '`executors.py` (`add_node`). Measured: a timer fires once instead of about 20 times.',
    bad="""\
class Arm(Node):
    def on_timer(self):
        future = self.client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self, future)
        self.use(future.result())
""",
    good="""\
class Arm(Node):
    def on_timer(self):
        future = self.client.call_async(Trigger.Request())
        future.add_done_callback(lambda done: self.use(done.result()))
""",
    mend='Never spin inside a callback. Continue in a done-callback, or make the callback a '
    'coroutine, await the future, and keep the client in another group.',
    find=find,
)
