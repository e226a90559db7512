"""``run`` starts a command as if we were not there, and writes what its processes held."""

from __future__ import annotations

import io
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest
from child import Child
from conftest import EXAMPLES, ROOT
from recorded import PROGRAMS

from ros2cc_extract.cli.main import main
from ros2cc_extract.errors import InputError, ToolNotFoundError
from ros2cc_extract.extract.live.environment import hooked_environment, shell_commands
from ros2cc_extract.extract.live.run import collect_directory, run_command
from ros2cc_extract.spec.yaml.yaml_io import load_specs

OURSELVES = (
    'import sys; from pathlib import Path; from ros2cc_extract.extract.live.run import '
    'run_command; sys.exit(run_command(sys.argv[2:], Path(sys.argv[1]), sys.stderr))'
)


@pytest.fixture
def start_run(ros_env: dict[str, str], tmp_path: Path) -> Callable[..., Child]:
    """Start ``run -o tmp_path/live.yaml -- …`` in a process of its own."""

    def start(*command: str) -> Child:
        output = str(tmp_path / 'live.yaml')
        env = {**ros_env, 'PYTHONPATH': str(ROOT)}
        return Child([sys.executable, '-c', OURSELVES, output, *command], env)

    return start


def run_here(command: Sequence[str], output: Path, env: dict[str, str]) -> tuple[int, str]:
    stderr = io.StringIO()
    return run_command(command, output, stderr, environment=env), stderr.getvalue()


def test_exit_status_passes_through(start_run: Callable[..., Child]) -> None:
    assert start_run('sh', '-c', 'exit 7').end() == 7


def test_end_by_a_signal_passes_through(start_run: Callable[..., Child]) -> None:
    assert start_run('sh', '-c', 'kill -USR1 $$').end() == -signal.SIGUSR1


def test_end_by_kill_passes_through(start_run: Callable[..., Child]) -> None:
    child = start_run('sh', '-c', 'kill -KILL $$')
    assert (child.end(), 'Error' in child.text) == (-signal.SIGKILL, False)


def test_signals_that_come_while_the_command_ends_do_not_end_us(
    start_run: Callable[..., Child],
) -> None:
    ending = 'kill -STOP $PPID; kill -INT $PPID; kill -TERM $PPID; (sleep 1; kill -CONT $PPID) &'
    assert start_run('sh', '-c', ending).end() == 0


@pytest.mark.parametrize('name', ['INT', 'TERM', 'HUP', 'USR1'])
def test_signal_sent_to_us_reaches_the_command(name: str, start_run: Callable[..., Child]) -> None:
    waits = f'trap "echo got {name}; exit 5" {name}; echo up; while :; do sleep 0.05; done'
    child = start_run('sh', '-c', waits)
    child.read_until(lambda lines: 'up\n' in lines)
    assert child.end(signal.Signals[f'SIG{name}']) == 5
    assert child.lines[1] == f'got {name}\n'


def test_standard_streams_pass_through(ros_env: dict[str, str], tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, '-c', OURSELVES, str(tmp_path / 'out'), 'sh', '-c', 'cat; echo e >&2'],
        input='through',
        capture_output=True,
        text=True,
        check=False,
        env={**ros_env, 'PYTHONPATH': str(ROOT)},
    )
    assert (done.stdout, done.stderr.splitlines()[0]) == ('through', 'e')


def test_command_that_is_not_there_is_told(ros_env: dict[str, str], tmp_path: Path) -> None:
    with pytest.raises(ToolNotFoundError, match="'no-such-command' cannot be started"):
        run_here(['no-such-command'], tmp_path / 'live.yaml', ros_env)


def test_output_in_a_missing_folder_is_refused_before_the_start(
    ros_env: dict[str, str], tmp_path: Path
) -> None:
    trace = tmp_path / 'started'
    with pytest.raises(InputError, match='folder does not exist; create it first'):
        run_here(['touch', str(trace)], tmp_path / 'no' / 'live.yaml', ros_env)
    assert not trace.exists()


