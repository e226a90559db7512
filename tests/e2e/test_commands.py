"""The commands as a user types them, on real example nodes."""

from __future__ import annotations

import json
import os
import re
import subprocess
from pathlib import Path

import jsonschema
import pytest
import yaml

from ros2cc_extract.cli.main import COMMANDS
from ros2cc_extract.spec.yaml.yaml_io import SPEC
from tests.e2e.conftest import EXAMPLES, Run

CASE_1 = EXAMPLES / 'paper_case1' / 'node.py'


@pytest.mark.parametrize('command', [*COMMANDS, ''])
def test_help_tells_the_arguments(run: Run, command: str) -> None:
    outcome = run(*([command] if command else []), '--help')
    assert outcome.status == 0
    assert outcome.out.startswith('usage: ros2cc-extract')


def test_spec_is_one_valid_document_per_unit(run: Run) -> None:
    outcome = run('spec', CASE_1)
    assert outcome.status == 0
    (document,) = yaml.safe_load_all(outcome.out)
    jsonschema.validate(document, SPEC.schema)
    assert [c['type'] for c in document['node']['callbacks']] == ['TMR', 'TMR', 'SUB', 'SUB']


def test_spec_lists_what_rclpy_makes_on_request(run: Run) -> None:
    plain, full = (run('spec', CASE_1, *more).out for more in ((), ('--builtin',)))
    assert 'builtin: true' not in plain
    assert full.count('entity: parameter_service') == 6


CALLER = """\
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.client = self.create_client(Trigger, 'plan')
        self.create_timer(1.0, self.ask)

    def ask(self):
        self.client.call(Trigger.Request())


rclpy.init()
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(Arm())
executor.spin()
"""


def test_a_blocked_default_group_stops_the_parameter_services_too(
    run: Run, tmp_path: Path
) -> None:
    source = tmp_path / 'arm.py'
    source.write_text(CALLER)
    command = ['verify', str(source), '--profile', 'rclpy']
    plain, full = (run(*command, *more).out for more in ((), ('--builtin',)))
    starving = re.compile(r': (_\w+_parameters_callback) never starves: .*: not satisfied')
    assert starving.findall(plain) == []
    assert starving.findall(full) == [
        f'_{what}_parameters_callback' for what in ('describe', 'get', 'list', 'set')
    ]


PARAMETERS = """\
import rclpy
from rclpy.node import Node


class Tuned(Node):
    def __init__(self):
        super().__init__('tuned')
        self.add_on_set_parameters_callback(self.on_parameters)

    def on_parameters(self, parameters):
        return None


rclpy.init()
rclpy.spin(Tuned())
"""


def test_node_with_parameter_callbacks_alone_keeps_nobody_from_being_checked(
    run: Run, tmp_path: Path
) -> None:
    (tmp_path / 'tuned.py').write_text(PARAMETERS)
    outcome = run('check', 'tuned.py', CASE_1, '--output-format', 'json')
    assert outcome.status != 2, outcome.err
    assert sorted(u['node']['name'] for u in json.loads(outcome.out)['units']) == [
        'paper_case1',
        'tuned',
    ]


def test_model_writes_what_uppaal_and_the_published_tool_need(run: Run, tmp_path: Path) -> None:
    outcome = run('model', CASE_1, '-o', 'out')
    assert outcome.status == 0
    names = sorted(path.name for path in (tmp_path / 'out').iterdir())
    unit = 'paper_case1'
    assert names == [
        f'{unit}.q',
        f'{unit}.xml',
        f'{unit}_declarations.c',
        f'{unit}_query.q',
        f'{unit}_system.c',
    ]


def test_model_draws_its_automata_on_request(run: Run, tmp_path: Path) -> None:
    outcome = run('model', CASE_1, '-o', 'out', '--svg')
    assert outcome.status == 0
    drawn = sorted((tmp_path / 'out').glob('*.svg'))
    assert [path.stem.removeprefix('paper_case1_') for path in drawn] == [
        'Callback',
        'CallbackGroup',
        'Executor',
        'Thread',
    ]
    assert all(path.read_text().startswith('<svg ') for path in drawn)


