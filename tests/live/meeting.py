"""
Have two callbacks of a node meet at the worst moment: the second runs while the first is held.

Runs inside the node's process, before its program, with a context, an executor and a thread of its
own. A call of ``hold`` in the first callback has the second one run to its end, unless that waits
for the first: then ``hold`` gives in. Nothing rests on how long anything takes. The standard
library and rclpy are all it may use.
"""

from __future__ import annotations

import builtins
import threading
from collections.abc import Callable
from typing import Any

import rclpy
from rclpy.action import ActionClient
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


def meet(first: str, second: str, gives_in_s: float) -> None:
    """
    Begin.

    :param first: a service or an action of the program, ``call stop`` or ``send move``.
    :param second: another one.
    :param gives_in_s: how long ``hold`` waits for the end of the second.
    """
    held, over = threading.Event(), threading.Event()

    def hold(value: Any) -> Any:
        held.set()
        over.wait(gives_in_s)
        return value

    builtins.hold = hold
    threading.Thread(target=_act, args=(first, second, held, over), daemon=True).start()


def spin(executor: Any) -> None:
    """Spin until something raises, and say what."""
    try:
        executor.spin()
    except Exception as error:
        print(f'spin raised {type(error).__name__}: {error}')
    threading.Event().wait()


def _act(first: str, second: str, held: threading.Event, over: threading.Event) -> None:
    context = Context()
    rclpy.init(context=context)
    node = rclpy.create_node('meeting', context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    steps = [_ready(node, *step.split()) for step in (first, second)]
    print('asks')
    answered = steps[0]()
    held.wait()
    steps[1]().wait()
    over.set()
    answered.wait()
    print('both are over')


def _ready(node: Node, verb: str, name: str) -> Callable[[], threading.Event]:
    """Wait until it is there; give what asks for it, and reports its answer."""
    if verb == 'send':
        actions = ActionClient(node, Fibonacci, name)
        actions.wait_for_server()
        return lambda: _sent(actions)
    services = node.create_client(Trigger, name)
    services.wait_for_service()
    return lambda: _done(services.call_async(Trigger.Request()))


def _sent(client: Any) -> threading.Event:
    over = threading.Event()

    def accepted(future: Any) -> None:
        future.result().get_result_async().add_done_callback(lambda _: over.set())

    client.send_goal_async(Fibonacci.Goal(order=5)).add_done_callback(accepted)
    return over


def _done(future: Any) -> threading.Event:
    over = threading.Event()
    future.add_done_callback(lambda _: over.set())
    return over
