"""
A node whose callbacks come and work at given rates, in one exclusive group on four threads.

Runs inside a fork of ``forked.py``; says the name of a callback at the begin of each of its runs,
and ``asks`` at the first. What is published comes from a context and a thread of their own. The
standard library and rclpy are all it may use.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.context import Context
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from std_msgs.msg import String

#: With the default ones, rclpy polls without a pause while an excluded subscription has data,
#: and several programs would take each other's processors.
NO_EVENTS = SubscriptionEventCallbacks(use_default_callbacks=False)
Member = tuple[str, str, float, float]
"""Kind (``timer`` or ``subscription``), name, seconds from one arrival to the next, of a run."""


def run(members: Sequence[Member], threads: int = 4) -> None:
    """Serve ``members``, created in this order, forever."""
    rclpy.init()
    node = rclpy.create_node('rated')
    group = MutuallyExclusiveCallbackGroup()
    begun = threading.Event()
    for kind, name, period_s, work_s in members:
        work = _work(name, work_s, begun)
        if kind == 'timer':
            node.create_timer(period_s, lambda work=work: work(None), callback_group=group)
        else:
            node.create_subscription(
                String, name, work, 10, callback_group=group, event_callbacks=NO_EVENTS
            )
    threading.Thread(target=_publish, args=(members,), daemon=True).start()
    executor = MultiThreadedExecutor(num_threads=threads)
    executor.add_node(node)
    executor.spin()


def _work(name: str, work_s: float, begun: threading.Event) -> Callable[[object], None]:
    def work(_message: object) -> None:
        if not begun.is_set():
            begun.set()
            print('asks')
        print(name)
        time.sleep(work_s)

    return work


def _publish(members: Sequence[Member]) -> None:
    context = Context()
    rclpy.init(context=context)
    node = rclpy.create_node('publisher', context=context)
    for kind, name, period_s, _ in members:
        if kind == 'subscription':
            publisher = node.create_publisher(String, name, 10)
            node.create_timer(
                period_s, lambda publisher=publisher: publisher.publish(String(data=''))
            )
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    executor.spin()
