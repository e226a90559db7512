"""Threads of Qt are threads; what Qt calls may run beside the callbacks."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.promises import Promise, judge
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.spec.close import close
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit
from tests.help.cases import said

PROGRAM = """\
import sys
import threading
import rclpy
from rclpy.node import Node
from BINDING.QtCore import QObject, QRunnable, QThread, QThreadPool, QTimer
from BINDING.QtWidgets import QApplication, QMainWindow, QPushButton
from std_srvs.srv import Trigger

class Counter(Node):
    def __init__(self):
        super().__init__('counter')
        self.total = 0
        self.ready = threading.Event()
        self.client = self.create_client(Trigger, 'reset')
        self.create_service(Trigger, 'count', self.on_count)

    def on_count(self, request, response):
        self.total += len(str(self.total))
        self.ready.set()
        return response

    def add(self):
        self.total += len(str(self.total))
ASKS
CLASSES

class Window(QMainWindow):
    def __init__(self, node):
        super().__init__()
        self.node = node
        self.button = QPushButton('add', self)
        SHOWN

    def keyPressEvent(self, event):
        KEY

rclpy.init()
app = QApplication(sys.argv)
node = Counter()
STARTED
window = Window(node)
SERVED
"""
THREAD = """\
class Thread(QThread):
    def __init__(self, node):
        super().__init__()
        self.node = node

    def run(self):
        """
SPINS = 'rclpy.spin(self.node)'
ADDS = """\
while True:
            self.node.add()
            self.msleep(100)
"""
WAITS = 'self.node.ready.wait()'
BEGUN = 'thread = Thread(node)\nthread.start()'
WORKER = """\
class Worker(QObject):
    def __init__(self, node):
        super().__init__()
        self.node = node

    def work(self):
        """
ASKS = """\

    def ask(self):
        self.add()
        future = self.client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self, future)
"""
ASKS_LATER = """\

    def ask(self):
        self.add()
        self.client.call_async(Trigger.Request()).add_done_callback(print)
"""
JOB = """\
class Job(QRunnable):
    def __init__(self, node):
        super().__init__()
        self.node = node

    def run(self):
        self.node.add()
"""
MOVED = """\
thread = QThread()
worker = Worker(node)
worker.moveToThread(thread)
thread.started.connect(worker.work)
thread.start()
"""
LOST = ['CC301']


def program(
    classes: str,
    started: str,
    *,
    shown: str = 'pass',
    key: str = 'pass',
    asks: str = '',
    served: str = 'app.exec()',
    binding: str = 'PyQt5',
) -> str:
    parts = {
        'CLASSES': classes,
        'SHOWN': shown,
        'KEY': key,
        'STARTED': started,
        'SERVED': served,
        'BINDING': binding,
    }
    text = PROGRAM.replace('ASKS', asks)
    for name, part in parts.items():
        text = text.replace(name, part)
    return text


def codes(text: str) -> list[str]:
    return sorted({each.code for each in said(text)})


def open_races(text: str) -> str:
    [unit] = scan_text(text, 'counter.py').units
    verification = verify_unit(close(unit), Options(profile=Profile.RCLPY))
    judgements = {each.promise: each for each in judge(unit, verification, [])}
    return judgements[Promise.RACES].reason


@pytest.mark.parametrize(
    ('classes', 'started'),
    [
        (THREAD + ADDS, BEGUN),
        (WORKER + ADDS.replace('self.msleep', 'QThread.msleep'), MOVED),
        (JOB, 'QThreadPool.globalInstance().start(Job(node))'),
        (JOB, 'pool = QThreadPool()\npool.start(Job(node))'),
    ],
)
@pytest.mark.parametrize('binding', ['PyQt5', 'PySide6'])
def test_what_runs_on_such_a_thread_races_with_the_callbacks(
    classes: str, started: str, binding: str
) -> None:
    assert codes(program(classes, started, served='rclpy.spin(node)', binding=binding)) == LOST


def test_a_thread_that_never_starts_does_not() -> None:
    assert codes(program(THREAD + ADDS, 'thread = Thread(node)', served='rclpy.spin(node)')) == []


@pytest.mark.parametrize(
    ('then', 'found'), [('thread.wait()', ['CC110']), ('thread.wait(500)', []), ('pass', [])]
)
def test_a_wait_for_its_end_is_a_join(then: str, found: list[str]) -> None:
    started = f'{BEGUN}\n{then}'
    assert codes(program(THREAD + WAITS, started, served='rclpy.spin(node)')) == found


@pytest.mark.parametrize(('classes', 'started'), [(THREAD, BEGUN), (WORKER, MOVED)])
def test_a_window_that_spins_what_such_a_thread_spins_is_told(classes: str, started: str) -> None:
    shown = 'self.button.clicked.connect(self.node.ask)'
    assert 'CC107' in codes(program(classes + SPINS, started, shown=shown, asks=ASKS))


@pytest.mark.parametrize(('classes', 'started'), [(THREAD, BEGUN), (WORKER, MOVED)])
@pytest.mark.parametrize(
    'shown',
    [
        'self.button.clicked.connect(self.node.add)',
        'self.button.clicked.connect(lambda: self.node.add())',
        'self.button.clicked.connect(self.node.ask)',
        'self.timer = QTimer(self)\n        self.timer.timeout.connect(self.node.add)',
        'QTimer.singleShot(100, self.node.add)',
    ],
)
def test_what_qt_calls_may_run_beside_the_callbacks(
    classes: str, started: str, shown: str
) -> None:
    reason = open_races(program(classes + SPINS, started, shown=shown, asks=ASKS_LATER))
    assert 'beside Counter.on_count' in reason


def test_so_may_a_handler_of_events() -> None:
    reason = open_races(program(THREAD + SPINS, BEGUN, key='self.node.add()'))
    assert reason.startswith('Window.keyPressEvent may run (it is handed to PyQt5.QtWidgets.')
    assert open_races(program(THREAD + SPINS, BEGUN)) == ''
