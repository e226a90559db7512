"""The source distribution holds what it takes to build and to test the package."""

from __future__ import annotations

import runpy
import subprocess
import sys
from pathlib import Path
from unittest import mock

import pytest

from release.sources import ROOT, copied_tree, sdist, unpacked


@pytest.fixture(scope='module')
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp('sources')
    return unpacked(sdist(folder, folder / 'dist'), folder / 'unpacked')


def files(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob('*') if path.is_file()}


def test_it_holds_every_file_of_the_project(tree: Path, tmp_path: Path) -> None:
    left_out = files(copied_tree(tmp_path / 'all')) - files(tree)
    assert {name for name in left_out if not name.startswith('.')} == set()


def test_it_holds_every_native_source(tree: Path) -> None:
    with mock.patch('setuptools.setup') as called:
        runpy.run_path(str(tree / 'setup.py'))
    parts = called.call_args.kwargs['ext_modules']
    needed = {name for part in parts for name in (*part.sources, *part.depends)}
    named = {name for name in files(tree) if Path(name).suffix in ('.c', '.cpp', '.hpp')}
    assert needed == {name for name in named if name.startswith('ros2cc_extract/')}


def installed_files(source: Path, to: Path) -> set[str]:
    command = [sys.executable, 'setup.py', '-q', 'build', '--build-base', to, '--build-lib', to]
    subprocess.run(command, cwd=source, check=True, env={'ROS2CC_NATIVE_BUILD': 'none'})
    return files(to)


def test_what_it_installs_is_what_the_project_does(tree: Path, tmp_path: Path) -> None:
    from_it = installed_files(tree, tmp_path / 'from_it')
    assert from_it == installed_files(copied_tree(tmp_path / 'copy'), tmp_path / 'from_here')
    assert 'ros2cc_extract/generator/profiles/rclpy/activity.xml.j2' in from_it


@pytest.mark.slow
def test_a_native_wheel_from_it_checks_a_node(tree: Path, tmp_path: Path) -> None:
    command = [sys.executable, '-m', 'pip', 'wheel', '-q', '--no-deps', '-w', tmp_path, tree]
    subprocess.run(
        command, check=True, env={'ROS2CC_NATIVE_BUILD': 'required', 'PATH': '/usr/bin'}
    )
    (wheel,) = tmp_path.glob('*.whl')
    subprocess.run([sys.executable, '-m', 'venv', '--system-site-packages', tmp_path / 'v'])
    python = tmp_path / 'v/bin/python'
    subprocess.run([python, '-m', 'pip', 'install', '-q', wheel], check=True)
    node = ROOT / 'launch_free_examples/service_deadlock/node.py'
    done = subprocess.run([python, '-m', 'ros2cc_extract', node], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (1, '')
    assert 'native checker' in done.stdout


def test_how_native_parts_are_built_is_one_of_three() -> None:
    environment = {'ROS2CC_NATIVE_BUILD': 'maybe'}
    command = [sys.executable, 'setup.py', '--version']
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
    assert done.returncode == 1
    assert 'ROS2CC_NATIVE_BUILD is optional, required or none, and not maybe' in done.stderr


@pytest.mark.parametrize(('native', 'status'), [('optional', 0), ('required', 1), ('none', 0)])
def test_without_a_compiler_only_what_is_required_fails(
    tree: Path, tmp_path: Path, native: str, status: int
) -> None:
    command = [sys.executable, 'setup.py', '-q', 'build', '--build-base', tmp_path]
    environment = {'ROS2CC_NATIVE_BUILD': native, 'CC': '/nowhere/cc', 'CXX': '/nowhere/c++'}
    done = subprocess.run(command, cwd=tree, env=environment, capture_output=True, text=True)
    assert done.returncode == status, done.stderr
    assert not list(tmp_path.rglob('*.so'))
