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
    title='Wait for an answer while nothing spins the node',
    what='Code outside callbacks waits for the answer of a service or an action, or for an '
    'event, a queue or a future that a callback would end, and no other thread spins the node '
    'that must take the answer or, if both are in one program, the node that must send it. The '
    'wait never ends. The same holds where it waits for a thread or a job, or for what one of '
    'these does, that is itself in such a wait; for `Rate.sleep` on a node that was never spun; '
    'for a service or an action server that the program itself makes only behind the wait; in a '
    'loop for simulated time or a transform, which only a subscription brings; '
    'and for '
    '`Thread.join` on a thread that is in a wait which only callbacks end: after the spin, or '
    'after the shutdown of the executor that another thread spins; if that thread runs a loop, '
    'it is a warning. Also reported: a join where only a thread that was joined before could end '
    'the wait, or what comes behind the join, or where a lock is held that the thread takes; a '
    'join before rclpy is shut down, or an end without a shutdown, where the thread runs while '
    '`rclpy.ok()` and the spin has ended by itself; the end of the program where such a thread, '
    'or one that never checks whether to stop, is not a daemon or works for a pool; such an end '
    'where the thread only ends by a function that `atexit` calls, or waits in its loop for what '
    'others have stopped to give, or runs a loop of asyncio or a server that nothing stops; and a '
    '`threading.Timer` that is not a daemon and restarts itself in each run, because a `cancel` '
    'while its function runs has no effect.',
    why='`Client.call` and a loop until `future.done()` do not spin: the executor of the '
    "client's node takes the answer, and that of the server's node takes the request; a timer of "
    'the node ends `Rate.sleep`. Reported only if every spin of the program is known. '
    'Sources: rclpy 7.1.6 and 9.1.2, `client.py` (`Client.call`), `timer.py` (`Rate.sleep`), '
    '`__init__.py` (`spin_until_future_complete` spins the given node alone). Measured on 7.1.6: '
    'neither an answer nor the end of a rate of 2 Hz within 5 s; a service that the same node has '
    'made before is there without a spin, one that it makes later never; with `use_sim_time` the '
    'clock stands still while `/clock` is published. `TransformListener` has a thread of its own '
    'only with `spin_thread=True` (geometry2 0.39.1, `transform_listener.py`). '
    'The interpreter joins threads '
    'that are not daemons, and those of pools (CPython 3.12, `threading.py`, `_shutdown`; '
    '`concurrent/futures/thread.py`, `_python_exit`); measured: such a program outlives Ctrl-C, '
    'and it calls the functions of `atexit` behind the threads (CPython 3.11).',
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
    title='Lock not released on one path',
    what='A function takes a lock by `acquire()` and releases it by `release()`, but leaves on '
    'some path without doing so. The next callback that takes the lock waits forever, and keeps '
    'its thread and its group.',
    why='Only `release()` releases a `threading.Lock`. All paths through the function are '
    'checked; of exceptions only those that the function raises itself and a caller catches. '
    'Lock classes of the program, with methods such as '
    '`acquire_read` and `release_read`, are checked too, and methods of a class that do nothing '
    'with a lock of it but take it, or give it back (`gate.begin()`, `gate.end()`). '
    'A callback that waits for a lock releases nothing. Sources: Python, `threading`; rclpy 7.1.6 '
    'and 9.1.2, `executors.py` (`_make_handler`).',
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
    what='A coroutine that asyncio runs, such as a callback of an `AsyncNode`, awaits an rclpy '
    'future. From rclpy 3.3.21 (Humble), '
    '7.1.9 (Jazzy), 9.1.4 (Kilted) and 10.0.3 (Rolling) on this raises '
    '`RuntimeError: Task got bad yield` when the future is not done yet.',
    why='`Future.__await__` yielded `None`, which asyncio reads as "ask again"; now it yields '
    'the future itself, which only rclpy executors understand. Sources: rclpy 7.1.6 and 9.1.2, '
    '`task.py` (`Future.__await__`); ros2/rclpy issue 1588, pull requests 1469 and 1560. '
    'Measured on 7.1.6: it works; with the new `__await__` it raises, and on 10.0.10 and 11.0.0 '
    'it ends an `AsyncNode`.',
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
