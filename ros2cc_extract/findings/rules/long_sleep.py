"""CC201: a long ``time.sleep`` in a callback that keeps others waiting."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.model import Remark
from ros2cc_extract.findings.rule import Context, Hit, Rule
from ros2cc_extract.findings.waits import Wait, WaitKind, waits_of
from ros2cc_extract.findings.words import group_words, made_at, plural, served_at, shown
from ros2cc_extract.findings.workers import honours_groups, is_one_thread
from ros2cc_extract.spec.model import EntityKind

LONG_SLEEP_S = 1.0
"""From here on a sleep counts as long: our choice."""
LISTED = 5
"""How many of the other sleeps are shown."""


def find(context: Context) -> Iterator[Hit]:
    """One finding per callback, at its longest sleep; execute callbacks are CC203's."""
    long_sleeps = (wait for wait in waits_of(context) if _is_long(wait))
    for _name, sleeps in groupby(long_sleeps, key=lambda wait: wait.caller.name):
        yield from _hits(tuple({wait.place: wait for wait in sleeps}.values()), context)


def _is_long(wait: Wait) -> bool:
    is_execute = wait.caller.entity is EntityKind.ACTION_EXECUTE
    return wait.kind is WaitKind.SLEEP and not is_execute and _seconds(wait) >= LONG_SLEEP_S


def _seconds(wait: Wait) -> float:
    return wait.block.seconds if isinstance(wait.block.seconds, float) else 0.0


def _hits(sleeps: Sequence[Wait], context: Context) -> Iterator[Hit]:
    wait = max(sleeps, key=_seconds)
    executor = context.unit.executor
    if is_one_thread(executor):
        others = tuple(c for c in context.written if c != wait.caller)
        held = f'the only thread of the {executor.kind or "executor"}'
    else:
        group = context.exclusive_group(wait.caller)
        if group is None or not group.default or not honours_groups(executor):
            return
        others = tuple(c for c in context.written if c.group == group.name and c != wait.caller)
        held = group_words(group)
    stopped = [*([shown(others)] if others else []), 'the parameter services']
    more = sorted((s for s in sleeps if s is not wait), key=lambda sleep: sleep.place)
    yield Hit(
        place=wait.place,
        message=f'{wait.caller.display_name} sleeps {_seconds(wait):g} s{_how_often(more)} and '
        f'holds {held}: {" and ".join(stopped)} of the node wait that long',
        help='let a timer go on after the pause'
        + ('' if is_one_thread(executor) else ', or give the callback a group of its own'),
        subjects=(wait.caller.name,),
        chain=wait.chain,
        related=(*made_at(wait.caller), *served_at(executor, wait.place), *_listed(more)),
    )


def _how_often(more: Sequence[Wait]) -> str:
    """A run may take one branch of several: what it sleeps in all is not known."""
    if not more:
        return ''
    return f' here, {LONG_SLEEP_S:g} s or longer at {plural(len(more), "more place")},'


def _listed(more: Sequence[Wait]) -> Iterator[Remark]:
    for wait in more[:LISTED]:
        yield Remark(wait.place, f'{wait.caller.display_name} sleeps {_seconds(wait):g} s here')


RULE = Rule(
    code='CC201',
    slug='long-sleep',
    severity=Severity.WARNING,
    title='Long sleep in a callback that others wait for',
    what='A callback sleeps for a second or longer while it holds the only thread, or the '
    'default group of its node. Everything else there waits, also the parameter services: '
    '`ros2 param` hangs. A callback has one finding, at the longest of its sleeps.',
    why='Every node has six parameter services and a type-description service in its default '
    'group, which is mutually exclusive. On one thread no group helps. Sources: rclpy 7.1.6 and '
    '9.1.2, `node.py`, `parameter_service.py`, `executors.py`. What counts as long, one second, '
    'is our choice.',
    bad="""\
class Arm(Node):
    def on_dock(self, request, response):
        self.publish_speed(0.1)
        time.sleep(5.0)
        self.publish_speed(0.0)
        return response
""",
    good="""\
class Arm(Node):
    def on_dock(self, request, response):
        self.publish_speed(0.1)
        self.timer = self.create_timer(5.0, self.stop)   # stop() cancels the timer
        return response
""",
    mend='Do the second half in a timer callback; or give the callback a group of its own on a '
    'multi-threaded executor.',
    find=find,
)
