"""
Gives a node from outside what it waits for.

As ``python stimulus.py READY VALUES AT_ONCE DEFAULTS FILLED``. Publishes on every topic that a
node of the domain subscribes to, calls every service, sends goals to every action server, and
offers what the clients of the domain ask for without a server. All messages are filled by default
at first, later with VALUES, a JSON list of texts and numbers that the program compares with;
without DEFAULTS (0) always with these, without FILLED never. Of each service, AT_ONCE requests are
on their way at a time. The file READY is made once all that was seen at first is offered.

Runs with the user's interpreter: the standard library and rclpy only.
"""

from __future__ import annotations

import contextlib
import importlib
import json
import os
import sys
import time
from collections.abc import Iterator, Sequence
from typing import Any

NODE = '_ros2cc_stimulus'
ROUND_S = 0.1
# What another node may offer a moment later is not offered instead.
GRACE_S = 0.7
# For the other side to find what is offered.
SETTLES_S = 0.5
_PARAMETERS = 'set_parameters'
_OF_RCLPY = (
    'describe_parameters', 'get_parameters', 'get_parameter_types', 'list_parameters',
    'set_parameters', 'set_parameters_atomically', 'get_type_description', 'get_logger_levels',
    'set_logger_levels', 'get_state', 'get_available_states', 'get_available_transitions',
    'get_transition_graph',
)  # fmt: skip
_TOPICS_OF_RCLPY = ('/parameter_events', '/rosout', '/clock')
# `lifecycle_msgs/msg/State` to `Transition`: an unconfigured one is configured, an inactive one
# activated. A node raises where it has no such transition.
_TRANSITIONS = {1: 1, 2: 3}
_NUMBERS = ('int', 'uint', 'float', 'double', 'octet', 'byte')