def test_verify_reads_the_model_that_model_wrote(run: Run) -> None:
    run('model', CASE_1, '-o', 'out')
    from_source = json.loads(
        run('verify', CASE_1, '--text', 'plain', '--output-format', 'json').out
    )
    outcome = run(
        'verify',
        'out/paper_case1.xml',
        'out/paper_case1.q',
        '--output-format',
        'json',
    )
    from_model = json.loads(outcome.out)
    assert outcome.status == 0
    for key in ('states', 'transitions', 'complete'):
        assert from_model[key] == from_source[key]
    assert [q['verdict'] for q in from_model['queries']] == [
        q['verdict'] for q in from_source['queries']
    ]


def test_a_pipe_gives_what_a_file_gives(run: Run, tmp_path: Path) -> None:
    written = run('spec', CASE_1).out
    (tmp_path / 'arm.yaml').write_text(written)
    os.mkfifo(tmp_path / 'pipe')
    with subprocess.Popen(['cp', 'arm.yaml', 'pipe'], cwd=tmp_path):
        statuses = [
            run('model', 'arm.yaml', '-o', 'of_a_file').status,
            run('model', '-', '-o', 'of_standard_input', given=written.encode()).status,
            run('model', 'pipe', '-o', 'of_a_pipe').status,
        ]
    assert statuses == [0, 0, 0]
    expected = texts_in(tmp_path / 'of_a_file')
    assert 'paper_case1.xml' in expected
    assert texts_in(tmp_path / 'of_standard_input') == expected
    assert texts_in(tmp_path / 'of_a_pipe') == expected


def texts_in(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text() for path in folder.iterdir()}


def test_a_pipe_that_gives_no_text_is_told(run: Run) -> None:
    refused = run('verify', '-', given=b'\xff')
    assert (refused.status, refused.err) == (
        2,
        'ros2cc-extract: error: <stdin>: no UTF-8 text (byte 0)\n',
    )


def test_check_prints_units_verdicts_and_runs(run: Run) -> None:
    outcome = run(CASE_1, '--verdicts', '-v')
    assert outcome.status == 1  # CC201: callbacks sleep longer than a period
    assert 'checked paper_case1: SingleThreadedExecutor, 1 thread' in outcome.out
    assert 'unit paper_case1\n' in outcome.out
    assert 'on_timer_a' in outcome.out
    assert 'more runs: ros2cc-extract verify shows them' in outcome.out
    assert 'counterexample' in run(EXAMPLES / 'two_groups' / 'node.py', '--verdicts').out
    assert 'counterexample' not in run(EXAMPLES / 'two_groups' / 'node.py').out


def test_check_keeps_what_it_made(run: Run, tmp_path: Path) -> None:
    run(CASE_1, '-o', 'kept')
    names = {path.name for path in (tmp_path / 'kept').iterdir()}
    assert {'paper_case1.spec.yaml', 'paper_case1.xml', 'paper_case1.q'} <= names


def test_a_limit_gives_undecided_and_status_3(run: Run) -> None:
    outcome = run(
        'verify',
        CASE_1,
        '--text',
        'plain',
        '--no-reduction',
        '--max-states',
        '1000',
        '--output-format',
        'json',
    )
    data = json.loads(outcome.out)
    assert outcome.status == 3
    assert data['complete'] is False
    assert {q['verdict'] for q in data['queries']} <= {
        'satisfied',
        'not satisfied',
        'undecided',
    }
    assert 'undecided' in {q['verdict'] for q in data['queries']}


def test_json_of_check_holds_everything(run: Run) -> None:
    outcome = run(CASE_1, '--output-format', 'json')
    data = json.loads(outcome.out)
    assert set(data) == {
        'units',
        'verdicts',
        'promises',
        'findings',
        'summary',
        'confidence',
    }
    assert data['summary']['units'] == 1
    assert len(data['verdicts'][0]['queries']) == 26


def test_the_same_input_gives_the_same_output(run: Run) -> None:
    first, second = (run('spec', EXAMPLES).out for _ in range(2))
    assert first == second != ''


