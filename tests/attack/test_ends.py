"""However it ends: one line, the right status, no traceback, and no child that goes on."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml

from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.extract.static.scan import scanning
from ros2cc_extract.jobs.process_pool import ProcessPool
from tests.attack.running import Ended, assert_orderly, run_tool
from tests.support.packages import DEADLOCK, MENDED
from tests.support.products import every_pair
from tests.support.repositories import environment
from tests.support.starting import PATIENCE_S, TOOL

CLASS = 'environments and ends'

FOREIGN = DEADLOCK.replace("'map_ready'", "'karte_überall_→'")
EXAMPLES = Path(__file__).parents[2] / 'launch_free_examples'
UNPRIVILEGED = '+dac_read_search'
NOBODY = (
    *('setpriv', '--reuid=1234', '--regid=1234', '--clear-groups'),
    *(f'--{each}=-all,{UNPRIVILEGED}' for each in ('inh-caps', 'ambient-caps', 'bounding-set')),
)
"""A user that has no name, no home and no right to write, as of ``docker run -u 1234``."""
as_root = pytest.mark.skipif(
    os.geteuid() != 0 or shutil.which('setpriv') is None, reason='only root can act as another'
)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    made = tmp_path / 'package'
    made.mkdir()
    (made / 'node.py').write_text(DEADLOCK)
    (made / 'clean.py').write_text('PASS = 1\n')
    return made


def shell(redirection: str) -> tuple[str, ...]:
    return 'bash', '-c', f'exec "$@" {redirection}', 'shell'


COMMANDS = {
    '--help': 0,
    '--version': 0,
    'explain CC101': 0,
    'check node.py': 1,
    'node.py --output-format json': 1,
    'spec node.py': 0,
    'spec node.py -o out.yaml': 0,
    'model node.py -o model': 0,
    'verify node.py': 0,
    'diff node.py clean.py': 2,
    'check --nonsense': 2,
}
SILENT = ('spec node.py -o out.yaml', 'diff node.py clean.py', 'check --nonsense')
"""They have nothing to say on stdout."""


@pytest.mark.parametrize(
    ('command', 'redirection'), every_pair(COMMANDS, ['>&-', '>/dev/full', '<&- >&- 2>&-'])
)
def test_a_result_that_cannot_be_written_is_an_error(
    command: str, redirection: str, folder: Path
) -> None:
    ended = run_tool(*command.split(), cwd=folder, prefix=shell(redirection))
    assert_orderly(ended)
    assert ended.status == (COMMANDS[command] if command in SILENT else 2)
    if command not in SILENT and '2>&-' not in redirection:
        assert ended.err.splitlines()[-1].startswith(
            'ros2cc-extract: error: <stdout>: cannot be written: '
        )


@pytest.mark.parametrize(
    ('command', 'redirection'), every_pair(COMMANDS, ['2>&-', '2>/dev/full', '<&-'])
)
def test_a_result_is_written_though_nobody_listens(
    command: str, redirection: str, folder: Path
) -> None:
    ended = run_tool(*command.split(), cwd=folder, prefix=shell(redirection))
    assert_orderly(ended)
    assert ended.status == COMMANDS[command]


@pytest.mark.parametrize(
    'command', ['check node.py', 'spec node.py', 'verify node.py', 'init', 'diff a b', 'a.xml']
)
def test_a_folder_that_is_gone_is_told(command: str, folder: Path) -> None:
    gone = ('bash', '-c', 'rm -r "$PWD"; exec "$@"', 'shell')
    ended = run_tool(*command.split(), cwd=folder, prefix=gone)
    assert_orderly(ended)
    assert (ended.status, len(ended.err.splitlines())) == (2, 1), ended.err


@as_root
@pytest.mark.parametrize('command', ['check node.py', 'spec node.py', 'verify node.py'])
def test_a_user_without_name_home_and_rights(command: str, folder: Path) -> None:
    (folder.parent).chmod(0o755)
    usual = run_tool(*command.split(), cwd=folder)
    ended = run_tool(
        *command.split(), cwd=folder, prefix=(*NOBODY, 'env', '-u', 'HOME', '-u', 'XDG_CACHE_HOME')
    )
    assert_orderly(ended)
    assert ended.status == usual.status
    if 'verify' not in command:  # which prints times
        assert ended.out == usual.out


@pytest.mark.parametrize(
    ('form', 'encoding'),
    every_pair(['json', 'sarif', 'html', 'junit', 'mermaid'], ['ascii', 'latin-1']),
)
def test_what_programs_read_is_the_same_in_every_locale(
    encoding: str, form: str, folder: Path
) -> None:
    (folder / 'node.py').write_text(FOREIGN, 'utf-8')
    arguments = ('node.py', '--output-format', form)
    usual = run_tool(*arguments, cwd=folder, PYTHONUTF8='1')
    ended = run_tool(*arguments, cwd=folder, PYTHONIOENCODING=encoding, LC_ALL='C')
    assert_orderly(ended)
    assert (ended.status, ended.out) == (usual.status, usual.out)


@pytest.mark.parametrize('encoding', ['ascii', 'latin-1'])
@pytest.mark.parametrize('command', ['check node.py', 'verify node.py', 'explain CC101'])
def test_text_is_told_in_every_locale(command: str, encoding: str, folder: Path) -> None:
    (folder / 'node.py').write_text(FOREIGN, 'utf-8')
    ended = run_tool(*command.split(), cwd=folder, PYTHONIOENCODING=encoding, LC_ALL='C')
    assert_orderly(ended)
    assert ended.status == COMMANDS[command]


def test_a_narrow_and_dumb_terminal(folder: Path) -> None:
    for command in ('check node.py', 'verify node.py', 'explain CC101'):
        ended = run_tool(*command.split(), cwd=folder, TERM='dumb', COLUMNS='40')
        assert_orderly(ended)
        assert (ended.status, '\x1b' in ended.out) == (COMMANDS[command], False)


@pytest.mark.parametrize('form', ['text', 'json', 'sarif', 'junit', 'github', 'html', 'mermaid'])
def test_a_name_that_is_no_utf_8_ends_nothing(form: str, folder: Path) -> None:
    Path(os.fsdecode(bytes(folder) + b'/strange\xff.py')).write_text(DEADLOCK)
    (folder / 'node.py').write_text(MENDED)
    ended = run_tool('.', '--output-format', form, cwd=folder)
    assert_orderly(ended)
    assert ended.status == 1
    if form in ('json', 'sarif'):
        json.loads(ended.out)
    elif form == 'junit':
        ElementTree.fromstring(ended.out)
    elif form == 'text':
        assert 'strange\\xff.py:44:9: error CC101' in ended.out


def test_a_specification_of_such_a_file_can_be_read_again(folder: Path) -> None:
    name = os.fsdecode(b'strange\xff.py')
    (folder / name).write_text(DEADLOCK)
    assert run_tool('spec', name, '-o', 'spec.yaml', cwd=folder).status == 0
    assert yaml.safe_load((folder / 'spec.yaml').read_text())
    assert run_tool('verify', 'spec.yaml', cwd=folder).status == 0
    (folder / name).write_bytes(b'\xff\xff\xff')
    assert run_tool(name, cwd=folder).status == 2  # of what is named nothing could be read


@pytest.mark.parametrize(
    'text',
    [
        '# coding: undefined\nimport rclpy\n',
        '# coding: rot13\nimport rclpy\n',
        '# coding: idna\nimport rclpy\n',
        '# coding: \0\nimport rclpy\n',
        DEADLOCK.replace('map_ready', '\\ud800'),
        DEADLOCK.replace('map_ready', '\\x00\\x1b[2J'),
        'import rclpy\nclass \N{MATHEMATICAL BOLD SMALL X}:\n    pass\n',
    ],
    ids=range(7),
)
def test_odd_sources(text: str, folder: Path) -> None:
    (folder / 'odd.py').write_text(text)
    for arguments in (
        ('odd.py',),
        ('.', '--output-format', 'json'),
        ('.', '--output-format', 'junit'),
        ('odd.py', '-o', 'out'),
        ('spec', 'odd.py', '-o', 'out.yaml'),
    ):
        assert_orderly(run_tool(*arguments, cwd=folder))


@pytest.mark.parametrize(
    'text',
    [
        'tool = 3',
        'tool = []',
        '[tool]\nros2cc = 3',
        '[tool.ros2cc]\ntimeout = inf',
        '[tool.ros2cc]\ntimeout = nan',
        '[tool.ros2cc]\ntimeout = true',
        f'[tool.ros2cc]\ntimeout = 1{"0" * 400}',
        f'[tool.ros2cc]\ntimeout = 1{"0" * 5000}',
        '[tool.ros2cc]\ntimeout = 99999-99-99',
        '[tool.ros2cc]\nbaseline = "a\\u0000b"',
        '[tool.ros2cc]\nbaseline = ""',
        '[tool.ros2cc]\nper_path = {"[" = ["CC1"]}',
        '[tool.ros2cc]\nper_path = {"" = [""]}',
        '[tool.ros2cc]\nignore = [["CC1"]]',
        '[tool.ros2cc]\nassume = ["threads=1e9"]',
        '[tool.ros2cc]\nnever_together = [[]]',
        '[tool.ros2cc]\nnever_together = {a = 1}',
        '[tool.ros2cc]\n"\\ud800" = 1',
        '[[tool.ros2cc]]\nx = 1',
        f'x = {"[" * 5000}',
        '\ufeff[tool.ros2cc]\n',
        '\0',
    ],
    ids=range(22),
)
def test_odd_settings(text: str, folder: Path) -> None:
    (folder / 'pyproject.toml').write_text(text)
    ended = run_tool('clean.py', cwd=folder)
    assert_orderly(ended)
    assert ended.status in (0, 2)
    assert len(ended.err.splitlines()) == 1  # what is wrong, or that nothing to check


@pytest.fixture
def repository(folder: Path) -> Path:
    """So much that it is shared between processes."""
    for example in EXAMPLES.glob('*/node.py'):
        shutil.copy(example, folder / f'{example.parent.name}.py')
    return folder


LIMITS = {
    'memory': ('prlimit', '--as=300000000'),
    'descriptors': ('prlimit', '--nofile=12'),
    'processes': (*NOBODY, 'prlimit', '--nproc=1'),
}


@as_root
@pytest.mark.parametrize('limit', LIMITS)
def test_little_of_everything(limit: str, repository: Path) -> None:
    repository.parent.chmod(0o755)
    limited = run_tool('.', '--no-cache', cwd=repository, prefix=LIMITS[limit])
    assert_orderly(limited)
    if limit != 'memory':  # with little of it, less may be found out, and that is reported
        usual = run_tool('.', '--no-cache', cwd=repository)
        assert (limited.status, limited.out) == (usual.status, usual.out)


@contextmanager
def working(folder: Path) -> Iterator[tuple[subprocess.Popen[bytes], list[int]]]:
    """A check that has begun to share its work: its process and those of its children."""
    process = subprocess.Popen(
        [*TOOL, '.', '--no-cache'],
        cwd=folder,
        env=environment(XDG_CACHE_HOME=f'{folder}.cache'),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )
    try:
        listing = Path(f'/proc/{process.pid}/task/{process.pid}/children')
        children: list[int] = []
        while process.poll() is None and not children:
            children = [int(number) for number in listing.read_text().split()]
        yield process, children
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def is_gone(pid: int) -> bool:
    try:
        return Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()[0] == 'Z'
    except OSError:
        return True


def all_end(pids: list[int]) -> bool:
    ends_at = time.monotonic() + PATIENCE_S
    while not all(map(is_gone, pids)) and time.monotonic() < ends_at:
        time.sleep(0.05)
    return all(map(is_gone, pids))


needs_cores = pytest.mark.skipif(
    len(os.sched_getaffinity(0)) < 2, reason='on one core nothing is shared'
)


@needs_cores
@pytest.mark.parametrize(
    ('number', 'whom'),
    every_pair(
        [signal.SIGTERM, signal.SIGHUP, signal.SIGINT, signal.SIGKILL], ['parent', 'group']
    ),
)
def test_a_signal_leaves_no_child(number: signal.Signals, whom: str, repository: Path) -> None:
    with working(repository) as (process, children):
        assert children
        (os.kill if whom == 'parent' else os.killpg)(process.pid, number)
        out, err = process.communicate(timeout=PATIENCE_S)
        assert all_end(children)
    status = 128 + number if process.returncode > 0 else -number
    assert process.returncode == status
    assert b'Traceback' not in out + err, err


ASKED_TO_END = """
import os, signal
from ros2cc_extract.cli import main
from ros2cc_extract.cli.commands import diff
def run(*_):
    HEARD