class Stimulus:
    """All that is offered and sent, by name."""

    def __init__(
        self, ready: str, values: Sequence[Any], at_once: int, *, defaults: bool, filled: bool
    ) -> None:
        rclpy = importlib.import_module('rclpy')
        self._rclpy = rclpy
        rclpy.init(args=[])
        self._node = rclpy.create_node(NODE, enable_rosout=False, start_parameter_services=False)
        self._texts = [*(each for each in values if isinstance(each, str)), '1']
        if defaults:
            self._texts.insert(0, '')
        self._numbers = [0, *(each for each in values if isinstance(each, (int, float))), 1]
        self._turn = 0
        self._at_once = at_once
        self._defaults = defaults
        self._is_filled = filled
        self._ready: str | None = ready
        self._first: float | None = None
        self._publishers: dict[str, Any] = {}
        self._clients: dict[str, Any] = {}
        self._asked: dict[str, list[Any]] = {}
        self._offered: dict[str, Any] = {}
        self._seen: dict[str, float] = {}
        self._actions: dict[str, Any] = {}

    def run(self) -> None:
        """Go on until killed, or until the process that started it is gone."""
        executor = importlib.import_module('rclpy.executors').SingleThreadedExecutor()
        executor.add_node(self._node)
        parent = os.getppid()
        while self._rclpy.ok() and os.getppid() == parent:
            for name, namespace in self._others():
                for act in (
                    self._publish,
                    self._call,
                    self._offer,
                    self._act,
                    self._serve_actions,
                ):
                    # What cannot be built, as a type that is not installed, is left out.
                    with contextlib.suppress(Exception):
                        act(name, namespace)
            self._turn += 1
            self._report_when_ready()
            until = time.monotonic() + ROUND_S
            while time.monotonic() < until:
                executor.spin_once(timeout_sec=0.02)

    def _report_when_ready(self) -> None:
        if self._ready is not None and any(self._others()):
            self._first = self._first or time.monotonic()
            # What was asked for last is offered last.
            last = max((self._first, *self._seen.values()))
            if time.monotonic() - last > GRACE_S + SETTLES_S:
                with open(self._ready, 'x', encoding='utf-8'):  # noqa: PTH123
                    self._ready = None

    def _others(self) -> Iterator[tuple[str, str]]:
        for name, namespace in self._node.get_node_names_and_namespaces():
            if not name.startswith('_ros2'):
                yield name, namespace

    def _publish(self, name: str, namespace: str) -> None:
        found = self._node.get_subscriber_names_and_types_by_node(name, namespace)
        for topic, types in found:
            if topic in _TOPICS_OF_RCLPY or '/_action/' in topic:
                continue
            kind = _interface(types[0])
            if topic not in self._publishers:
                infos = self._node.get_subscriptions_info_by_topic(topic)
                quality = infos[0].qos_profile if infos else 10
                self._publishers[topic] = self._node.create_publisher(
                    kind, topic, _usable(quality)
                )
            self._publishers[topic].publish(self._filled(kind()))

    def _call(self, name: str, namespace: str) -> None:
        for service, types in self._node.get_service_names_and_types_by_node(name, namespace):
            last = service.rpartition('/')[2]
            if '/_action/' in service or (last in _OF_RCLPY and last != _PARAMETERS):
                continue
            kind = _interface(types[0])
            if service not in self._clients:
                self._clients[service] = self._node.create_client(kind, service)
                self._asked[service] = []
            client, asked = self._clients[service], self._asked[service]
            asked[:] = [each for each in asked if not each.done()]
            if client.service_is_ready() and len(asked) < self._at_once:
                request = self._request(kind, service, last)
                if request is not None:
                    asked.append(client.call_async(request))

    def _request(self, kind: Any, service: str, last: str) -> Any:
        request = kind.Request()
        if last == _PARAMETERS:
            request.parameters = self._parameters(service.rpartition('/')[0])
            return request if request.parameters else None
        if last == 'change_state':
            state = self._state(service.rpartition('/')[0])
            request.transition.id = _TRANSITIONS.get(state or 0, 0)
            return request if state in _TRANSITIONS else None
        return self._filled(request)

    def _parameters(self, node: str) -> list[Any]:
        """What its own program has declared, as it is; read by way of its services."""
        kind = importlib.import_module('rcl_interfaces.srv')
        names = self._answer(
            kind.ListParameters, f'{node}/list_parameters', kind.ListParameters.Request()
        )
        own = [
            each for each in (names.result.names if names else ())
            if not each.startswith(('use_sim_time', 'qos_overrides', 'start_type'))
        ]  # fmt: skip
        if not own:
            return []
        request = kind.GetParameters.Request(names=own)
        values = self._answer(kind.GetParameters, f'{node}/get_parameters', request)
        message = importlib.import_module('rcl_interfaces.msg').Parameter
        return [
            message(name=name, value=value)
            for name, value in zip(own, values.values if values else (), strict=False)
        ]

    def _state(self, node: str) -> int | None:
        """In which state a life-cycle node is now; `None` until that is known."""
        kind = importlib.import_module('lifecycle_msgs.srv').GetState
        service = f'{node}/get_state'
        found = self._answer(kind, service, kind.Request())
        if found is not None:
            # It changes: the next one asks again.
            self._asked[service].clear()
        return None if found is None else int(found.current_state.id)

    def _answer(self, kind: Any, service: str, request: Any) -> Any:
        """The last answer of a service; `None` until there is one."""
        if service not in self._clients:
            self._clients[service] = self._node.create_client(kind, service)
        asked = self._asked.setdefault(service, [])
        if not asked and self._clients[service].service_is_ready():
            asked.append(self._clients[service].call_async(request))
        return asked[0].result() if asked and asked[0].done() else None

    def _offer(self, name: str, namespace: str) -> None:
        for service, types in self._node.get_client_names_and_types_by_node(name, namespace):
            if '/_action/' in service or service in self._offered:
                continue
            if not self._is_missing(service, self._node.count_services(service)):
                continue
            kind = _interface(types[0])
            self._offered[service] = self._node.create_service(
                kind, service, lambda _request, response: self._filled(response)
            )

    def _is_missing(self, name: str, servers: int) -> bool:
        first = self._seen.setdefault(name, time.monotonic())
        return not servers and time.monotonic() - first > GRACE_S

    def _act(self, name: str, namespace: str) -> None:
        module = importlib.import_module('rclpy.action')
        found = module.get_action_server_names_and_types_by_node(self._node, name, namespace)
        for action, types in found:
            kind = _interface(types[0])
            if action not in self._actions:
                self._actions[action] = module.ActionClient(self._node, kind, action)
                self._asked[action] = []
            client, asked = self._actions[action], self._asked[action]
            asked[:] = [each for each in asked if not each.done()]
            if client.server_is_ready() and len(asked) < self._at_once:
                goal = client.send_goal_async(self._filled(kind.Goal()))
                goal.add_done_callback(self._follow)
                asked.append(goal)

    def _follow(self, future: Any) -> None:
        handle = future.result()
        if handle is not None and handle.accepted:
            handle.get_result_async()

    def _serve_actions(self, name: str, namespace: str) -> None:
        module = importlib.import_module('rclpy.action')
        servers = {
            action
            for other, space in self._node.get_node_names_and_namespaces()
            for action, _ in module.get_action_server_names_and_types_by_node(
                self._node, other, space
            )
        }
        found = module.get_action_client_names_and_types_by_node(self._node, name, namespace)
        for action, types in found:
            if action in self._offered or not self._is_missing(action, action in servers):
                continue
            kind = _interface(types[0])

            def execute(goal: Any, kind: Any = kind) -> Any:
                goal.succeed()
                return self._filled(kind.Result())

            self._offered[action] = module.ActionServer(self._node, kind, action, execute)

    def _filled(self, message: Any, depth: int = 0) -> Any:
        """Every other turn as made, else with the next of the values."""
        if not self._is_filled or (self._defaults and self._turn % 2 == 0) or depth > 4:
            return message
        turn = self._turn // 2 if self._defaults else self._turn
        for field, kind in message.get_fields_and_field_types().items():
            with contextlib.suppress(AssertionError, TypeError, ValueError, OverflowError):
                setattr(message, field, self._value(getattr(message, field), kind, turn, depth))
        return message

    def _value(self, now: Any, kind: str, turn: int, depth: int) -> Any:
        if kind == 'boolean':
            return True
        if kind.startswith('string'):
            return self._texts[turn % len(self._texts)] if '[' not in kind else now
        if kind.startswith(_NUMBERS) and '[' not in kind:
            number = self._numbers[turn % len(self._numbers)]
            return float(number) if kind.startswith(('float', 'double')) else int(number)
        if hasattr(now, 'get_fields_and_field_types'):
            return self._filled(now, depth + 1)
        return now


def _usable(quality: Any) -> Any:
    """Return the quality with a queue depth, which the graph does not give."""
    if hasattr(quality, 'depth'):
        policy = importlib.import_module('rclpy.qos').HistoryPolicy
        quality.history, quality.depth = policy.KEEP_LAST, 10
    return quality


def _interface(name: str) -> Any:
    """Import `std_msgs/msg/String`."""
    package, kind, cls = name.split('/')
    return getattr(importlib.import_module(f'{package}.{kind}'), cls)


if __name__ == '__main__':
    given = [each == '1' for each in sys.argv[4:6]]
    sent = Stimulus(
        sys.argv[1],
        json.loads(sys.argv[2]),
        int(sys.argv[3]),
        defaults=given[0],
        filled=given[1],
    )
    sent.run()
