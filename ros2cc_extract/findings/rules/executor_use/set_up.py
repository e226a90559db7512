"""
Rules that speak for what the extractor notices outside callbacks: locks, waits, asyncio.

Each takes over the diagnostics of its slug; only the help text is here.
"""

from __future__ import annotations

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Rule
from ros2cc_extract.spec.releases.table import FUTURE_YIELDS_ITSELF

NOBODY_SPINS = Rule(
    code='CC110',
    slug='nobody-spins',
    severity=Severity.ERROR,
    title='Wait for an answer while nobody spins',
    what='Code outside callbacks waits for the answer of a service or an action, or for an '
    'event, a queue or a future that a callback would end, and no other thread spins the node '
    'that must take it or, where both are in one program, the node that must give it. The wait '
    'never ends. The same for `Rate.sleep` on a node that nobody has spun, and for `Thread.join` '
    'on a thread that stands in a wait which only callbacks end: after the spin, or after the '
    'executor that another thread spins is shut down, where the thread goes round in a loop, that '
    'is a warning. So is a join where only a thread that was joined before ended the wait; and '
    'the end of the program where such a thread, or one that never asks whether to stop, is no '
    'daemon or works for a pool; and a `threading.Timer`, no daemon, that arms itself anew in '
    'each run: a `cancel` while its function runs ends nothing.',
    why='`Client.call` and a loop until `future.done()` spin nothing: the answer is taken by the '
    "executor of the client's node, and a request by that of the server's; a timer of the node "
    'ends `Rate.sleep`. Said only where every spin of the program is in sight. Sources: rclpy '
    '7.1.6 and 9.1.2, `client.py` (`Client.call`), `timer.py` (`Rate.sleep`), `__init__.py` '
    '(`spin_until_future_complete` spins the given node alone). Measured on 7.1.6: neither an '
    'answer nor the end of a rate of 2 Hz within 5 s. The interpreter joins threads that are no '
    'daemons, and those of pools (CPython 3.12, `threading.py`, `_shutdown`; '
    '`concurrent/futures/thread.py`, `_python_exit`); measured: such a program outlives Ctrl-C.',
    bad="""\
def main():
    rclpy.init()
    node = Asker()
    node.client.call(Trigger.Request())     # before anything spins
    rclpy.spin(node)
""",
    good="""\
def main():
    rclpy.init()
    node = Asker()
    future = node.client.call_async(Trigger.Request())
    rclpy.spin_until_future_complete(node, future)
    rclpy.spin(node)
""",
    mend='Spin while you wait, by `rclpy.spin_until_future_complete`; or let one thread spin an '
    'executor that has all nodes concerned, from before the wait on. Wake a thread before you '
    'join it: put a last item into its queue, or notify its condition after its flag has changed '
    'and let the predicate ask for the flag. A thread that need not finish may be a daemon.',
)
LOCK_KEPT = Rule(
    code='CC112',
    slug='lock-kept',
    severity=Severity.ERROR,
    title='Lock kept on one way out',
    what='A function takes a lock by `acquire()` and gives it back by `release()`, but leaves on '
    'some way without doing so. The next callback that takes the lock waits for ever, and keeps '
    'its thread and its group.',
    why='A `threading.Lock` is given back by `release()` alone. The ways through the text are '
    'looked at, exceptions left out. Also said of a lock class of the program, with methods such '
    'as `acquire_read` and `release_read`. A callback that waits for a lock gives nothing back. '
    'Sources: Python, `threading`; rclpy 7.1.6 and 9.1.2, `executors.py` (`_make_handler`).',
    bad="""\
class Base(Node):
    def on_velocity(self, msg):
        self.mode_lock.acquire()
        if self.mode != 'navigation':
            return
        self.drive(msg)
        self.mode_lock.release()
""",
    good="""\
class Base(Node):
    def on_velocity(self, msg):
        with self.mode_lock:
            if self.mode == 'navigation':
                self.drive(msg)
""",
    mend='Write `with lock:`, or `try:` with the release in its `finally:`.',
)
ASYNCIO_AWAIT = Rule(
    code='CC114',
    slug='asyncio-await',
    severity=Severity.WARNING,
    title='rclpy future awaited by asyncio',
    what='A coroutine that asyncio runs awaits an rclpy future. From rclpy 3.3.21 (Humble), '
    '7.1.9 (Jazzy), 9.1.4 (Kilted) and 10.0.3 (Rolling) on this raises '
    '`RuntimeError: Task got bad yield` when the future is not done yet.',
    why='`Future.__await__` yielded `None`, which asyncio takes as "ask again"; now it yields the '
    'future itself, which only rclpy executors understand. Sources: rclpy 7.1.6 and 9.1.2, '
    '`task.py` (`Future.__await__`); ros2/rclpy issue 1588, pull requests 1469 and 1560. Measured '
    'on 7.1.6: it works; with the new `__await__` it raises.',
    bad="""\
async def main():                        # a thread spins the node
    answer = await node.client.call_async(Trigger.Request())

asyncio.run(main())
""",
    good="""\
async def main():
    loop = asyncio.get_running_loop()
    answered = loop.create_future()
    future = node.client.call_async(Trigger.Request())
    future.add_done_callback(
        lambda done: loop.call_soon_threadsafe(answered.set_result, done.result()))
    answer = await answered
""",
    mend='Await rclpy futures in callbacks and executor tasks only. In asyncio, await an asyncio '
    'future that a done-callback sets by `loop.call_soon_threadsafe`.',
    since=FUTURE_YIELDS_ITSELF,
)
