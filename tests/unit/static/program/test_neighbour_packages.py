"""One file is given; what it imports stands in packages of the same workspace."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2cc_extract.extract.static.api import scan

NODE = (
    'from rclpy.node import Node\n\n\nclass A(Node):\n    def __init__(self):\n'
    "        super().__init__('a')\n        self.create_timer(1.0, self.tick)\n\n"
    '    def tick(self):\n        pass\n'
)
SCRIPT = 'import rclpy\nfrom {} import A\n\nrclpy.init()\nrclpy.spin(A())\n'


def write(path: Path, text: str = '') -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding='utf-8')


def names_of(folder: Path, script: str) -> list[str]:
    units = scan([folder / script], root=folder).units
    return [callback.name for unit in units for callback in unit.callbacks]


@pytest.mark.parametrize(
    'package', ['arm/arm', 'arm/src/arm', 'ws/arm/arm'], ids=['beside', 'src', 'deeper']
)
@pytest.mark.parametrize('script', ['arm/scripts/run.py', 'app/app/run.py', 'app/run.py'])
def test_package_of_the_workspace_is_found(tmp_path: Path, package: str, script: str) -> None:
    deeper = 'ws/' if package.startswith('ws/') else ''
    write(tmp_path / package / '__init__.py')
    write(tmp_path / package / 'nodes.py', NODE)
    write(tmp_path / deeper / 'arm' / 'package.xml', '<package/>')
    write(tmp_path / deeper / script, SCRIPT.format('arm.nodes'))
    assert names_of(tmp_path, f'{deeper}{script}') == ['tick']


DEPENDING = '<package><name>app</name><exec_depend>arm</exec_depend></package>'
STRANGER = '<package><name>app</name><!-- <depend>arm</depend> --></package>'


@pytest.mark.parametrize(('manifest', 'expected'), [(DEPENDING, ['tick']), (STRANGER, [])])
def test_package_elsewhere_in_the_repository_is_found_by_its_manifest(
    tmp_path: Path, manifest: str, expected: list[str]
) -> None:
    (tmp_path / '.git').mkdir()
    write(tmp_path / 'core' / 'arm_driver' / 'package.xml', '<package><name>arm</name></package>')
    write(tmp_path / 'core' / 'arm_driver' / 'arm' / '__init__.py')
    write(tmp_path / 'core' / 'arm_driver' / 'arm' / 'nodes.py', NODE)
    write(tmp_path / 'apps' / 'app' / 'package.xml', manifest)
    write(tmp_path / 'apps' / 'app' / 'run.py', SCRIPT.format('arm.nodes'))
    assert names_of(tmp_path, 'apps/app/run.py') == expected


def test_folder_without_a_manifest_is_no_package(tmp_path: Path) -> None:
    write(tmp_path / 'arm' / 'arm' / '__init__.py')
    write(tmp_path / 'arm' / 'arm' / 'nodes.py', NODE)
    write(tmp_path / 'app' / 'run.py', SCRIPT.format('arm.nodes'))
    assert names_of(tmp_path, 'app/run.py') == []


def test_known_library_is_not_followed_into_its_sources(tmp_path: Path) -> None:
    write(tmp_path / 'tf2_ros' / 'package.xml', '<package/>')
    write(tmp_path / 'tf2_ros' / 'tf2_ros' / '__init__.py', NODE)
    write(tmp_path / 'app' / 'run.py', SCRIPT.format('tf2_ros'))
    assert names_of(tmp_path, 'app/run.py') == []


@pytest.mark.parametrize('home', ['app', 'app/src'])
@pytest.mark.parametrize(
    ('manifest', 'expected'), [('app/setup.py', ['tick']), ('arm/setup.py', [])]
)
def test_folder_of_modules_beside_the_manifest_is_found(
    tmp_path: Path, home: str, manifest: str, expected: list[str]
) -> None:
    """Without any ``__init__.py``: a namespace package."""
    write(tmp_path / home / 'parts' / 'nodes.py', NODE)
    write(tmp_path / manifest)
    write(tmp_path / 'app' / 'app' / 'run.py', SCRIPT.format('parts.nodes'))
    assert names_of(tmp_path, 'app/app/run.py') == expected
