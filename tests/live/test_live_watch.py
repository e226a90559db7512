"""A standstill is explained by the hook: once, and not where a node is only idle."""

from __future__ import annotations

import io
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

import pytest
from child import Child
from interpreters import EVERY_RELEASE_AT_LEISURE, interpreter_of

from ros2cc_extract.extract.live.environment import hooked_environment
from ros2cc_extract.extract.live.hook.diagnostics import HEALTHY
from ros2cc_extract.extract.live.hook.diagnostics import VARIABLE as DIAGNOSTICS
from ros2cc_extract.extract.live.hook.watch import FILE_SUFFIX, VARIABLE, limit_of
from ros2cc_extract.extract.live.run import run_command
from tests.live.standing import programs

LIMIT_S = 1.0
HEAD = """
import threading, time
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger

class Some(Node):
    def __init__(self):
        super().__init__('some')
        self.called = self.create_client(Trigger, 'given')
        self.create_service(Trigger, 'given', lambda request, response: response)
        self.create_subscription(String, 'words', print, 1)
        self.slow = self.create_timer(1000.0, self.ask)
MORE
    def ask(self):
        self.called.call(Trigger.Request())

    def sleep(self):
        time.sleep(600)

    def tick(self):
        pass

rclpy.init()
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(Some())
print('asks', flush=True)
SPINS
"""


def node(*made: str, spins: str = 'executor.spin()') -> str:
    lines = ''.join(f'        {line}\n' for line in made)
    return HEAD.replace('MORE\n', f'{lines}\n').replace('SPINS', spins)


ASKS = 'self.create_timer(0.1, self.ask)'
TICKS = 'self.create_timer(0.2, self.tick, callback_group=ReentrantCallbackGroup())'
IDLE = node()
SOUND = node(TICKS)


@contextmanager
def watched(python: str, text: str, folder: Path) -> Iterator[Path]:
    """Run a program under the watch of its hook; gives the folder of the explanations."""
    folder.mkdir(exist_ok=True)
    variables = hooked_environment({}, folder, limit_s=LIMIT_S)
    with programs(python, {'node.py': text}, **variables):
        yield folder


def explanations(folder: Path) -> list[str]:
    return [path.read_text() for path in folder.glob(f'*{FILE_SUFFIX}')]


def explanation(folder: Path) -> str:
    deadline = time.monotonic() + 60
    while not explanations(folder) and time.monotonic() < deadline:
        time.sleep(0.05)
    # It comes once, however long the process stands.
    time.sleep(3 * LIMIT_S)
    (text,) = explanations(folder)
    assert text.count(f' ended for {LIMIT_S:g} s\n') == 1
    return text


def at_once(
    python: str, texts: Sequence[str], folder: Path, look: Callable[[Path], str]
) -> list[str]:
    """Watch programs side by side, for they only wait; gives what ``look`` says of each."""

    def run(at: int) -> str:
        with watched(python, texts[at], folder / str(at)) as written:
            return look(written)

    with ThreadPoolExecutor(len(texts)) as pool:
        return [*pool.map(run, range(len(texts)))]


@pytest.mark.parametrize('variable', EVERY_RELEASE_AT_LEISURE)
def test_deadlock_is_explained_once(variable: str, tmp_path: Path) -> None:
    programs = [node(ASKS), node(ASKS, TICKS)]
    alone, beside = at_once(interpreter_of(variable), programs, tmp_path, explanation)
    # Kilted runs callbacks of its own at the start, which may end within the limit.
    for text, says in (
        (alone, ('no callback has ended', 'a callback has not ended')),
        (beside, ('a callback has not ended',)),
    ):
        first, verdict, *lines = text.splitlines()
        assert first.removeprefix('ros2cc-extract: ').startswith(says)
        assert ' (/some): deadlock: ' in verdict
        assert 'CC101 Some.ask ' in lines[0]


def test_what_else_stands_still_is_explained(rclpy_python: str, tmp_path: Path) -> None:
    elsewhere = "Client = self.create_client(Trigger, 'elsewhere')"
    stands = {
        'busy': node('self.create_timer(0.1, self.sleep)'),
        'never spun': node(TICKS, spins='time.sleep(600)'),
        'waits for another process': node(
            elsewhere, 'self.create_timer(0.1, lambda: Client.wait_for_service())'
        ),
    }
    texts = at_once(rclpy_python, [*stands.values()], tmp_path, explanation)
    for verdict, text in zip(stands, texts, strict=True):
        assert f' (/some): {verdict}: ' in text


