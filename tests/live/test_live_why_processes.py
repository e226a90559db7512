"""``why`` of several processes: a node is found by its name, waits lead to other processes."""

from __future__ import annotations

import io
import json
import re
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from interpreters import EVERY_RELEASE, interpreter_of

from ros2cc_extract.cli.main import main
from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.live import injection, rclpy_processes, why
from ros2cc_extract.extract.live.hang_analysis.formats import as_mermaid, as_text
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import Verdict
from ros2cc_extract.extract.live.why import explain_all, explain_node
from tests.live.standing import SETTLES_S, programs, told

ROBOT = """
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

class NAME(Node):
    def __init__(self):
        super().__init__('NAME', namespace='robot')
        self.other = self.create_client(
            Trigger, '/ASKED', callback_group=MutuallyExclusiveCallbackGroup())
        self.offered = self.create_service(Trigger, '/OFFERED', self.serve)
        MORE

    def drive(self):
        self.timer.cancel()
        self.other.wait_for_service()
        self.other.call(Trigger.Request())
        print('asks', flush=True)

    def serve(self, request, response):
        print('asks', flush=True)
        self.other.wait_for_service()
        self.other.call(Trigger.Request())
        return response

rclpy.init()
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(NAME())
executor.spin()
"""


def robot(name: str, offered: str, asked: str, more: str = '') -> str:
    words = {'NAME': name, 'OFFERED': offered, 'ASKED': asked, 'MORE': more}
    return re.sub('|'.join(words), lambda word: words[word[0]], ROBOT)


def line_of(text: str, function: str) -> int:
    lines = text.splitlines()
    after = lines.index(next(line for line in lines if f'def {function}(' in line))
    return next(n for n, line in enumerate(lines[after:], after + 1) if '.call(' in line)


DRIVES = 'self.timer = self.create_timer(0.5, self.drive)'
ARM = robot('arm', 'pose', 'plan', f"{DRIVES}; print('asks', flush=True)")
PLANNER = robot('planner', 'plan', 'pose')
# It answers in a group of its own, without asking.
FREE_ARM = ARM.replace(
    "'/pose', self.serve)",
    "'/pose', lambda request, response: response,\n"
    '            callback_group=MutuallyExclusiveCallbackGroup())',
)


def slow(text: str) -> str:
    """The same with a service that works for a minute before it asks."""
    return text.replace(
        "        print('asks', flush=True)\n        self.other.wait",
        "        import time; print('asks', flush=True); time.sleep(60)\n        self.other.wait",
    )


@pytest.fixture(autouse=True)
def _patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """On a busy machine an answer takes longer than a user is to wait."""
    for module in (injection, why):
        monkeypatch.setattr(module, 'PATIENCE_S', 60.0)


@contextmanager
def pair(python: str, arm: str, planner: str) -> Iterator[list[int]]:
    with programs(python, {'arm.py': arm, 'planner.py': planner}) as started:
        time.sleep(SETTLES_S)
        yield [each.pid for each in started]


@pytest.mark.parametrize('variable', EVERY_RELEASE)
def test_cycle_over_two_processes_is_a_deadlock(variable: str) -> None:
    with pair(interpreter_of(variable), ARM, PLANNER) as (arm, planner):
        found = explain_all([arm, planner]).found
        assert [told(each) for each in found] == [
            ('deadlock', [('drive', line_of(ARM, 'drive'), 'CC109')]),
            ('deadlock', [('serve', line_of(PLANNER, 'serve'), 'CC109')]),
        ]
        assert as_text(found).splitlines()[0] == (
            f'deadlock over 2 processes: process {arm} (/robot/arm) waits for /plan of process '
            f'{planner}; process {planner} (/robot/planner) waits for /pose of process {arm}'
        )
        assert f'|offered by| p{planner}' in as_mermaid(found)
        # Alone, nobody can know what the other one does.
        assert explain_all([arm]).found[0].verdict is Verdict.OUTSIDE