diff.run = run
main.entry_point()
"""
HEARD = 'os.kill(os.getpid(), signal.NUMBER)'


@pytest.mark.parametrize('number', [signal.SIGTERM, signal.SIGHUP, signal.SIGINT])
@pytest.mark.parametrize(
    'where',
    [HEARD, f'exec("{HEARD}")'],
    ids=['in our code', 'where a class is made'],  # as dataclasses does
)
def test_a_signal_ends_a_module_by_its_status(
    number: signal.Signals, where: str, folder: Path
) -> None:
    heard = where.replace('NUMBER', number.name)
    (folder / 'ended.py').write_text(ASKED_TO_END.replace('HEARD', heard))
    command = [sys.executable, '-m', 'ended', 'diff', 'node.py', 'clean.py']
    done = subprocess.run(
        command,
        cwd=folder,
        env=environment(),
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        preexec_fn=hears_all,
    )
    assert (done.returncode, done.stdout) == (128 + number, '')
    assert done.stderr == 'ros2cc-extract: interrupted\n'


def hears_all() -> None:
    """What a shell runs in the background does not hear SIGINT."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.mark.parametrize('program', ['git', 'verifyta'])
def test_a_program_that_was_called_ends_with_us(program: str, folder: Path) -> None:
    """One that never ends by itself."""
    (folder / 'bin').mkdir()
    fake = folder / 'bin' / program
    fake.write_text(
        f'#!/bin/sh\necho $$ > {folder}/started\nmv {folder}/started {folder}/pid\n'
        'exec sleep 1000\n'
    )
    fake.chmod(0o755)
    arguments = {
        'git': ('node.py', '--diff-base', 'HEAD'),
        'verifyta': ('verify', 'node.py', '--checker', 'verifyta', '--verifyta', str(fake)),
    }
    process = subprocess.Popen(
        [*TOOL, *arguments[program]],
        cwd=folder,
        env=environment(PATH=f'{folder / "bin"}:{os.environ["PATH"]}'),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    while process.poll() is None and not (folder / 'pid').exists():
        time.sleep(0.01)
    pid = int((folder / 'pid').read_text())
    process.kill()
    process.wait()
    assert all_end([pid])


@needs_cores
def test_a_child_that_is_killed_changes_nothing(repository: Path) -> None:
    with working(repository) as (process, children):
        os.kill(children[0], signal.SIGKILL)
        out, err = process.communicate(timeout=PATIENCE_S)
        assert all_end(children)
    ended = Ended(process.returncode, out.decode(), err.decode())
    assert_orderly(ended)
    assert ended.out == run_tool('.', '--no-cache', cwd=repository).out


@pytest.mark.parametrize('left', [0, 1, 2])
def test_work_that_cannot_be_shared_is_done_here(
    left: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    import multiprocessing.context

    start = multiprocessing.context.ForkProcess.start
    begun = []

    def refuse(process: multiprocessing.context.ForkProcess) -> None:
        if len(begun) >= left:
            raise BlockingIOError(11, 'Resource temporarily unavailable')
        begun.append(process.name)
        start(process)

    monkeypatch.setattr(multiprocessing.context.ForkProcess, 'start', refuse)
    before = len(list(Path('/proc/self/fd').iterdir()))
    with ProcessPool(lambda number: number * 2, 3) as pool:
        assert [answer for answer, _ in pool.ask(range(10))] == list(range(0, 20, 2))
        assert pool.size == max(left, 1)
    assert len(list(Path('/proc/self/fd').iterdir())) == before


@pytest.mark.parametrize(
    ('error', 'told'),
    [
        (KeyError('lost'), "cannot be followed: KeyError: 'lost'"),
        (RecursionError(), 'nested too deeply to be followed'),
        (MemoryError(), 'there is not enough memory to follow it'),
    ],
)
def test_a_defect_names_its_file_and_the_others_are_judged(
    error: Exception, told: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run_entry = scanning.run_entry

    def fail(project: scanning.Project, entry: object) -> object:
        if entry.source.shown.endswith('node.py'):  # type: ignore[attr-defined]
            raise error
        return run_entry(project, entry)  # type: ignore[arg-type]

    monkeypatch.setattr(scanning, 'run_entry', fail)
    (folder / 'other.py').write_text(MENDED)
    found = scan([folder])
    (diagnostic,) = found.diagnostics
    assert (diagnostic.place.file.endswith('node.py'), diagnostic.message) == (True, told)
    assert any(unit.entry and 'other.py' in unit.entry for unit in found.units)


def test_python_m_works_in_a_hostile_folder(folder: Path) -> None:
    """But for what Python itself imports before it runs a module."""
    listed = 'import runpy, sys; print(*{name.partition(".")[0] for name in sys.modules})'
    own = subprocess.run(
        [sys.executable, '-c', listed], capture_output=True, text=True, check=True
    ).stdout.split()
    names = {*sys.stdlib_module_names, 'yaml', 'jinja2', 'lark', 'rich', 'tomli'} - {*own}
    canary = folder.parent / 'canary'
    for name in names:
        (folder / f'{name}.py').write_text(f'open({str(canary)!r}, "a").write("{name} ")\n')
    for command in ('--version', 'check node.py', 'spec node.py', 'verify node.py'):
        done = subprocess.run(
            [sys.executable, '-m', 'ros2cc_extract', *command.split()],
            cwd=folder,
            env=environment(XDG_CACHE_HOME=f'{folder}.cache'),
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == COMMANDS[command], done.stderr
        assert not canary.exists(), canary.read_text()