def test_node_that_is_idle_or_goes_on_is_not_reported(rclpy_python: str, tmp_path: Path) -> None:
    """Nor a long callback beside others that end."""
    long = node('self.create_timer(0.1, self.sleep)', TICKS)

    def news(folder: Path) -> str:
        time.sleep(4 * LIMIT_S)
        assert list(folder.glob('*.json'))
        return ''.join(explanations(folder))

    assert at_once(rclpy_python, [IDLE, SOUND, long], tmp_path, news) == ['', '', '']


def test_callback_that_comes_to_a_stop_later_is_explained_again(
    rclpy_python: str, tmp_path: Path
) -> None:
    later = node(ASKS).replace('self.called.call', 'time.sleep(2.5); self.called.call')
    with watched(rclpy_python, later, tmp_path) as folder:
        deadline = time.monotonic() + 60
        while 'deadlock' not in ''.join(explanations(folder)) and time.monotonic() < deadline:
            time.sleep(0.05)
        (text,) = explanations(folder)
    verdicts = [line.split(': ')[1] for line in text.splitlines() if line.startswith('process ')]
    assert verdicts == ['busy', 'deadlock']


def test_run_writes_it_beside_the_specification(
    rclpy_python: str,
    ros_env: dict[str, str],
    tmp_path: Path,
    capfd: pytest.CaptureFixture[str],
) -> None:
    ends = 'threading.Timer(5.0, rclpy.shutdown).start()\nexecutor.spin()\nimport os; os._exit(0)'
    program = tmp_path / 'node.py'
    program.write_text(node('self.create_timer(0.1, lambda: time.sleep(4))', spins=ends))
    stderr = io.StringIO()
    output = tmp_path / 'live.spec.yaml'
    command = [rclpy_python, str(program)]
    run_command(command, output, stderr, limit_s=LIMIT_S, environment=ros_env)
    assert ' (/some): busy: ' in (tmp_path / f'live{FILE_SUFFIX}').read_text()
    assert f'live{FILE_SUFFIX} says why callbacks did not end' in stderr.getvalue()
    assert ' (/some): busy: ' in capfd.readouterr().err
    assert output.exists()


@pytest.mark.parametrize(
    ('text', 'limit'), [('5', 5.0), ('0.5', 0.5), ('', None), (None, None), ('0', None)]
)
def test_limit_is_read_from_the_environment(text: str | None, limit: float | None) -> None:
    assert limit_of(text) == limit


def test_limit_that_is_no_number_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    assert limit_of('soon') is None
    assert "ROS2CC_LIVE_WATCH='soon' is no number of seconds" in capsys.readouterr().err


NAPS = 'self.create_timer(0.1, lambda: time.sleep(next(naps)))'
LISTENER = """
import rclpy
from diagnostic_msgs.msg import DiagnosticArray

def heard(message):
    (status,) = message.status
    print(ord(status.level), status.name, status.message, flush=True)
    for value in status.values:
        if value.key == 'explanation':
            print(value.value, flush=True)

rclpy.init()
node = rclpy.create_node('listener')
node.create_subscription(DiagnosticArray, '/diagnostics', heard, 10)
rclpy.spin(node)
"""


def test_standstill_is_on_diagnostics_until_it_passes(
    start: Callable[..., Child], tmp_path: Path
) -> None:
    listener, program = tmp_path / 'listener.py', tmp_path / 'node.py'
    listener.write_text(LISTENER)
    stands = 'naps = itertools.cycle([0] * 10 + [4])'
    program.write_text(f'import itertools\n{stands}\n' + node(NAPS))
    hears = start(listener)
    start(program, recorded_into=tmp_path, **{VARIABLE: f'{LIMIT_S:g}', DIAGNOSTICS: '1'})
    healthy, busy = f'0 /some: callbacks {HEALTHY}\n', '1 /some: callbacks busy\n'
    hears.read_until(lambda lines: healthy in lines)
    hears.read_until(lambda lines: busy in lines)
    after = len(hears.lines)
    hears.read_until(lambda lines: healthy in lines[after:])
    assert any('node.py:' in line for line in hears.lines)
