"""
Rules that speak for what the extractor itself notices.

Each takes over the diagnostics of its slug; only the help text is here.
"""

from __future__ import annotations

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Rule

NOT_SPUN = Rule(
    code='CC405',
    slug='executor-not-spun',
    severity=Severity.WARNING,
    title='Executor never spun',
    what='An executor is created and given nodes, but never spun; another executor runs the '
    'nodes, or none does. Most often `rclpy.spin(node)` is called where `executor.spin()` was '
    'meant, and everything runs on one thread.',
    why='`rclpy.spin(node)` adds the node to the global single-threaded executor, which removes '
    'it from its previous executor. Sources: rclpy 7.1.6 and 9.1.2, `__init__.py` (`spin`), '
    '`node.py` (setter of `executor`).',
    bad="""\
executor = MultiThreadedExecutor()
executor.add_node(node)
rclpy.spin(node)
""",
    good="""\
executor = MultiThreadedExecutor()
executor.add_node(node)
executor.spin()
""",
    mend='Call `executor.spin()`, or `rclpy.spin(node, executor=executor)`.',
)
TAKEN_OUT = Rule(
    code='CC406',
    slug='node-taken-out',
    severity=Severity.WARNING,
    title='Node removed from its executor',
    what='A node that one executor serves is given to another one. A node is in one executor '
    'only: the one that added it last. After `rclpy.spin_until_future_complete` or '
    '`rclpy.spin_once` it is in none. This rule checks code that `main` or a thread runs beside '
    'a spin, and code that is passed to others, such as the handlers of a window.',
    why='`add_node` sets `node.executor`, and that setter removes the node from its previous '
    'executor. Sources: rclpy 7.1.6 and 9.1.2, `node.py`, `executors.py`.',
    bad="""\
threading.Thread(target=executor.spin).start()
rclpy.spin_until_future_complete(node, future)   # the node leaves the executor
""",
    good="""\
threading.Thread(target=executor.spin).start()
future.add_done_callback(lambda done: answered.set())
answered.wait()
""",
    mend='Spin a node by the executor that serves it, and by one thread only: where that spins '
    'already, wait for the future by an `Event` that its done-callback sets.',
)
MESSAGE_TAKEN = Rule(
    code='CC122',
    slug='message-taken',
    severity=Severity.WARNING,
    title='Message that an executor may take first',
    what='`wait_for_message` is called with a node that an executor spins at the same time: in '
    '`main` or a thread beside the spin, in a callback of another executor, or in one that lets '
    'the pool run the default group of the node. If the group is closed meanwhile, or the only '
    'thread is the one that waits, the executor takes nothing.',
    why='`wait_for_message` creates a subscription of the node and uses its own wait set. The '
    'executor that spins the node sees the subscription too, and whichever comes first takes the '
    'message. Then `wait_for_message` returns `(False, None)`, long before any time-out, or '
    'waits for the next message; a latched topic has none. Measured: `main` read twelve latched '
    'topics with a node that a thread spun, and hung in four of four runs (after one to nine of '
    'them, when it was killed after 25 s); with a node that nothing spun it got all. Sources: '
    'rclpy 7.1.6 and 9.1.2, `wait_for_message.py`, `executors.py` (`_take_subscription`).',
    bad="""\
threading.Thread(target=rclpy.spin, args=(node,)).start()
got, grid = wait_for_message(OccupancyGrid, node, 'map')
""",
    good="""\
threading.Thread(target=rclpy.spin, args=(node,)).start()
probe = rclpy.create_node('probe')       # nobody spins it
got, grid = wait_for_message(OccupancyGrid, probe, 'map', time_to_wait=10.0)
""",
    mend='Wait with a node of its own that nobody spins, or before the spin begins; or subscribe '
    'and wait for an `Event` that the callback sets.',
)
UNREADABLE = Rule(
    code='CC500',
    slug='unreadable',
    severity=Severity.ERROR,
    title='Not read, or not followed to its end',
    what='A file is not UTF-8 text, is not valid Python, or could not be opened: nothing in it '
    'was checked. Or the model of a unit could not be used, which is a bug in this tool: the '
    'other units were verified. As a warning: a program is too long to be followed to its end, '
    'or creates entities of an object that is not known to be a node; they are missing from the '
    'units. Or a callback does not take what rclpy passes to it: each call raises TypeError, and '
    'what it does is not looked at.',
    why='The scanner reads source by the syntax of the Python version it runs on.',
    bad="""\
def on_timer(self:
""",
    good="""\
def on_timer(self): ...
""",
    mend='Mend the file, or exclude it. Of a program that is too long check the files that make '
    'its nodes by themselves, or observe it by `ros2cc-extract run`.',
)
UNUSED_IGNORE = Rule(
    code='CC502',
    slug='unused-ignore',
    severity=Severity.WARNING,
    title='Suppression that suppresses nothing',
    what='A comment `# ros2cc: ignore[...]` names a rule that finds nothing at that line, or a '
    'rule that does not exist.',
    why='A suppression that outlives its finding would hide the next one.',
    bad="""\
x = 1  # ros2cc: ignore[CC101] answered by another process
""",
    good="""\
x = 1
""",
    mend='Remove the comment, or correct the code in it.',
)