def test_service_that_another_process_answers_in_time_is_no_deadlock(rclpy_python: str) -> None:
    with pair(rclpy_python, FREE_ARM, PLANNER) as pids:
        verdicts = {each.verdict for each in explain_all(pids).found}
    assert verdicts <= {Verdict.HEALTHY, Verdict.BUSY, Verdict.OUTSIDE}


def test_wait_for_a_process_at_work_names_it(rclpy_python: str) -> None:
    with pair(rclpy_python, ARM, slow(PLANNER)) as (arm, planner):
        explanation = explain_node('arm', [arm, planner])
    (asking,) = (each for each in explanation.standings if each.asked)
    assert (explanation.process, explanation.verdict) == (arm, Verdict.OUTSIDE)
    assert (asking.asked, asking.can_end) == ((planner,), True)
    assert asking.reasons[0].startswith(f'it is offered by process {planner} (/robot/planner); ')


def test_wait_for_an_own_service_at_work_is_for_no_other_process(rclpy_python: str) -> None:
    apart = 'self.serve, callback_group=MutuallyExclusiveCallbackGroup())'
    own = slow(robot('arm', 'plan', 'plan', DRIVES)).replace('self.serve)', apart)
    with programs(rclpy_python, {'arm.py': own}) as (arm,):
        time.sleep(SETTLES_S)
        (explanation,) = explain_all([arm.pid]).found
    assert explanation.verdict is Verdict.BUSY


def test_node_is_found_by_its_name(rclpy_python: str) -> None:
    with pair(rclpy_python, FREE_ARM, slow(PLANNER)) as (arm, planner):
        for name in ('/robot/planner', 'robot/planner', 'planner'):
            assert explain_node(name, [arm, planner]).process == planner
        with pytest.raises(InputError) as wrong:
            explain_node('/planner', [arm, planner])
        assert str(wrong.value) == (
            "no process of yours runs a node '/planner'; did you mean '/robot/planner'?"
        )


def test_node_that_runs_twice_is_ambiguous(rclpy_python: str) -> None:
    with pair(rclpy_python, FREE_ARM, FREE_ARM) as pids:
        one, other = sorted(pids)
        with pytest.raises(InputError, match=f'runs in processes {one} and {other}; give one'):
            explain_node('arm', pids)


def test_processes_with_rclpy_are_recognised(rclpy_python: str) -> None:
    with subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(60)']) as plain:
        try:
            with pair(rclpy_python, FREE_ARM, PLANNER) as pids:
                known = rclpy_processes.rclpy_processes()
        finally:
            plain.kill()
    assert set(pids) <= set(known)
    assert plain.pid not in known


def test_all_as_json_tells_of_processes_that_let_nobody_in(
    rclpy_python: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    stdout, stderr = io.StringIO(), io.StringIO()
    with (
        pair(rclpy_python, ARM, PLANNER) as pids,
        subprocess.Popen(['sleep', '60']) as other,
    ):
        monkeypatch.setattr(rclpy_processes, 'rclpy_processes', lambda: [*pids, other.pid])
        status = main(['why', '--all', '--output-format', 'json'], stdout, stderr)
        other.kill()
    found = json.loads(stdout.getvalue())
    assert status == 1
    assert [each['process'] for each in found['processes']] == sorted(pids)
    assert [each['of_processes'] for each in found['processes'][0]['activities'] if each['code']]
    assert [each['process'] for each in found['not_explained']] == [other.pid]
    assert f'process {other.pid} cannot be entered' in stderr.getvalue()


@pytest.mark.parametrize(
    ('arguments', 'complaint'),
    [
        (['why'], 'one process, one node or --all; as in: why 4711'),
        (['why', '4711', '--all'], 'one process, one node or --all; as in: why 4711'),
        (['why', 'arm'], 'no process of yours on this machine runs an rclpy node'),
        (['why', '--all'], 'no process of yours on this machine runs an rclpy node'),
    ],
)
def test_what_cannot_be_asked_is_one_line_and_status_2(
    arguments: list[str], complaint: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(rclpy_processes, 'rclpy_processes', lambda: [])
    stderr = io.StringIO()
    assert main(arguments, io.StringIO(), stderr) == 2
    assert stderr.getvalue() == f'ros2cc-extract: error: {complaint}\n'