def test_a_node_that_only_publishes_is_told_and_left_out(run: Run, tmp_path: Path) -> None:
    (tmp_path / 'talker.py').write_text(
        'import rclpy\n'
        'from std_msgs.msg import String\n'
        "rclpy.init()\nnode = rclpy.create_node('talker')\n"
        "out = node.create_publisher(String, 'chatter', 10)\n"
        'rclpy.spin(node)\n'
    )
    outcome = run('talker.py')
    assert outcome.status == 0
    assert 'unit talker has no callback, left out' in outcome.err
    assert outcome.out == 'Nothing to check in 1 file: no node with a callback\n'


def test_nothing_judged_does_not_read_as_safe(run: Run, tmp_path: Path) -> None:
    (tmp_path / 'tool.py').write_text('def main():\n    return 1\n')
    outcome = run('tool.py')
    assert outcome.status == 0
    assert outcome.err == 'nothing to check: no rclpy node with a callback found\n'


def test_a_launch_file_that_starts_nothing_in_sight_is_undecided(run: Run, tmp_path: Path) -> None:
    (tmp_path / 'robot.launch.py').write_text('def main():\n    return 1\n')
    outcome = run('robot.launch.py')
    assert outcome.status == 3
    assert outcome.err == 'nothing to check: the launch file starts no known process\n'
    assert 'not followed: no function generate_launch_description is found' in outcome.out


def test_a_unit_left_out_says_what_could_not_be_followed(run: Run, tmp_path: Path) -> None:
    (tmp_path / 'robot.py').write_text(
        'import rclpy\n'
        'from somewhere import fill\n'
        "rclpy.init()\nnode = rclpy.create_node('robot')\n"
        'fill(node)\n'
        'rclpy.spin(node)\n'
    )
    outcome = run('robot.py')
    assert 'unit robot has no known callback, left out' in outcome.err
    assert outcome.out.splitlines()[0] == (
        'robot.py:5:1: note CC501: the node is passed to somewhere.fill, which is not scanned: '
        'unit robot is left out, and may have callbacks'
    )
    assert (outcome.status, run('robot.py', '--strict').status) == (0, 3)


def test_a_second_scan_takes_the_first_ones_result(run: Run, tmp_path: Path, cache: Path) -> None:
    node = tmp_path / 'node.py'
    node.write_text(CASE_1.read_text())
    first = run('spec', 'node.py').out
    assert list(cache.rglob('*.scan'))
    assert run('spec', 'node.py').out == first == run('spec', 'node.py', '--no-cache').out
    node.write_text(CASE_1.read_text().replace("'msg_C'", "'msg_E'"))
    assert 'topic: msg_E' in run('spec', 'node.py').out


def test_merge_tells_known_facts_that_differ(run: Run, tmp_path: Path) -> None:
    scanned = run('spec', EXAMPLES / 'two_groups' / 'node.py').out
    one, other = tmp_path / 'one.yaml', tmp_path / 'other.yaml'
    one.write_text(scanned)
    changed, count = re.subn(r'period_s: [\d.]+', 'period_s: 77.0', scanned, count=1)
    assert count == 1
    other.write_text(changed)
    assert run('merge', one, one).err == ''
    outcome = run('merge', one, other)
    (told,) = outcome.err.splitlines()
    assert outcome.status == 0
    assert re.match(r'ros2cc-extract: \w+: period_s of \w+: [\d.]+ in ', told)
    assert told.endswith('; the first is kept')
    assert f'77.0 in {other}' in told


def test_merge_of_two_programs_is_told(run: Run, tmp_path: Path) -> None:
    one, other = tmp_path / 'one.yaml', tmp_path / 'other.yaml'
    one.write_text(run('spec', CASE_1).out)
    other.write_text(run('spec', EXAMPLES / 'two_groups' / 'node.py').out)
    outcome = run('merge', one, other)
    what = f'no unit of {one} is one of {other}; all are written as they are'
    assert (outcome.status, outcome.err) == (0, f'ros2cc-extract: {what}\n')
    assert len(list(yaml.safe_load_all(outcome.out))) == 2
