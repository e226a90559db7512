"""CC117: entities that come and go while another thread spins, and such as go once."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

NODE = """
import threading
import rclpy
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.lifecycle import LifecycleNode
from std_msgs.msg import Empty

class View(LifecycleNode):
    def __init__(self):
        super().__init__('view')
        self.timer = None
        self.first = self.create_subscription(Empty, 'first', print, 1)
        self.create_subscription(Empty, 'go', self.on_go, 1)

    def on_activate(self, state):
        self.timer = self.create_timer(1.0, print)

    def on_deactivate(self, state):
        LEFT

    def on_go(self, message):
        GO

def ask(node):
    client = node.create_client(Empty, 'who')
    node.destroy_client(client)

rclpy.init()
view = View()
executor = EXECUTOR
executor.add_node(view)
MAIN
"""
POOL, ONE = 'MultiThreadedExecutor(num_threads=2)', 'SingleThreadedExecutor()'
SPUN = 'executor.spin()'
AGAIN = """self.destroy_subscription(self.first)
        self.first = self.create_subscription(Empty, 'next', print, 1)"""
BESIDE = 'beside = SingleThreadedExecutor(); beside.add_node(rclpy.create_node("other"))\n'
BESIDE += 'threading.Thread(target=beside.spin).start()\n'
THREAD = 'threading.Thread(target=executor.spin).start()\n'
JOINED = 'thread = threading.Thread(target=executor.spin)\nthread.start()\n'


@pytest.mark.parametrize(
    ('go', 'left', 'executor', 'main', 'told'),
    [
        (AGAIN, 'pass', POOL, SPUN, ['warning']),
        (AGAIN, 'pass', ONE, SPUN, []),
        ('self.destroy_subscription(self.first)', 'pass', POOL, SPUN, ['note']),
        ('pass', 'self.destroy_timer(self.timer)', POOL, SPUN, ['note']),
        # `main` spins the executor itself, later; another thread spins another one.
        ('pass', 'pass', ONE, f'{BESIDE}ask(view)\n{SPUN}', []),
        ('pass', 'pass', POOL, f'{BESIDE}ask(view)\n{SPUN}', []),
        ('pass', 'pass', ONE, f'{THREAD}ask(view)', ['note']),
    ],
)
def test_what_goes_once_is_a_note(
    go: str, left: str, executor: str, main: str, told: list[str]
) -> None:
    text = NODE.replace('GO', go).replace('LEFT', left)
    scanned = scan_text(text.replace('EXECUTOR', executor).replace('MAIN', main))
    found = [d for d in scanned.diagnostics if d.slug == 'destroyed-while-spun']
    assert [d.severity.value for d in found] == told


@pytest.mark.parametrize(
    ('ended', 'told'),
    [
        ('thread.join()\n', 0),
        ('executor.shutdown()\nthread.join()\n', 0),
        ('rclpy.shutdown()\nthread.join(timeout=2.0)\n', 0),
        ('try:\n    pass\nfinally:\n    executor.shutdown(2.0)\n    thread.join(2.0)\n', 0),
        ('thread.join(timeout=2.0)\n', 1),
        ('executor.shutdown()\n', 1),
        ('thread.join(2.0)\nexecutor.shutdown()\n', 1),
        ('if input():\n    executor.shutdown()\nthread.join(2.0)\n', 1),
        ('other = SingleThreadedExecutor()\nother.shutdown()\nthread.join(2.0)\n', 1),
        ('other = threading.Thread(target=print)\nother.start()\nother.join()\n', 1),
    ],
)
@pytest.mark.parametrize('executor', [POOL, ONE])
def test_a_thread_that_was_waited_for_spins_no_more(ended: str, told: int, executor: str) -> None:
    text = NODE.replace('GO', 'pass').replace('LEFT', 'pass').replace('EXECUTOR', executor)
    scanned = scan_text(text.replace('MAIN', f'{JOINED}{ended}ask(view)'))
    found = [d for d in scanned.diagnostics if d.slug == 'destroyed-while-spun']
    assert len(found) == told


@pytest.mark.parametrize(
    ('made', 'kind', 'told'),
    [
        ("subscription(Empty, 'next', print, 1)", 'subscription', ['warning']),
        ('timer(1.0, print)', 'timer', ['note']),
        ("client(Trigger, 'who')", 'client', ['note']),
        ("service(Trigger, 'who', print)", 'service', ['note']),
    ],
)
def test_only_what_has_events_of_its_own_ends_the_spin(
    made: str, kind: str, told: list[str]
) -> None:
    """Whoever takes from the others catches that they are destroyed, except on Humble."""
    go = f'self.destroy_{kind}(self.create_{made})'
    text = NODE.replace('GO', go).replace('LEFT', 'pass').replace('EXECUTOR', POOL)
    scanned = scan_text(f'from std_srvs.srv import Trigger\n{text}'.replace('MAIN', SPUN))
    found = [d for d in scanned.diagnostics if d.slug == 'destroyed-while-spun']
    assert [d.severity.value for d in found] == told
