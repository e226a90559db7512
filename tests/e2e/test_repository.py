"""The guards of a git repository: pre-commit hooks, the GitHub action, the ROS entry points."""

from __future__ import annotations

import argparse
import ast
import os
import shutil
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest
import yaml

from ros2cc_extract.packages.manifest import read_package
from ros2cc_extract.ros.doctor import CallbackCheck, Counts, checked_folder
from tests.e2e.conftest import ROOT, Run
from tests.support.packages import DEADLOCK, MENDED, make_package
from tests.support.repositories import BIN, commit, environment, git, make_repository

NODE = 'arm/node.py'
HARMLESS = 'def add(a, b):\n    return a + b\n'
HOOKS = ROOT / '.pre-commit-hooks.yaml'
TIMEOUT = 900
WITHOUT_COMPILER = {'CC': 'false', 'CXX': 'false'}
"""Installs in seconds; the checker then is pure Python."""


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A repository with one ROS 2 package, whose node is no node yet."""
    monkeypatch.setenv('XDG_CACHE_HOME', str(tmp_path / '.cache'))
    folder = tmp_path / 'repository'
    make_repository(folder)
    make_package(folder, 'arm', HARMLESS)
    done = commit(folder, 'start')
    assert done.returncode == 0, done.stdout
    return folder


def pre_commit(folder: Path, *arguments: str, **more: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, '-m', 'pre_commit', *arguments],
        cwd=folder,
        env=environment(**more),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=TIMEOUT,
        check=False,
    )


def test_a_dead_lock_is_not_committed(run: Run, repository: Path, tmp_path: Path) -> None:
    home = str(tmp_path / 'pre-commit')
    assert run('init', '--pre-commit', cwd=repository).status == 0
    installed = pre_commit(repository, 'install', PRE_COMMIT_HOME=home)
    assert installed.returncode == 0, installed.stdout
    (repository / NODE).write_text(DEADLOCK)
    refused = commit(repository, 'plant a deadlock', PRE_COMMIT_HOME=home)
    assert refused.returncode == 1
    assert f'{NODE}:44:9: error CC101' in refused.stdout
    (repository / NODE).write_text(MENDED)
    passed = commit(repository, 'mend it', PRE_COMMIT_HOME=home)
    assert passed.returncode == 0, passed.stdout
    assert git(repository, 'log', '--format=%s').stdout == 'mend it\nstart\n'


def test_a_dead_lock_is_not_pushed(run: Run, repository: Path, tmp_path: Path) -> None:
    home = str(tmp_path / 'pre-commit')
    git(tmp_path, 'init', '--quiet', '--bare', 'server.git')
    git(repository, 'remote', 'add', 'origin', '../server.git')
    run('init', '--pre-commit', cwd=repository)
    pre_commit(repository, 'install', PRE_COMMIT_HOME=home)
    (repository / NODE).write_text(DEADLOCK)
    git(repository, 'add', '--all')
    assert git(repository, 'commit', '--no-verify', '--message', 'hasty').returncode == 0
    refused = git(repository, 'push', '--quiet', 'origin', 'main', PRE_COMMIT_HOME=home)
    assert refused.returncode == 1
    assert f'{NODE}:44:9: error CC101' in refused.stdout
    (repository / NODE).write_text(MENDED)
    commit(repository, 'mend it')
    assert (
        git(repository, 'push', '--quiet', 'origin', 'main', PRE_COMMIT_HOME=home).returncode == 0
    )


def test_published_hooks_are_a_valid_manifest(tmp_path: Path) -> None:
    done = pre_commit(tmp_path, 'validate-manifest', str(HOOKS))
    assert done.returncode == 0, done.stdout


def test_written_hooks_differ_from_the_published_ones_only_in_their_language() -> None:
    (local,) = yaml.safe_load(
        (ROOT / 'ros2cc_extract/packages/snippets/pre-commit-config.yaml').read_text()
    )['repos']
    published = [{**hook, 'language': 'system'} for hook in yaml.safe_load(HOOKS.read_text())]
    for hook in published:
        del hook['description']
    assert local['hooks'] == published


@pytest.fixture
def release(tmp_path: Path) -> Path:
    """A repository with the files of this checkout, as a release would have them."""
    tool = tmp_path / 'tool'
    listed = subprocess.run(
        ['git', 'ls-files', '-z', '--cached', '--others', '--exclude-standard'],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    make_repository(tool)
    for name in filter(None, listed.stdout.split('\0')):
        if (ROOT / name).is_file():
            (tool / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / name, tool / name)
    assert commit(tool, 'release').returncode == 0
    return tool


@pytest.mark.slow
def test_published_hooks_install_themselves(
    repository: Path, release: Path, tmp_path: Path
) -> None:
    """As another repository names them."""
    revision = git(release, 'rev-parse', 'HEAD').stdout.strip()
    hooks = [{'id': 'ros2cc'}, {'id': 'ros2cc-all'}]
    config = {'repos': [{'repo': str(release), 'rev': revision, 'hooks': hooks}]}
    (repository / '.pre-commit-config.yaml').write_text(yaml.safe_dump(config))
    settings = {'PRE_COMMIT_HOME': str(tmp_path / 'pre-commit'), **WITHOUT_COMPILER}
    pre_commit(repository, 'install', **settings)
    (repository / NODE).write_text(DEADLOCK)
    refused = commit(repository, 'plant a deadlock', **settings)
    assert refused.returncode == 1
    assert f'{NODE}:44:9: error CC101' in refused.stdout
    (repository / NODE).write_text(MENDED)
    passed = commit(repository, 'mend it', **settings)
    assert passed.returncode == 0, passed.stdout


ACTION = yaml.safe_load((ROOT / 'action.yml').read_text())


def check_step(
    folder: Path, tmp_path: Path, tools: Path = BIN, **inputs: str
) -> tuple[subprocess.CompletedProcess[str], Path]:
    """Run the checking step of the action as the runner does: its script under bash."""
    (step,) = (each for each in ACTION['runs']['steps'] if each['id'] == 'check')
    given = {**{name: each['default'] for name, each in ACTION['inputs'].items()}, **inputs}
    expressions = {f'${{{{ inputs.{name} }}}}': value for name, value in given.items()}
    output = tmp_path / 'output'
    variables = {name: expressions[text] for name, text in step['env'].items()}
    done = subprocess.run(
        ['bash', '--noprofile', '--norc', '-e', '-o', 'pipefail', '-c', step['run']],
        cwd=folder,
        env=environment(
            **variables,
            PATH=f'{tools}{os.pathsep}{os.environ["PATH"]}',
            GITHUB_OUTPUT=str(output),
            GITHUB_STEP_SUMMARY=str(tmp_path / 'summary.md'),
        ),
        capture_output=True,
        text=True,
        check=False,
    )
    return done, output


def test_action_annotates_the_line_that_hangs(repository: Path, tmp_path: Path) -> None:
    (repository / NODE).write_text(DEADLOCK)
    done, output = check_step(repository, tmp_path)
    assert done.returncode == 1
    assert done.stdout.startswith(
        f'::error file={NODE},line=44,col=9,title=CC101::Navigator.drive waits'
    )
    assert output.read_text() == 'status=1\n'
    assert '| CC101 | `arm/node.py:44` |' in (tmp_path / 'summary.md').read_text()


def test_action_passes_a_clean_repository(repository: Path, tmp_path: Path) -> None:
    done, output = check_step(repository, tmp_path)
    assert (done.returncode, output.read_text()) == (0, 'status=0\n'), done.stderr


def test_action_blames_a_change_only_for_what_it_adds(repository: Path, tmp_path: Path) -> None:
    (repository / NODE).write_text(DEADLOCK)
    commit(repository, 'plant a deadlock')
    (repository / NODE).write_text('# moved\n' + DEADLOCK)
    inputs = {'diff-base': 'HEAD', 'sarif-file': str(tmp_path / 'all.sarif')}
    done, output = check_step(repository, tmp_path, **inputs)
    assert (done.returncode, output.read_text()) == (0, 'status=0\n'), done.stderr
    assert '"ruleId": "CC101"' in (tmp_path / 'all.sarif').read_text()


def test_action_hands_an_undecided_verdict_on(repository: Path, tmp_path: Path) -> None:
    tool = tmp_path / 'bin' / 'ros2cc-extract'
    tool.parent.mkdir()
    tool.write_text('#!/bin/sh\nexit 3\n')
    tool.chmod(0o755)
    inputs = {'sarif-file': str(tmp_path / 'a.sarif')}
    done, output = check_step(repository, tmp_path, tools=tool.parent, **inputs)
    assert (done.returncode, output.read_text()) == (3, 'status=3\n'), done.stderr


@pytest.fixture
def shallow(repository: Path, tmp_path: Path) -> Path:
    """As actions/checkout leaves it: one commit of a branch, on a main with a deadlock."""
    (repository / NODE).write_text(DEADLOCK)
    commit(repository, 'plant a deadlock')
    git(repository, 'switch', '--quiet', '--create', 'feature')
    (repository / 'README.md').write_text('An arm.')
    commit(repository, 'say what it is')
    clone = tmp_path / 'shallow'
    depth = ('--depth', '1', '--single-branch', '--branch', 'feature')
    done = git(tmp_path, 'clone', '--quiet', *depth, f'file://{repository}', str(clone))
    assert done.returncode == 0, done.stdout
    return clone


def test_action_fetches_the_base_that_a_shallow_clone_has_not(
    shallow: Path, tmp_path: Path
) -> None:
    done, output = check_step(shallow, tmp_path, **{'diff-base': 'origin/main'})
    assert (done.returncode, output.read_text()) == (0, 'status=0\n'), done.stderr
    (shallow / 'arm' / 'other.py').write_text(DEADLOCK)
    done, _ = check_step(shallow, tmp_path, **{'diff-base': 'origin/main'})
    errors = [line for line in done.stdout.splitlines() if line.startswith('::error')]
    assert [line.split(',')[0] for line in errors] == ['::error file=arm/other.py']


def test_action_tells_how_to_get_a_base_that_it_cannot_fetch(
    shallow: Path, tmp_path: Path
) -> None:
    inputs = {'diff-base': 'origin/gone', 'sarif-file': str(tmp_path / 'a.sarif')}
    done, output = check_step(shallow, tmp_path, **inputs)
    assert (done.returncode, output.read_text()) == (2, 'status=2\n')
    assert done.stderr.splitlines()[-1] == (
        "ros2cc-extract: error: this shallow clone has no revision 'origin/gone'; fetch it: "
        'git fetch --depth=1 origin BRANCH, or actions/checkout with fetch-depth: 0'
    )


def test_action_judges_a_push_without_a_base(shallow: Path, tmp_path: Path) -> None:
    done, output = check_step(shallow, tmp_path, **{'diff-base': 'origin/'})
    assert (done.returncode, output.read_text()) == (1, 'status=1\n'), done.stderr


def test_action_takes_paths_of_several_lines(repository: Path, tmp_path: Path) -> None:
    for name in ('one.py', 'two.py'):
        (repository / 'arm' / name).write_text(DEADLOCK)
    done, _ = check_step(repository, tmp_path, paths='arm/one.py\narm/two.py\n')
    errors = [line for line in done.stdout.splitlines() if line.startswith('::error')]
    assert [line.split(',')[0] for line in errors] == [
        '::error file=arm/one.py',
        '::error file=arm/two.py',
    ]


def test_action_reads_windows_line_ends(repository: Path, tmp_path: Path) -> None:
    (repository / NODE).write_bytes(DEADLOCK.replace('\n', '\r\n').encode())
    done, _ = check_step(repository, tmp_path)
    assert done.stdout.startswith(
        f'::error file={NODE},line=44,col=9,title=CC101::Navigator.drive waits'
    )
    assert '\r' not in done.stdout


@pytest.mark.slow
def test_action_installs_its_own_checkout(release: Path, tmp_path: Path) -> None:
    (step,) = (each for each in ACTION['runs']['steps'] if each['id'] == 'install')
    path = tmp_path / 'path'
    subprocess.run(
        ['bash', '-e', '-c', step['run']],
        env=environment(
            **WITHOUT_COMPILER,
            ROS2CC_INSTALL='',
            GITHUB_ACTION_PATH=str(release),
            GITHUB_PATH=str(path),
            RUNNER_TEMP=str(tmp_path),
        ),
        check=True,
    )
    done = subprocess.run(
        ['ros2cc-extract', '--version'],
        env={'PATH': path.read_text().strip()},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.startswith('ros2cc-extract ')


def test_gitlab_job_keeps_its_report_when_it_fails(
    run: Run, repository: Path, tmp_path: Path
) -> None:
    run('init', '--gitlab', '--install', 'wheels/ours.whl', cwd=repository)
    (repository / NODE).write_text(DEADLOCK)
    job = yaml.safe_load((repository / '.gitlab' / 'ros2cc.yml').read_text())['ros2cc']
    done = subprocess.run(
        ['bash', '-e', '-c', job['script'][-1]],
        cwd=repository,
        env=environment(),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    report = repository / job['artifacts']['reports']['junit']
    assert f'name="CC101 ({NODE}:44:9)"' in report.read_text()


def entry(group: str, name: str) -> object:
    (found,) = metadata.entry_points(group=group, name=name)
    return found.load()


def test_ros2_command_takes_everything_as_it_is(
    repository: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(repository)
    (repository / NODE).write_text(DEADLOCK)
    command = entry('ros2cli.command', 'cc')()  # type: ignore[operator]
    parser = argparse.ArgumentParser()
    below = parser.add_subparsers().add_parser('cc')
    command.add_arguments(below, 'ros2 cc', argv=None)
    for given, status, told in (
        ([NODE], 1, 'CC101'),
        (['--output-format', 'junit', NODE], 1, '<testsuite name="repository.ros2cc"'),
        (['spec', NODE], 0, 'callback_groups:'),
        (['--help'], 0, 'usage: ros2cc-extract PATH'),
        ([], 0, 'usage: ros2cc-extract PATH'),
    ):
        args = parser.parse_args(['cc', *given])
        assert command.main(parser=parser, args=args) == status
        assert told in capsys.readouterr().out


def test_ros2_entry_points_load_without_ros() -> None:
    """In a process that cannot import any of it."""
    done = subprocess.run(
        [sys.executable, '-c', WITHOUT_ROS], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout) == (0, 'CallbackCheck CcCommand\n'), done.stderr


WITHOUT_ROS = """
import sys
for name in ('rclpy', 'ros2cli', 'ros2doctor'):
    sys.modules[name] = None
