"""Data races that no rule reports for sure, or for this unit, leave *no data race* open."""

from __future__ import annotations

import io
from pathlib import Path
from textwrap import indent

import pytest

from ros2cc_extract.cli.commands.live.confirm import job
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.promises import Mark, Promise, judge
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.pipeline.check import check_paths
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.yaml.yaml_io import read_specs, write_specs
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

PROGRAM = """\
import files, signal, threading, time
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from watchdog.events import FileSystemEventHandler
from watchdog.observers import Observer

class Changed(FileSystemEventHandler):
    def __init__(self, node):
        self.node = node

    def on_modified(self, event):
        self.node.once()

class Store(Node):
    def __init__(self):
        super().__init__('store')
        self.n = 0
        self.lock = threading.Lock()
        self.again = threading.RLock()
        self.busy = False
        self.create_subscription(String, 'a', self.on_a, 10)
        {made}

    def on_a(self, msg):
        {on_a}

    def on_signal(self, number, frame):
        {on_signal}

    def once(self):
        {once}

rclpy.init()
node = Store()
{spin}
"""
SPIN = 'rclpy.spin(node)'
POOL = 'executor = MultiThreadedExecutor(2)\nexecutor.add_node(node)\nexecutor.spin()'
CHANGE = 'x = self.n\ntime.sleep(0.01)\nself.n = x + 1'
ON_SIGNAL = 'signal.signal(signal.SIGUSR1, self.on_signal)'


def under(lock: str, text: str) -> str:
    return f'with self.{lock}:\n{indent(text, " " * 4)}'


def races(spin: str = SPIN, **bodies: str) -> str:
    given = {'made': 'pass', 'on_a': 'pass', 'on_signal': 'pass', 'once': 'pass', **bodies}
    put = {name: indent(text, ' ' * 8).strip() for name, text in given.items()}
    [unit] = scan_text(PROGRAM.format(spin=spin, **put), 'store.py').units
    assert read_specs(write_specs([unit]), 'store.yaml') == (unit,)
    verification = verify_unit(close(unit), Options(profile=Profile.RCLPY))
    judgements = {each.promise: each for each in judge(unit, verification, [])}
    return judgements[Promise.RACES].reason


@pytest.mark.parametrize(
    ('on_signal', 'on_a'),
    [
        ('self.n = 0', CHANGE),
        ('self.n = 0', under('again', CHANGE)),
        (under('again', 'self.n = 0'), under('again', CHANGE)),
        (CHANGE, 'self.n = 0'),
    ],
)
def test_a_handler_of_a_signal_interrupts_the_callback(on_signal: str, on_a: str) -> None:
    reason = races(made=ON_SIGNAL, on_signal=on_signal, on_a=on_a)
    assert reason == (
        'Store.on_signal may run (a signal comes at any time) beside Store.on_a, '
        'and both use Store.n'
    )


@pytest.mark.parametrize(
    ('on_signal', 'on_a', 'spin'),
    [
        ('self.n = 0', 'self.n = 1', SPIN),
        ('self.busy = True', CHANGE, SPIN),
        (under('again', 'self.n = 0'), under('again', CHANGE), POOL),
        (under('lock', 'self.n = 0'), under('lock', CHANGE), POOL),
    ],
)
def test_a_handler_that_only_stores_or_shares_a_lock_with_a_pool_does_no_harm(
    on_signal: str, on_a: str, spin: str
) -> None:
    assert races(spin, made=ON_SIGNAL, on_signal=on_signal, on_a=on_a) == ''


@pytest.mark.parametrize(
    'start',
    ['threading.Timer(1.0, self.once).start()', 'threading.Thread(target=self.once).start()'],
)
def test_the_thread_of_the_run_before_may_still_be_at_work(start: str) -> None:
    reason = races(on_a=f'{CHANGE}\n{start}', once=CHANGE)
    assert reason.endswith(
        'may still run when Store.on_a starts it once more, and both use Store.n'
    )
    assert races(on_a=f'{under("lock", CHANGE)}\n{start}', once=under('lock', CHANGE)) == ''


