"""
What releases of rclpy, and of Python, do otherwise than others: one row for each behaviour.

The generator, the rules, ``upgrade`` and ``docs/releases.md`` read this table and nothing else: a
new release is a number in a row. Sources are the change logs of rclpy and the files of 3.3.10,
3.3.21, 7.1.6, 7.1.9, 7.1.11, 9.1.2, 9.1.5, 10.0.10 and 11.0.0. *Seen* on 7.1.6 and 9.1.2 means the
wheels, on others what ``make releases`` builds; programs and answers are in ``tests/releases``.
"""

from __future__ import annotations

from ros2cc_extract.spec.releases.behaviour import Behaviour

TASKS_OLDEST_FIRST = Behaviour(
    name='tasks-oldest-first',
    concerns='which of several tasks is served first',
    without='the task that was made last is served first',
    having='the task that was made first is served first',
    since={3: (3, 3, 21), 4: (5, 0, 0), 7: (7, 1, 9), 8: (8, 0, 0)},
    source='ros2/rclpy pull request 1469, `executors.py` (`_wait_for_ready_callbacks`)',
    observed='two tasks made in one callback: the second runs first on 7.1.6, and last on 3.3.21, '
    '7.1.11, 9.1.2, 9.1.5 and 11.0.0',
)
FUTURE_YIELDS_ITSELF = Behaviour(
    name='future-wakes',
    concerns='what wakes the executor for a coroutine that awaits a future',
    without='nothing: each lap of the executor asks the coroutine whether it can go on',
    having='any thread that completes the future, also your own; asyncio refuses the future',
    since={3: (3, 3, 21), 7: (7, 1, 9), 9: (9, 1, 4), 10: (10, 0, 3)},
    source='ros2/rclpy pull requests 1469 and 1560, `task.py` (`Future.__await__`)',
    observed='a thread makes the future done while nothing else happens: the callback goes on '
    'after 0.1 s on 9.1.5, and never on 7.1.6 and 9.1.2',
)
UNTIL_ASKS_FUTURE = Behaviour(
    name='until-asks-future',
    concerns='when a spin until a future ends that another thread completes',
    without='once a callback was served after that, or its time is over',
    having='at once',
    since={5: (5, 0, 1)},
    source='ros2/rclpy pull request 1143, `executors.py` (`spin_once_until_future_complete`, '
    '`wait_for_ready_callbacks`)',
    observed='a thread makes the future done while nothing else happens: the spin never ends on '
    '3.3.21, and ends on 7.1.6 and 9.1.2',
)
EXCEPTION_AFTER_AWAIT_LOST = Behaviour(
    name='exception-after-await-lost',
    concerns='where an exception goes that a coroutine raises behind an `await`',
    without='it ends the spin',
    having='a `SingleThreadedExecutor` loses it and spins on; with several threads it ends the '
    'spin',
    since={3: (3, 3, 21), 7: (7, 1, 9), 9: (9, 1, 4), 10: (10, 0, 3)},
    until={3: (3, 3, 22), 10: (10, 0, 10)},
    source='ros2/rclpy pull requests 1469 and 1643, `task.py` (`Task.__call__`)',
    observed='a timer awaits and raises: lost on 3.3.21, 7.1.11 and 9.1.5, raised on 7.1.6, '
    '9.1.2 and 11.0.0',
)
SPIN_REFUSED_TWICE = Behaviour(
    name='spin-refused-twice',
    concerns='which executors refuse to be spun a second time',
    without='none: a spin inside a callback serves others meanwhile',
    having='an executor that spins raises `RuntimeError: Executor is already spinning`',
    since={7: (7, 1, 9), 9: (9, 1, 5), 10: (10, 0, 1)},
    source='ros2/rclpy pull request 1510, `executors.py` (`spin`, `spin_once`)',
    observed='`rclpy.spin_once` in a callback under `rclpy.spin`: `RuntimeError` on 7.1.11, '
    '9.1.5 and 11.0.0, not on 3.3.21, 7.1.6 and 9.1.2',
)
NODE_STAYS = Behaviour(
    name='node-stays',
    concerns='where a node is after `rclpy.spin_until_future_complete` in one of its callbacks',
    without='in no executor, not even in the global one',
    having='in the global executor, if it was there before',
    since={3: (3, 3, 15), 7: (7, 1, 2)},
    source='ros2/rclpy pull request 1316, `__init__.py` (`spin_until_future_complete`)',
    observed='a timer fires on after such a call under `rclpy.spin` on 7.1.6 and 9.1.2',
)
TIMEOUT_KEEPS_HARVEST = Behaviour(
    name='timeout-keeps-harvest',
    concerns='what a spin with a time-out serves while a callback awaits',
    without='the callback that awaits, again and again',
    having='all that are ready, one after the other',
    since={3: (3, 3, 11), 7: (7, 0, 0)},
    source='ros2/rclpy pull request 1165, `executors.py` (`wait_for_ready_callbacks`)',
    observed='a timer beside a callback that awaits runs on 7.1.6 and 9.1.2, and not '
    'with the executor core of 3.3.10',
)
SHUTDOWN_WAITS_NOT = Behaviour(
    name='shutdown-waits-not',
    concerns='what `rclpy.shutdown()` in a callback waits for',
    without='until all callbacks have ended, that one too: it hangs',
    having='for nothing: the callback goes on and the spin ends',
    since={4: (4, 0, 0)},
    source='ros2/rclpy issue 944, `executors.py` (`Executor.shutdown`)',
    observed='under `rclpy.spin` it hangs on 3.3.21 and ends on 7.1.6 and 9.1.2',
)
SHUTDOWN_DESTROYS_NODES = Behaviour(
    name='shutdown-destroys-nodes',
    concerns='what `rclpy.shutdown()` does with nodes',
    without='nothing: a service callback that calls it sends its response all the same',
    having='it destroys them: the response of a service callback that calls it raises '
    '`InvalidHandle`, which ends the spin',
    since={9: (9, 0, 0)},
    source='`context.py` (`Context._cleanup`) of 9.1.2 and 9.1.5, which 7.1.11 lacks',
    observed='a service that shuts down under `rclpy.spin`: the spin ends as usual on 7.1.6 and '
    '7.1.11, and by `InvalidHandle` on 9.1.2',
)
EVENTS_EXECUTOR = Behaviour(
    name='events-executor',
    concerns='whether there is an `EventsExecutor`',
    without='no: `ModuleNotFoundError: rclpy.experimental`',
    having='there is one',
    since={7: (7, 1, 4), 9: (9, 0, 0)},
    source='`experimental/events_executor.py`',
    observed='it is imported on 7.1.6 and 9.1.2, and not on 3.3.21',
)
COROUTINES_IN_EVENTS = Behaviour(
    name='coroutines-in-events',
    concerns='what the `EventsExecutor` does with coroutines of services and subscriptions',
    without='a service raises `TypeError`, a subscription does nothing',
    having='it runs them',
    since={7: (7, 1, 11), 9: (9, 1, 2), 10: (10, 0, 1)},
    source='ros2/rclpy pull requests 1478 and 1613, `events_executor.cpp`',
    observed='a service that is a coroutine: `TypeError` on 7.1.6, answered on 7.1.11 and 9.1.2',
)
MESSAGE_INFO = Behaviour(
    name='message-info',
    concerns='what a subscription passes to a callback that has two parameters',
    without='the message alone: each one raises `TypeError`, which ends the spin',
    having='the message and its information',
    since={4: (4, 0, 0)},
    source='`subscription.py` (`Subscription.CallbackType`) of 7.1.11, which 3.3.21 lacks',
    observed='a callback with two parameters: `TypeError` on 3.3.21, run on 7.1.6 and 9.1.2',
)
TIMER_INFO = Behaviour(
    name='timer-info',
    concerns='what a timer passes to a callback that has a parameter of type `TimerInfo`',
    without='nothing, and importing `TimerInfo` raises `ImportError`',
    having='the expected and the actual time of the call',
    since={9: (9, 0, 0)},
    source='`executors.py` (`_take_timer`) of 9.1.5, which 7.1.11 lacks',
    observed='a callback with such a parameter: run on 9.1.2; 7.1.6 has no `TimerInfo`',
)
CALL_TAKES_TIMEOUT = Behaviour(
    name='call-takes-timeout',
    concerns='whether `Client.call` has a `timeout_sec`',
    without='it has none, and raises `TypeError`',
    having='it has one',
    since={7: (7, 1, 0)},
    source='`client.py` (`Client.call`) of 3.3.21 and 7.1.11',
    observed='the signatures of 3.3.21 and 7.1.6',
)
CALL_TIMEOUT_RAISES = Behaviour(
    name='call-timeout-raises',
    concerns='what `Client.call(timeout_sec=…)` does when its time is over',
    without='it returns `None`',
    having='it raises `TimeoutError`, which ends the spin if nobody catches it',
    since={9: (9, 0, 0)},
    source='`client.py` (`Client.call`) of 7.1.11 and 9.1.5',
    observed='a call that nobody answers: `None` on 7.1.6, `TimeoutError` on 9.1.2',
)
THREADS_BY_AFFINITY = Behaviour(
    name='threads-by-affinity',
    concerns='how many threads a `MultiThreadedExecutor` has by default',
    without='as many as the machine has CPUs',
    having='as many as CPUs that the process may use',
    since={4: (4, 0, 0)},
    source='`executors.py` (`MultiThreadedExecutor.__init__`) of 3.3.21 and 7.1.11',
    observed='under `taskset -c 0` on two CPUs: two threads on 3.3.21, one on 7.1.6, '
    '7.1.11, 9.1.2 and 11.0.0',
)
SPIN_YIELDS = Behaviour(
    name='spin-yields',
    concerns='whether the thread that spins a pool lets workers run after it has given them work',
    without='it goes on at once, and may hand over one callback many times',
    having='it gives way to other threads',
    since={10: (10, 0, 4)},
    source='ros2/rclpy pull request 1547, `executors.py` '
    '(`MultiThreadedExecutor._spin_once_impl`)',
    observed='`sched_yield` of the thread that spins a pool: called on 10.0.10 and 11.0.0, not on '
    '3.3.21, 7.1.6, 7.1.11, 9.1.2 and 9.1.5',
)
POOL_ORDER_VARIES = Behaviour(
    name='pool-order-varies',
    concerns='in which order two threads of a pool begin what they were given (Python)',
    without='in the order in which they were given it',
    having='now and then in another order, so that a member of a group that others keep busy '
    'gets a turn',
    since={3: (3, 13, 0)},
    source='Python, `concurrent/futures/thread.py`; rclpy, `executors.py`',
    observed='two timers of one group at a load of 4: the second ran 0 times on Python 3.11.7 and '
    '3.12.1, and 7 to 27 times on 3.13.0 and 3.14.10',
)
NO_GLOBAL_LOCK = Behaviour(
    name='no-global-lock',
    concerns='whether another thread can come between reading and writing of `self.n += 1` '
    '(free-threaded builds of Python)',
    without='CPython does it in one piece by its global lock',
    having='free-threaded builds lack that lock and lose updates',
    since={3: (3, 13, 0)},
    source='PEP 703 and PEP 779: a build of its own, 3.13t and later, no default',
    observed='of 4 to 20 million `self.n += 1` none was lost on CPython 3.10 to 3.13, which have '
    'the lock',
)

RCLPY = (
    TASKS_OLDEST_FIRST,
    FUTURE_YIELDS_ITSELF,
    UNTIL_ASKS_FUTURE,
    EXCEPTION_AFTER_AWAIT_LOST,
    SPIN_REFUSED_TWICE,
    NODE_STAYS,
    TIMEOUT_KEEPS_HARVEST,
    SHUTDOWN_WAITS_NOT,
    SHUTDOWN_DESTROYS_NODES,
    EVENTS_EXECUTOR,
    COROUTINES_IN_EVENTS,
    MESSAGE_INFO,
    TIMER_INFO,
    CALL_TAKES_TIMEOUT,
    CALL_TIMEOUT_RAISES,
    THREADS_BY_AFFINITY,
    SPIN_YIELDS,
)
"""The rows that the release of rclpy decides."""

PYTHON = (POOL_ORDER_VARIES, NO_GLOBAL_LOCK)
"""The rows that the release of Python decides."""

ROWS = RCLPY + PYTHON
