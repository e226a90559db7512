"""The ament linter, and the test file that ``init`` writes, in packages made by the test."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib import metadata
from pathlib import Path
from xml.etree import ElementTree

import pytest

from ros2cc_extract.ros.ament import entry_point, main, main_with_errors
from tests.e2e.conftest import EXAMPLES, Run
from tests.support.packages import DEADLOCK, MENDED, make_package

NODE = 'arm/node.py'


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package whose node deadlocks; the test stands in it."""
    monkeypatch.setenv('XDG_CACHE_HOME', str(tmp_path / '.cache'))
    make_package(tmp_path, 'arm', DEADLOCK)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_linter_fails_at_the_line_that_hangs(package: Path) -> None:
    rc, errors = main_with_errors([])
    assert rc == 1
    assert [error.partition(' Navigator.drive')[0] for error in errors] == [f'{NODE}:44:9: CC101']


def test_linter_passes_the_mended_package(package: Path) -> None:
    (package / NODE).write_text(MENDED)
    assert main_with_errors([]) == (0, [])


def test_linter_reads_its_own_arguments(
    package: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, 'argv', ['ament_ros2cc', NODE])
    assert main() == 1
    assert '1 files checked\n1 errors\n' in capsys.readouterr().out


@pytest.mark.parametrize('mark', ['AMENT_IGNORE', 'COLCON_IGNORE', 'pyvenv.cfg'])
def test_marked_folders_are_nobodys_source(package: Path, mark: str) -> None:
    (package / 'arm' / mark).touch()
    assert main([]) == 0


@pytest.mark.parametrize('name', ['.hidden', '_private'])
def test_folders_of_these_names_are_left_out(package: Path, name: str) -> None:
    (package / 'arm').rename(package / name)
    assert main([]) == 0


@pytest.mark.parametrize('pattern', ['node.py', 'arm/*.py'])
def test_excluded_files_are_left_out(package: Path, pattern: str) -> None:
    assert main(['.', '--exclude', pattern]) == 0


def test_config_is_the_named_file(package: Path) -> None:
    (package / 'lint.toml').write_text('[tool.ros2cc]\nignore = ["CC101"]\n')
    assert main(['--config', 'lint.toml']) == 0


def test_config_without_the_table_is_refused(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (package / 'lint.toml').write_text('[tool.other]\n')
    assert main(['--config', 'lint.toml']) == 2
    assert 'lint.toml: no table [tool.ros2cc]; add one' in capsys.readouterr().err


def test_missing_path_is_an_error_of_one_line(package: Path) -> None:
    assert main_with_errors(['nowhere']) == (2, ['nowhere: no such file or directory'])


def test_xunit_has_one_failure_per_finding(package: Path) -> None:
    main(['--xunit-file', 'build/arm/ros2cc.xunit.xml'])
    suite = ElementTree.parse(package / 'build' / 'arm' / 'ros2cc.xunit.xml').getroot()
    failed = [
        case.get('name') for case in suite.iter('testcase') if case.find('failure') is not None
    ]
    assert (suite.get('name'), suite.get('failures')) == ('arm.ros2cc', '1')
    assert failed == [f'CC101 ({NODE}:44:9)']


def pytest_in(package: Path) -> subprocess.CompletedProcess[str]:
    """Run the tests of the package as colcon does, from its folder."""
    return subprocess.run(
        [sys.executable, '-m', 'pytest', '-p', 'no:cacheprovider', '--strict-markers', 'test'],
        cwd=package,
        env={name: value for name, value in os.environ.items() if 'PYTEST' not in name},
        capture_output=True,
        text=True,
        check=False,
    )


def test_the_written_test_is_red_until_the_node_is_mended(run: Run, package: Path) -> None:
    assert run('init', cwd=package).status == 0
    red = pytest_in(package)
    assert red.returncode == 1, red.stdout
    assert f'{NODE}:44:9: CC101' in red.stdout
    (package / NODE).write_text(MENDED)
    green = pytest_in(package)
    assert green.returncode == 0, green.stdout
    assert 'warning' not in green.stdout


COMMIT = f'git+https://example.org/somebody/ros2cc-extract@{"0123456789" * 4}'


def test_init_twice_changes_nothing(run: Run, package: Path) -> None:
    everything = ('--pre-commit', '--github', '--gitlab', '--install', COMMIT)
    first = run('init', *everything, cwd=package)
    written = {path: path.stat().st_mtime_ns for path in package.rglob('*') if path.is_file()}
    second = run('init', *everything, cwd=package)
    assert (first.status, second.status) == (0, 0)
    assert first.err.count('wrote ') == 4
    assert second.err.count('is up to date') == 4
    assert {path: path.stat().st_mtime_ns for path in written} == written


def test_init_keeps_what_somebody_wrote(run: Run, package: Path) -> None:
    theirs = package / 'test' / 'test_ros2cc.py'
    theirs.parent.mkdir()
    theirs.write_text('# mine\n')
    outcome = run('init', cwd=package)
    assert (outcome.status, theirs.read_text()) == (0, '# mine\n')
    assert 'kept test/test_ros2cc.py' in outcome.err
    assert 'def test_ros2cc():' in outcome.out


def test_init_says_what_the_manifest_lacks(run: Run, package: Path) -> None:
    assert (
        'package.xml: add <test_depend>python3-pytest</test_depend> '
        '<test_depend>ros2cc_extract</test_depend>'
    ) in run('init', cwd=package).err


def test_init_of_a_cmake_package_says_what_cmake_needs(run: Run, package: Path) -> None:
    manifest = package / 'package.xml'
    manifest.write_text(manifest.read_text().replace('ament_python', 'ament_cmake'))
    assert 'ament_add_pytest_test(ros2cc test/test_ros2cc.py)' in run('init', cwd=package).err


def test_init_without_a_package_is_refused(run: Run) -> None:
    outcome = run('init', EXAMPLES)
    assert outcome.status == 2
    assert 'package.xml: cannot be read' in outcome.err


def test_console_script_is_the_linter() -> None:
    (script,) = metadata.entry_points(group='console_scripts', name='ament_ros2cc')
    assert script.load() in (main, entry_point)