def test_full_disk_is_told_and_the_old_file_kept(
    ros_env: dict[str, str], tmp_path: Path, rclpy_python: str
) -> None:
    output = tmp_path / 'live.yaml'
    output.write_text('what was there')
    (tmp_path / 'live.yaml.new').symlink_to('/dev/full')
    node = str(PROGRAMS / 'own_classes.py')
    status, told = run_here([rclpy_python, node], output, ros_env)
    assert status == 2
    assert told == (
        f'ros2cc-extract: {output}: cannot be written: No space left on device; '
        'what was there before is kept\n'
    )
    assert output.read_text() == 'what was there'


def test_shell_script_with_two_nodes_gives_a_file_each(
    ros_env: dict[str, str], tmp_path: Path, rclpy_python: str
) -> None:
    script = tmp_path / 'both.sh'
    script.write_text(
        f'{rclpy_python} {PROGRAMS}/churning.py &\n'
        f'{rclpy_python} {PROGRAMS}/own_classes.py\nwait\n'
    )
    folder = tmp_path / 'specs'
    folder.mkdir()
    assert run_here(['sh', str(script)], folder, ros_env) == (0, '')
    units = [spec.name for path in folder.glob('*.spec.yaml') for spec in load_specs(path)]
    assert sorted(units) == ['careful', 'churning']


def test_command_without_a_node_is_told(ros_env: dict[str, str], tmp_path: Path) -> None:
    output = tmp_path / 'live.yaml'
    status, told = run_here(['true'], output, ros_env)
    assert (status, output.exists()) == (0, False)
    assert told.startswith('ros2cc-extract: no recorded process has put a node into')


def test_running_process_is_collected_from_its_directory(
    start: Callable[..., Child], tmp_path: Path
) -> None:
    folder = tmp_path / 'recordings'
    folder.mkdir()
    child = start(EXAMPLES / 'two_groups' / 'node.py', recorded_into=folder)
    output = tmp_path / 'live.yaml'
    child.wait_for(lambda: collect_directory(folder, output, io.StringIO()) == 0)
    assert [unit.name for unit in load_specs(output)] == ['obstacle_stop']


def test_nodes_switched_on_by_env_are_collected_by_the_command_line(
    ros_env: dict[str, str], tmp_path: Path, rclpy_python: str
) -> None:
    folder, output, trace = tmp_path / 'recordings', tmp_path / 'live.yaml', tmp_path / 'run.jsonl'
    said = io.StringIO()
    assert main(['env', '--trace', '-o', str(folder)], said, io.StringIO()) == 0
    node = f'{rclpy_python} {PROGRAMS}/own_classes.py'
    subprocess.run(['sh', '-c', f'{said.getvalue()}{node}'], env=ros_env, check=True)
    collect = ['collect', str(folder), '-o', str(output), '--trace', str(trace)]
    assert main(collect, io.StringIO(), io.StringIO()) == 0
    assert [unit.name for unit in load_specs(output)] == ['careful']
    assert '"event": "begin"' in trace.read_text()


