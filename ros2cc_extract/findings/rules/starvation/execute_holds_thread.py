"""CC203: cancel requests that are not taken while a goal is executed."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at, served_at
from ros2cc_extract.findings.waits.waits import Wait, WaitKind, waits_of
from ros2cc_extract.findings.waits.workers import is_one_thread
from ros2cc_extract.spec.effects import ABORTS, TURN
from ros2cc_extract.spec.model import Callback, EntityKind
from ros2cc_extract.spec.program_order import steps


def find(context: Context) -> Iterator[Hit]:
    """One finding per execute callback, at its first sleep; else where its server waits for it."""
    yield from _of_servers(context)
    if not is_one_thread(context.unit.executor):
        return
    first: dict[str, Wait] = {}
    for wait in waits_of(context):
        is_execute = wait.caller.entity is EntityKind.ACTION_EXECUTE
        gives_way = any(block.call == TURN for block in wait.caller.blocking)
        if is_execute and wait.kind is WaitKind.SLEEP and not gives_way:
            first.setdefault(wait.caller.name, wait)
    for wait in first.values():
        yield _hit(wait, context)


def _of_servers(context: Context) -> Iterator[Hit]:
    """Callbacks of an action server that keep its group until a goal has been executed."""
    first: dict[str, tuple[Wait, Callback]] = {}
    for wait in waits_of(context):
        is_server = wait.caller.entity is EntityKind.ACTION_SERVER and not wait.has_timeout
        if is_server and context.exclusive_group(wait.caller) is not None:
            execute = _executing(wait, context)
            if execute is not None and not _stops_it(wait, execute):
                first.setdefault(wait.caller.name, (wait, execute))
    for wait, execute in first.values():
        yield _hit_of_server(wait, execute, context)


def _executing(wait: Wait, context: Context) -> Callback | None:
    """The execute callback of the same server that alone ends the wait, when it has waited."""
    by = {waker.by for waker in wait.block.wakers}
    ended = [each for each in context.written if each.name in by]
    if len(by) != 1 or len(ended) != 1 or wait.block.escapes is not None:
        return None
    execute, server = ended[0], wait.caller
    is_own = execute.entity is EntityKind.ACTION_EXECUTE
    is_own = is_own and (execute.node, execute.key) == (server.node, server.key)
    is_late = all(waker.after is None or waker.after > 0 for waker in wait.block.wakers)
    return execute if is_own and is_late and execute.blocking else None


def _stops_it(wait: Wait, execute: Callback) -> bool:
    """Whether the server has aborted the goal by then, or changed what that may look at."""
    server, end = wait.caller, steps(wait.block)
    if any(act.name == ABORTS for act in server.changes):
        return True
    if any(waker.by == server.name for block in execute.blocking for waker in block.wakers):
        return True
    read = {access.name for access in execute.reads}
    return any(write.name in read and steps(write) < end for write in server.writes)


def _hit_of_server(wait: Wait, execute: Callback, context: Context) -> Hit:
    group = context.exclusive_group(wait.caller)
    held = group.display_name if group is not None else 'its group'
    return Hit(
        place=wait.place,
        message=f'{wait.caller.display_name} waits in {wait.block.call} until '
        f'{execute.display_name} has executed a goal, and holds {held}: no cancel '
        'request and no other goal is handled until then',
        help='keep the goals in a queue and return: let the end of one execute the next one',
        subjects=(wait.caller.name,),
        chain=wait.chain,
        related=tuple(made_at(wait.caller)),
    )


def _hit(wait: Wait, context: Context) -> Hit:
    kind = context.unit.executor.kind or 'executor'
    return Hit(
        place=wait.place,
        message=f'{wait.caller.display_name} sleeps while it executes a goal on the only thread '
        f'of the {kind}: no cancel request and no other goal is handled until it ends',
        help='serve the action with a MultiThreadedExecutor of at least two threads',
        subjects=(wait.caller.name,),
        chain=wait.chain,
        related=(*made_at(wait.caller), *served_at(context.unit.executor, wait.place)),
    )


RULE = Rule(
    code='CC203',
    slug='execute-holds-thread',
    severity=Severity.WARNING,
    title='Execute callback holds the only thread',
    what='The execute callback of an action server sleeps, on an executor with one thread. A '
    'cancel request is taken only when it has ended, so `is_cancel_requested` stays false. Or '
    'another callback of the server (`handle_accepted_callback`, `goal_callback`) waits in a '
    'mutually exclusive group until a goal has been executed, without a request to stop it.',
    why='The waitable of the action server takes the cancel request; the executor must run it, '
    'and its only thread executes the goal. A coroutine that yields between its sleeps (`await '
    'asyncio.sleep(0)`, or a bare `yield` behind an `__await__`) lets it run. With two threads '
    'the cancel request arrives at once, with any groups, because execute runs as a '
    'task outside them; the goal, cancel and accepted callbacks of a server run in its group, '
    'one after the other. Sources: rclpy 7.1.6 and 9.1.2, `action/server.py` (`notify_execute`), '
    '`executors.py`.',
    bad="""\
class Mover(Node):
    def execute(self, goal_handle):
        while not goal_handle.is_cancel_requested and not self.has_arrived():
            time.sleep(0.1)

rclpy.spin(Mover())
""",
    good="""\
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(Mover())
executor.spin()
""",
    mend='Use a `MultiThreadedExecutor` of at least two threads.',
    find=find,
)
