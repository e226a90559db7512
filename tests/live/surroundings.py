"""
What a node of ``tests/bugs`` meets in the field, and a witness of what its callbacks do.

Runs inside the node's process, before its program: servers, publishers and clients have a context,
an executor and a thread of their own. The witness says ``begins NAME`` and ``ends NAME`` where a
callback group is closed and opened, and ``asks`` once the first of the callbacks to be watched has
begun. The standard library and rclpy are all it may use.
"""

from __future__ import annotations

import builtins
import functools
import threading
from collections.abc import Callable, Sequence
from typing import Any

import rclpy
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from rcl_interfaces.srv import SetParameters
from rclpy.action import ActionClient
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_msgs.msg import String
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


def surround(
    watch: str,
    serve: str = '',
    publish: tuple[str, str, float] | None = None,
    call: str = '',
    cancel: str = '',
    set_level: str = '',
    configure: str = '',
    holds_s: float = 0.0,
) -> None:
    """
    Begin.

    :param watch: what the program is about: a callback, or ``execute`` of an action.
    :param serve: a service to offer.
    :param publish: a topic, what to say on it, and how often, in seconds.
    :param call: a service of the program to call.
    :param cancel: an action of the program: a goal is sent, and cancelled once accepted.
    :param set_level: a node of the program whose parameter ``level`` is set.
    :param configure: a life-cycle node of the program to configure.
    :param holds_s: how long ``hold`` waits for the end of a callback that it does not exclude.
    """
    ended = threading.Event()
    builtins.hold = functools.partial(_hold, ended, holds_s)
    for group in (MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup):
        _witness(group, watch, ended)
    asked = ((call, _call), (cancel, _cancel), (set_level, _set_level), (configure, _configure))
    threading.Thread(target=_act, args=(serve, publish, asked), daemon=True).start()


def _hold(ended: threading.Event, holds_s: float, value: Any) -> Any:
    """Take some time to give ``value``; a program is made slow by this."""
    ended.clear()
    print('execute begins')
    ended.wait(holds_s)
    print('execute ends')
    return value


def _witness(group: Any, watch: str, ended: threading.Event) -> None:
    begin, end = group.beginning_execution, group.ending_execution
    begun = threading.Event()

    @functools.wraps(begin)
    def beginning(self: Any, entity: Any) -> bool:
        accepted = begin(self, entity)
        if accepted:
            name = _name_of(entity)
            print(f'begins {name}')
            if name == watch and not begun.is_set():
                begun.set()
                print('asks')
        return accepted

    @functools.wraps(end)
    def ending(self: Any, entity: Any) -> None:
        name = _name_of(entity)
        print(f'ends {name}')
        if name == watch:
            ended.set()
        end(self, entity)

    group.beginning_execution, group.ending_execution = beginning, ending


def _name_of(entity: Any) -> str:
    function = getattr(entity, 'callback', None)
    return getattr(function, '__name__', type(entity).__name__)


def _act(
    serve: str,
    publish: tuple[str, str, float] | None,
    asked: Sequence[tuple[str, Callable[[Node, str], None]]],
) -> None:
    context = Context()
    rclpy.init(context=context)
    node = rclpy.create_node('surroundings', context=context)
    executor = SingleThreadedExecutor(context=context)
    if serve:
        node.create_service(Trigger, serve, lambda request, response: response)
    if publish:
        topic, text, period_s = publish
        publisher = node.create_publisher(String, topic, 10)
        node.create_timer(period_s, lambda: publisher.publish(String(data=text)))
    for name, action in asked:
        if name:
            threading.Thread(target=action, args=(node, name), daemon=True).start()
    executor.add_node(node)
    executor.spin()


def _call(node: Node, service: str) -> None:
    client = node.create_client(Trigger, service)
    client.wait_for_service()
    client.call_async(Trigger.Request())


def _set_level(node: Node, other: str) -> None:
    client = node.create_client(SetParameters, f'{other}/set_parameters')
    client.wait_for_service()
    level = Parameter('level', value=2).to_parameter_msg()
    client.call_async(SetParameters.Request(parameters=[level]))


def _configure(node: Node, other: str) -> None:
    client = node.create_client(ChangeState, f'{other}/change_state')
    client.wait_for_service()
    request = ChangeState.Request()
    request.transition.id = Transition.TRANSITION_CONFIGURE
    client.call_async(request)


def _cancel(node: Node, action: str) -> None:
    client = ActionClient(node, Fibonacci, action)
    client.wait_for_server()
    accepted = client.send_goal_async(Fibonacci.Goal(order=5))
    accepted.add_done_callback(lambda future: _cancel_goal(future.result()))


def _cancel_goal(goal: Any) -> None:
    print('asks')
    answered: Callable[[Any], None] = lambda _future: print('cancel answered')  # noqa: E731
    goal.cancel_goal_async().add_done_callback(answered)
