"""The other examples do in real rclpy what their READMEs say."""

from __future__ import annotations

import signal
from collections.abc import Callable

from child import Child
from conftest import EXAMPLES

Start = Callable[..., Child]
# An answer takes milliseconds; what has none by then is taken to have none forever.
BLOCKED_S = 1.0


def said(child: Child, word: str, times: int = 1) -> bool:
    child.read_until(lambda lines: sum(word in line for line in lines) >= times)
    return True


def test_client_gets_its_answers_on_one_thread(start_example: Start) -> None:
    child = start_example('service_and_client')
    assert said(child, 'gripper is closed', 2)
    assert said(child, 'gripper is open')


def test_call_in_the_clients_own_group_never_returns(start_example: Start) -> None:
    child = start_example('service_deadlock')
    assert said(child, 'asks for the map')
    child.sleep(BLOCKED_S)
    child.end(signal.SIGINT)
    assert child.text.count('asks for the map') == 1
    assert 'drives' not in child.text


def test_two_waiting_callbacks_exhaust_two_threads(start_example: Start) -> None:
    child = start_example('pool_exhaustion')
    assert said(child, 'left arm asks')
    assert said(child, 'right arm asks')
    child.sleep(BLOCKED_S)
    child.end(signal.SIGINT)
    assert (child.text.count('left arm asks'), child.text.count('right arm asks')) == (1, 1)
    assert 'moves' not in child.text


def test_action_server_answers_with_the_sequence(start: Start, start_example: Start) -> None:
    start_example('action_server', '--ros-args', '-p', 'step_s:=0.01')
    client = start(EXAMPLES / 'action_server' / 'client.py', '--order', '6')
    assert client.end() == 0
    assert client.lines == ['sequence 0 1 1 2 3 5\n']


def test_action_server_sees_a_cancel_while_it_works(start: Start, start_example: Start) -> None:
    start_example('action_server')
    client = start(EXAMPLES / 'action_server' / 'client.py', '--order', '1000', '--cancel')
    assert client.end() == 0
    assert len(client.text.split()) < 1000


def test_two_nodes_share_an_executor(start_example: Start) -> None:
    child = start_example('two_nodes_one_executor')
    assert said(child, '[odometry]: distance 0.', 2)
    child.end_well(signal.SIGINT)