def test_a_thread_that_has_ended_by_then_is_not_in_the_way() -> None:
    joined = f'{CHANGE}\nt = threading.Thread(target=self.once)\nt.start()\nt.join()'
    guarded = (
        f'if self.busy:\n    return\nself.busy = True\n{CHANGE}\n'
        'threading.Thread(target=self.once).start()'
    )
    assert races(on_a=joined, once=CHANGE) == ''
    assert races(on_a=guarded, once=f'{CHANGE}\nself.busy = False') == ''


def test_what_a_library_calls_of_a_class_that_is_part_of_it_may_run_at_any_time() -> None:
    made = 'self.o = Observer()\nself.o.schedule(Changed(self), ".")\nself.o.start()'
    assert 'Changed.on_modified may run' in races(made=made, on_a=CHANGE, once=CHANGE)
    locked = under('lock', CHANGE)
    assert races(made=made, on_a=locked, once=locked) == ''


def test_what_such_a_class_does_with_the_node_hides_none_of_its_entities() -> None:
    text = PROGRAM.format(
        made='self.changed = Changed(self)', on_a='pass', on_signal='pass', once='pass', spin=SPIN
    )
    [unit] = scan_text(text.replace('self.node.once()', 'files.show(self.node)')).units
    assert unit.unresolved == ()


TWO = """\
import threading, time
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

class Store(Node):
    def __init__(self):
        super().__init__('store')
        self.x = self.y = 0
        self.rows = [1]
        self.goal = None
        self.create_subscription(String, 'a', self.on_a, 10)

    def on_a(self, msg):
        {on_a}

class Other(Node):
    def __init__(self, store):
        super().__init__('other')
        self.store = store
        self.create_timer(0.1, self.tick)

    def tick(self):
        {tick}

rclpy.init()
store = Store()
executor = SingleThreadedExecutor()
executor.add_node(Other(store))
threading.Thread(target=executor.spin, daemon=True).start()
rclpy.spin(store)
"""


@pytest.mark.parametrize(
    ('on_a', 'tick'),
    [
        ('self.x += len(msg.data)', 'self.store.x += len(str(time.time()))'),
        ('self.x = len(msg.data)', 'self.store.x = 0'),
        (
            'self.x = time.time()\ntime.sleep(0.01)\nself.y = self.x',
            'print(self.store.x, self.store.y)',
        ),
        (
            'self.rows.pop()',
            'for i in range(len(self.store.rows)):\n    print(self.store.rows[i])',
        ),
        (
            'self.goal = None',
            'if self.store.goal is not None:\n    print()\n    self.store.goal.cancel()',
        ),
        (
            'if self.x == 0:\n    time.sleep(0.01)\n    self.x = 1',
            'if self.store.x == 0:\n    time.sleep(0.01)\n    self.store.x = 1',
        ),
    ],
)
def test_what_two_executors_do_to_each_other_keeps_neither_promise(
    on_a: str, tick: str, tmp_path: Path
) -> None:
    path = tmp_path / 'two.py'
    bodies = {'on_a': on_a, 'tick': tick}
    put = {name: indent(text, ' ' * 8).strip() for name, text in bodies.items()}
    path.write_text(TWO.format(**put), encoding='utf-8')
    assert Mark.KEPT not in marks(path)
    path.write_text(TWO.format(on_a='print(self.x)', tick='print(self.store.x)'), encoding='utf-8')
    assert marks(path) == [Mark.KEPT, Mark.KEPT]


def marks(path: Path) -> list[Mark]:
    outcome = check_paths(job(path, None, cached=False), io.StringIO())
    races = Promise.RACES
    return [one.mark for promises in outcome.promises for one in promises if one.promise is races]
