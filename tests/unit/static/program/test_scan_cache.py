"""The cache gives what a scan gives, and forgets as soon as any file it depends on changes."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2cc_extract.extract.static.api import scan

MAIN = 'import rclpy\nimport names\nrclpy.spin(rclpy.create_node(names.NAME))\n'


def names_of(folder: Path, *, path: str = '.') -> list[str]:
    found = scan([folder / 'src' / path], root=folder, cache=folder / 'cache')
    return [unit.name for unit in found.units]


def write(folder: Path, name: str) -> None:
    (folder / 'src').mkdir(exist_ok=True)
    (folder / 'src' / 'main.py').write_text(MAIN)
    (folder / 'src' / 'names.py').write_text(f'NAME = {name!r}\n')


def test_second_scan_reads_the_first_result(tmp_path: Path) -> None:
    write(tmp_path, 'one')
    assert names_of(tmp_path) == names_of(tmp_path) == ['one']
    assert len(list((tmp_path / 'cache').iterdir())) == 1


def test_changed_file_is_scanned_anew(tmp_path: Path) -> None:
    write(tmp_path, 'one')
    names_of(tmp_path)
    write(tmp_path, 'two')
    assert names_of(tmp_path) == ['two']


def test_changed_import_of_a_single_file_is_noticed(tmp_path: Path) -> None:
    write(tmp_path, 'one')
    assert names_of(tmp_path, path='main.py') == ['one']
    write(tmp_path, 'two')
    assert names_of(tmp_path, path='main.py') == ['two']


def test_damaged_entry_counts_as_none(tmp_path: Path) -> None:
    write(tmp_path, 'one')
    names_of(tmp_path)
    for entry in (tmp_path / 'cache').iterdir():
        entry.write_bytes(b'damaged')
    assert names_of(tmp_path) == ['one']


@pytest.mark.parametrize('paths', [('.', 'broken.py'), ('broken.py', '.')])
def test_file_that_is_named_and_its_folder_have_results_of_their_own(
    tmp_path: Path, paths: tuple[str, str]
) -> None:
    (tmp_path / 'src').mkdir()
    (tmp_path / 'src' / 'broken.py').write_text('def f(:\n')

    found = {
        path: scan([tmp_path / 'src' / path], root=tmp_path, cache=tmp_path / 'cache').diagnostics
        for path in paths
    }

    assert found['.'] == ()
    assert [told.slug for told in found['broken.py']] == ['syntax-error']
