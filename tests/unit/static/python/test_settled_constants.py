"""Attributes that hold a constant since the set-up, and that nobody gives another value."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """
import threading
import rclpy
from rclpy.node import Node

class Link:
    def __init__(self):
        self.lock = threading.Lock()
        self.ready = False
        {begin}
        self.connect()

    def connect(self):
        with self.lock:
            if self.ready:
                return
            {connect}

    def send(self):
        with self.lock:
            if not self.ready:
                self.connect()

    def watch(self):
        self.send()

    {more}

class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.link = Link()
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.link.send()

rclpy.init()
rclpy.spin(Arm())
"""
CONNECT = 'self.ready = True'
OR_RAISE = """try:
                self.socket = open('socket')
                self.ready = True
            except OSError:
                raise"""
THREAD = 'threading.Thread(target=self.watch).start()'


def locked_twice(*, begin: str = 'pass', connect: str = CONNECT, more: str = 'pass') -> list[str]:
    scanned = scan_text(PROGRAM.format(begin=begin, connect=connect, more=more))
    found = findings_of(scanned.units, scanned.diagnostics)
    return [finding.subjects[0] for finding in found if finding.code == 'CC111']


@pytest.mark.parametrize('connect', [CONNECT, OR_RAISE])
def test_what_is_set_for_good_before_anything_runs_stays_so(connect: str) -> None:
    assert locked_twice(connect=connect) == []


def test_what_is_taken_back_may_be_anything() -> None:
    assert locked_twice(more='def close(self): self.ready = False') == ['tick']
    assert locked_twice(more='def count(self): self.ready += 0') == ['tick']


def test_a_thread_that_is_there_before_sees_what_was_there_before() -> None:
    assert 'watch' in locked_twice(begin=THREAD)


def test_what_is_never_set_is_what_it_was() -> None:
    assert locked_twice(begin='return') == ['tick']


TRANSITION = """
import threading
import rclpy
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn

class Arm(LifecycleNode):
    def __init__(self):
        super().__init__('arm')
        self.lock = threading.Lock()
        self.loud = True

    def on_configure(self, state):
        self.create_timer(1.0, self.tick)
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state):
        self.loud = False
        return TransitionCallbackReturn.SUCCESS

    def tick(self):
        with self.lock:
            if self.loud:
                self.shout()

    def shout(self):
        with self.lock:
            pass

rclpy.init()
rclpy.spin(Arm())
"""


def test_what_another_stores_later_was_not_there_before() -> None:
    scanned = scan_text(TRANSITION)
    found = findings_of(scanned.units, scanned.diagnostics)
    assert [finding.subjects[0] for finding in found if finding.code == 'CC111'] == ['tick']