def test_units_of_files_that_were_not_scanned_are_no_difference(
    ros_env: dict[str, str],
    tmp_path: Path,
    rclpy_python: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for name, value in ros_env.items():
        monkeypatch.setenv(name, value)
    names = ('own_classes.py', 'moving_nodes.py', 'own_classes.py')
    nodes = [f'{rclpy_python} {PROGRAMS / name}' for name in names]
    said = io.StringIO()
    checked = ['run', '-o', str(tmp_path / 'live.yaml'), '--check', str(PROGRAMS / names[0])]
    assert main([*checked, '--', 'sh', '-c', ' & '.join([*nodes, 'wait'])], said, said) == 0
    assert said.getvalue().splitlines()[-2:] == [
        'not scanned: moving_nodes of tests/live/programs/moving_nodes.py',
        'not scanned: base of tests/live/programs/moving_nodes.py',
    ]


def test_class_under_several_names_is_several_units_and_laps_are_one(
    ros_env: dict[str, str],
    tmp_path: Path,
    rclpy_python: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for name, value in ros_env.items():
        monkeypatch.setenv(name, value)
    said, program = io.StringIO(), str(PROGRAMS / 'one_class.py')
    output = tmp_path / 'live.yaml'
    checked = ['run', '-o', str(output), '--check', program, '--', rclpy_python, program]
    assert main(checked, said, said) == 0, said.getvalue()
    assert 'no difference' in said.getvalue()
    assert {unit.name for unit in load_specs(output)} == {'lap', 'left', 'right'}


def test_directory_without_recordings_is_told(tmp_path: Path) -> None:
    stderr = io.StringIO()
    assert collect_directory(tmp_path, tmp_path / 'live.yaml', stderr) == 2
    assert stderr.getvalue() == (
        f'ros2cc-extract: {tmp_path}: holds no recording of a process; start the nodes after: '
        f'eval "$(ros2cc-extract env -o {tmp_path})"\n'
    )


def test_variables_for_a_shell_are_those_of_a_run(tmp_path: Path) -> None:
    before = {'PYTHONPATH': f'first{os.pathsep}{os.pathsep}second', 'HOME': '/home/it is'}
    hooked = hooked_environment(before, tmp_path)
    script = f"{shell_commands(before, tmp_path)}printf '%s|%s' $PYTHONPATH $ROS2CC_LIVE_DIR"
    shown = subprocess.run(['sh', '-c', script], capture_output=True, text=True, check=True).stdout
    assert shown == f'{hooked["PYTHONPATH"]}|{tmp_path}'
    assert hooked['PYTHONPATH'].split(os.pathsep)[1:] == ['first', 'second']


@pytest.fixture
def _ros(ros_env: dict[str, str], monkeypatch: pytest.MonkeyPatch) -> None:
    """Let commands that are run by the command line see ROS."""
    for name, value in ros_env.items():
        monkeypatch.setenv(name, value)


@pytest.mark.usefixtures('_ros')
def test_other_programs_of_a_package_are_no_difference(tmp_path: Path, rclpy_python: str) -> None:
    package, said = tmp_path / 'package', io.StringIO()
    package.mkdir()
    for name in ('own_classes.py', 'moving_nodes.py'):
        (package / name).write_text((PROGRAMS / name).read_text())
    checked = ['run', '-o', str(tmp_path / 'live.yaml'), '--check', str(package)]
    main([*checked, '--', rclpy_python, str(package / 'own_classes.py')], said, said)
    told = said.getvalue().splitlines()
    assert sum(line.startswith('not run: ') for line in told) > 0, told
    assert not [line for line in told if line.endswith('only left')]


@pytest.mark.usefixtures('_ros')
@pytest.mark.parametrize(('command', 'expected'), [('true', 2), ('false', 1)])
def test_run_of_nothing_is_compared_with_nothing(
    command: str, expected: int, tmp_path: Path
) -> None:
    said, source = io.StringIO(), PROGRAMS / 'own_classes.py'
    checked = ['run', '-o', str(tmp_path / 'live.yaml'), '--check', str(source), '--', command]
    assert main(checked, said, said) == expected
    assert said.getvalue().splitlines()[-1] == (
        f'ros2cc-extract: {source}: nothing of it ran, so nothing is compared; see above how the '
        'command ended, or name the source of what it runs'
    )
    assert 'only left' not in said.getvalue()


@pytest.mark.parametrize('command', [['run', '--', 'true'], ['env', '-o', 'recordings']])
def test_diagnostics_without_a_watch_are_refused(
    command: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    stderr = io.StringIO()
    assert main([command[0], '--diagnostics', *command[1:]], io.StringIO(), stderr) == 2
    said = stderr.getvalue()
    assert said.splitlines()[0].endswith(
        '--diagnostics publishes what --watch finds; add --watch 5'
    )
    assert list(tmp_path.iterdir()) == []