from importlib.metadata import entry_points
print(*sorted(
    point.load().__name__
    for group in ('ros2cli.command', 'ros2doctor.checks')
    for point in entry_points(group=group)
    if point.value.startswith('ros2cc_extract')
))
"""


@pytest.fixture
def doctor(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[str]:
    """What stands in for ``ros2doctor.api.format``; collects its warnings."""
    said: list[str] = []
    package = tmp_path / 'fake' / 'ros2doctor' / 'api'
    package.mkdir(parents=True)
    (package / 'format.py').write_text('said = []\ndoctor_warn = said.append\n')
    monkeypatch.syspath_prepend(str(tmp_path / 'fake'))
    import ros2doctor.api.format as stand_in

    monkeypatch.setattr(stand_in, 'doctor_warn', said.append)
    return said


def test_doctor_tells_what_hangs_in_the_package_one_stands_in(
    repository: Path, monkeypatch: pytest.MonkeyPatch, doctor: list[str]
) -> None:
    (repository / NODE).write_text(DEADLOCK)
    monkeypatch.chdir(repository)
    check = entry('ros2doctor.checks', 'CallbackCheck')()  # type: ignore[operator]
    assert (check.category(), check.check()) == ('callbacks', Counts(error=1))
    assert [text.partition(' Navigator.drive')[0] for text in doctor] == [f'{NODE}:44:9: CC101']


def test_doctor_has_no_opinion_elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert CallbackCheck().check() == Counts()


def test_doctor_looks_at_the_sources_of_a_workspace(tmp_path: Path) -> None:
    make_package(tmp_path / 'src' / 'arm_pkg', 'arm', HARMLESS)
    assert checked_folder(tmp_path) == tmp_path / 'src'


def test_the_tool_is_a_ros_package_itself() -> None:
    package = read_package(ROOT)
    assert (package.name, package.build_type) == ('ros2cc_extract', 'ament_python')
    assert (ROOT / 'resource' / package.name).is_file()
    assert {'python3-yaml', 'python3-jinja2', 'python3-rich'} <= package.dependencies


def test_colcon_can_read_the_package() -> None:
    """It evaluates the text of these values (colcon-python-setup-py, ``python_setup_py.py``)."""
    done = subprocess.run(
        [sys.executable, '-c', AS_COLCON_READS],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    read = ast.literal_eval(done.stdout.splitlines()[-1])
    assert read['python_requires'] == '>=3.10'
    scripts = read['entry_points']['console_scripts']
    assert 'ament_ros2cc = ros2cc_extract.ros.ament:entry_point' in scripts


AS_COLCON_READS = """
import setuptools
from distutils.core import run_setup
found = run_setup('setup.py', script_args=('--quiet',), stop_after='config')
print({name: getattr(found, name) for name in ('python_requires', 'entry_points', 'data_files')})
"""


def test_the_linter_is_installed_beside_the_tests() -> None:
    assert os.access(BIN / 'ament_ros2cc', os.X_OK)
