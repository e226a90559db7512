"""
Rules that speak for what the extractor notices of ends: nodes, entities, executors, rclpy itself.

Each takes over the diagnostics of its slug; only the help text is here.
"""

from __future__ import annotations

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Rule
from ros2cc_extract.spec.releases.table import SHUTDOWN_DESTROYS_NODES, SHUTDOWN_WAITS_NOT

SERVED_NO_MORE = Rule(
    code='CC116',
    slug='served-no-more',
    severity=Severity.WARNING,
    title='Nothing is served anymore',
    what='A callback destroys its node, or removes it from its executor, and that executor has '
    'no other node: the spin continues, and nothing runs. Or a client is destroyed during a wait '
    'for its answer, a publisher while a thread or another callback may still use it, or an '
    'entity is used in a callback that has shut rclpy down.',
    why='`spin` ends when rclpy is shut down, not when the last node is gone. `Client.call` '
    'waits for an event that the executor sets when it has taken the answer, which it does only '
    'for clients that exist. Publishing with a destroyed publisher raises an exception, which '
    'ends the thread. Sources: rclpy 7.1.6 and 9.1.2, `executors.py` (`spin`), `client.py` '
    '(`call`), `publisher.py`. Measured on both: a timer of 0.2 s falls silent, a call never '
    'returns, and a publisher raises `RCLError` or `InvalidHandle`.',
    bad="""\
class Job(Node):
    def work(self):
        self.destroy_node()      # rclpy.spin(job) goes on with nothing
""",
    good="""\
class Job(Node):
    def work(self):
        self.done.set_result(True)

rclpy.spin_until_future_complete(job, job.done)
job.destroy_node()
""",
    mend='End the spin, and destroy nodes and entities behind it.',
)
DESTROYED_WHILE_SPUN = Rule(
    code='CC117',
    slug='destroyed-while-spun',
    severity=Severity.WARNING,
    title='Entity destroyed while another thread spins it',
    what='A callback in a thread pool, or a thread of the program, destroys a subscription or '
    'action of a node that another thread spins. A note for one that the set-up or a life-cycle '
    'transition created: it is destroyed once, and the spin most likely survives. A note for '
    'timers, clients and services, too: only on Humble (rclpy 3.3) they can end the spin.',
    why='The spinning thread adds the QoS events of each subscription to its wait set; if they '
    'were destroyed meanwhile, that raises `InvalidHandle`, which ends the spin. Measured: after '
    '7 to 268 subscriptions on rclpy 7.1.6, 23 and 153 on 9.1.2. Timers, services and clients '
    'have no such events, and whoever takes from one that is destroyed catches that: no spin '
    'ended in some 3,000 rounds of each on both; on 3.3.21 one did after 1,413 timers. Sources: '
    'rclpy 7.1.6 and 9.1.2, `event_handler.py` (`add_to_wait_set`), `executors.py` '
    '(`_take_timer`); ros2/rclpy issue 1206.',
    bad="""\
class View(Node):                 # on a MultiThreadedExecutor
    def on_topic(self, request, response):
        self.destroy_subscription(self.sub)
        self.sub = self.create_subscription(Image, self.topic, self.on_image, 1)
        return response
""",
    good="""\
class View(Node):                 # on a SingleThreadedExecutor, or the sub stays
    def on_topic(self, request, response):
        self.wanted = self.topic
        return response
""",
    mend='Keep entities for as long as the node is spun, or spin it by one thread.',
)
SHUT_DOWN_IN_CALLBACK = Rule(
    code='CC118',
    slug='shut-down-in-callback',
    severity=Severity.NOTE,
    title='Shutdown inside a callback',
    what='A callback calls `rclpy.shutdown()` under `rclpy.spin`, or `shutdown()` of the '
    'single-threaded executor that runs it, without a time-out. Done-callbacks of requests and '
    'goals and execute callbacks run as tasks, for which no shutdown waits.',
    why='On Humble (rclpy 3.3) the shutdown waits until all callbacks of entities have ended, '
    'including the one that calls it. Later releases do not wait. Measured: 3.3.21 hangs in a '
    'timer and ends in a done-callback, rclpy 7.1.6 and 9.1.2 end. Sources: 3.3.21, '
    '`executors.py` (`shutdown`, `_make_handler`); ros2/rclpy issue 944.',
    bad="""\
class Job(Node):
    def on_done(self, msg):
        rclpy.shutdown()
""",
    good="""\
class Job(Node):
    def on_done(self, msg):
        raise SystemExit
""",
    mend='Make a future done and spin until that, or raise `SystemExit`; shut down behind the '
    'spin.',
    until=SHUTDOWN_WAITS_NOT,
)
ANSWER_AFTER_SHUTDOWN = Rule(
    code='CC125',
    slug='answer-after-shutdown',
    severity=Severity.WARNING,
    title='Service that shuts rclpy down before it answers',
    what='The callback of a service calls `rclpy.shutdown()`. rclpy sends the response when the '
    'callback has returned, and there is nothing left to send it with.',
    why='From rclpy 9.0 (Kilted) on `shutdown` destroys all nodes of its context, so that sending '
    'the response raises `InvalidHandle`, which ends the spin; the client waits for an answer '
    'that never comes. Humble and Jazzy destroy nothing. Sources: rclpy 9.1.2, `context.py` '
    '(`Context._cleanup`), `service.py` (`send_response`). Measured: 3 of 3 runs raise on 9.1.2, '
    'rclpy 7.1.6 and 7.1.11 end as usual.',
    bad="""\
class Kiosk(Node):
    def on_quit(self, request, response):
        rclpy.shutdown()
        response.success = True
        return response
""",
    good="""\
class Kiosk(Node):
    def on_quit(self, request, response):
        self.done.set_result(True)
        response.success = True
        return response

rclpy.spin_until_future_complete(kiosk, kiosk.done)
rclpy.shutdown()
""",
    mend='Make a future done and spin until that; shut down after the spin.',
    since=SHUTDOWN_DESTROYS_NODES,
)
