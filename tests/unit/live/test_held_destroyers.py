"""Who destroys an entity is held until a spin reads it, or a call waits for its answer."""

from __future__ import annotations

import sys
import threading
import types
from pathlib import Path
from typing import Any

import pytest

from ros2cc_extract.extract.live.steering import destroys
from ros2cc_extract.extract.live.steering.destroys import Destroys
from ros2cc_extract.extract.live.steering.director import Director
from ros2cc_extract.extract.live.steering.plan import Plan
from ros2cc_extract.extract.live.steering.report import Report

HELD_S = 2.0
# As of rclpy: the class of nodes, an entity, and a spin that reads it twice.
CLIENT = """
class Client:
    def __init__(self):
        self.is_destroyed, self._pending_requests = False, {}

    @property
    def handle(self):
        return 'gone' if self.is_destroyed else 'there'
"""
NODE = """
class Node:
    def destroy_client(self, client):
        client.is_destroyed = True
"""
SPIN = """
def spin(client):
    return [client.handle, client.handle, client.handle]
"""


@pytest.fixture
def rclpy(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    found = {}
    for name, text in (('client', CLIENT), ('node', NODE), ('executors', SPIN)):
        found[name] = module = types.ModuleType(f'rclpy.{name}')
        exec(text, vars(module))
        monkeypatch.setitem(sys.modules, module.__name__, module)
    monkeypatch.setattr(destroys, 'HELD_S', HELD_S)
    monkeypatch.setattr(destroys, 'AFTERWARDS_S', 0.0)
    return found


def at_point(act: Any) -> None:
    act()  # the point of the plan


def wrapped(tmp_path: Path, destroys_by: str) -> None:
    line = at_point.__code__.co_firstlineno + 1
    point = {'file': str(Path(__file__).resolve()), 'first': line, 'last': line}
    plan = Plan({'report': '', 'points': [point], 'destroys': destroys_by})
    report = Report(str(tmp_path / 'report'))
    Destroys(Director(plan, report), report).wrap()


def test_a_spin_reads_what_is_gone_in_between(rclpy: dict[str, Any], tmp_path: Path) -> None:
    wrapped(tmp_path, destroys.BY_SPIN)
    client, node = rclpy['client'].Client(), rclpy['node'].Node()
    thread = threading.Thread(target=at_point, args=(lambda: node.destroy_client(client),))
    thread.start()
    thread.join(HELD_S / 8)  # it is held by now, not in the middle of a spin
    read = rclpy['executors'].spin(client)
    thread.join()
    assert read == ['there', 'gone', 'gone'], 'the second read is the one that is met'


def test_a_call_that_waits_is_waited_for(rclpy: dict[str, Any], tmp_path: Path) -> None:
    wrapped(tmp_path, destroys.BY_CALL)
    client, node = rclpy['client'].Client(), rclpy['node'].Node()
    thread = threading.Thread(target=at_point, args=(lambda: node.destroy_client(client),))
    thread.start()
    thread.join(HELD_S / 8)
    assert not client.is_destroyed
    client._pending_requests[1] = 'a future'
    thread.join(HELD_S / 2)
    assert client.is_destroyed


@pytest.mark.parametrize('by', [destroys.BY_SPIN, destroys.BY_CALL])
def test_what_is_destroyed_elsewhere_is_not_held(
    by: str, rclpy: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(destroys, 'HELD_S', 600.0)
    wrapped(tmp_path, by)
    client = rclpy['client'].Client()
    rclpy['node'].Node().destroy_client(client)
    assert client.is_destroyed
