"""What ``init`` writes for a server installs nothing of a stranger's and runs no branch's name."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml

from ros2cc_extract.errors import InputError
from ros2cc_extract.packages import origin
from ros2cc_extract.packages.origin import pinned_source
from tests.support.repositories import environment

CLASS = 'CI jobs'

ROOT = Path(__file__).parents[2]
SNIPPETS = ROOT / 'ros2cc_extract' / 'packages' / 'snippets'
JOBS = (ROOT / 'action.yml', SNIPPETS / 'github-workflow.yml', SNIPPETS / 'gitlab-ci.yml')
COMMIT, DIGEST = '0123456789' * 4, 'ab' * 32
REMOTE = 'https://example.org/somebody/ros2cc-extract'


def shell_lines(data: object) -> Iterator[str]:
    """Everything that a job hands to a shell."""
    if isinstance(data, dict):
        for key, value in data.items():
            if key in ('run', 'script'):
                yield from [value] if isinstance(value, str) else value
            else:
                yield from shell_lines(value)
    elif isinstance(data, list):
        for value in data:
            yield from shell_lines(value)


def lines_of(path: Path) -> list[str]:
    data: Any = yaml.safe_load(path.read_text())
    return list(shell_lines(data))


@pytest.mark.parametrize('path', JOBS, ids=lambda path: path.name)
def test_no_expression_stands_in_a_shell_line(path: Path) -> None:
    """GitHub writes its value into the text before a shell reads it."""
    lines = lines_of(path)
    assert lines
    assert not any('${{' in line for line in lines)


@pytest.mark.parametrize('path', JOBS, ids=lambda path: path.name)
def test_nothing_is_installed_by_its_bare_name(path: Path) -> None:
    installing = [line for line in lines_of(path) if 'install' in line]
    assert installing
    assert not any('install ros2cc' in line for line in installing)


def in_a_shell(line: str, folder: Path, **variables: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ['bash', '-e', '-c', line],
        cwd=folder,
        env=environment(**variables),
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize(
    'branch', ['$(touch canary)', '`touch canary`', 'x"; touch canary; "', '--output=canary', '-o']
)
def test_the_name_of_a_branch_is_data(branch: str, tmp_path: Path) -> None:
    (line,) = (each for each in lines_of(JOBS[1]) if '--diff-base' in each)
    done = in_a_shell(line, tmp_path, BASE=branch)
    assert (done.returncode, list(tmp_path.iterdir())) == (2, [])


@pytest.mark.parametrize('path', JOBS[1:], ids=lambda path: path.name)
@pytest.mark.parametrize('name', ['pip', 'json', 'runpy', 'encodings'])
def test_modules_of_the_checkout_are_not_imported(path: Path, name: str, tmp_path: Path) -> None:
    evil = f'open({str(tmp_path / "canary")!r}, "w").write("run")\n'
    (tmp_path / name).mkdir()
    (tmp_path / name / '__init__.py').write_text(evil)
    (tmp_path / f'{name}.py').write_text(evil)
    (line,) = (each for each in lines_of(path) if 'install' in each)
    done = in_a_shell(line, tmp_path, ROS2CC_SOURCE='./none.whl', PYTHONPATH='')
    assert done.returncode != 0
    assert not (tmp_path / 'canary').exists()


@pytest.mark.parametrize(
    'source',
    [
        f'git+{REMOTE}@{COMMIT}',
        f'git+ssh://git@example.org/somebody/ros2cc-extract.git@{COMMIT}',
        f'git+{REMOTE}@{DIGEST}#subdirectory=tools/ros2cc',
        f'https://example.org/ros2cc_extract-0.1.0-py3-none-any.whl#sha256={DIGEST}',
        'wheels/ros2cc_extract-0.1.0-py3-none-any.whl',
    ],
)
def test_what_is_pinned_is_taken(source: str) -> None:
    assert pinned_source(source) == source


@pytest.mark.parametrize(
    'source',
    [
        '',
        'ros2cc-extract',
        'ros2cc-extract==0.1.0',
        f'git+{REMOTE}',
        f'git+{REMOTE}@main',
        f'git+{REMOTE}@{COMMIT[:12]}',
        f'git+http://example.org/x@{COMMIT}',
        'https://example.org/x.whl',
        '--index-url=https://example.org/x.whl',
        f"git+{REMOTE}@{COMMIT}'",
        f'git+{REMOTE}$(touch)@{COMMIT}',
        f'git+{REMOTE}@{COMMIT}\n',
        'a b.whl',
    ],
)
def test_what_can_be_something_else_tomorrow_is_refused(source: str) -> None:
    with pytest.raises(InputError, match='does not say exactly what is installed; name a commit'):
        pinned_source(source)


@pytest.mark.parametrize(
    ('kept', 'source'),
    [
        (
            {'url': REMOTE, 'vcs_info': {'vcs': 'git', 'commit_id': COMMIT}},
            f'git+{REMOTE}@{COMMIT}',
        ),
        (
            {'url': f'{REMOTE}/x.whl', 'archive_info': {'hashes': {'sha256': DIGEST}}},
            f'{REMOTE}/x.whl#sha256={DIGEST}',
        ),
        ({'url': 'file:///home/me/x', 'dir_info': {'editable': True}}, None),
        ({'url': 'file:///x.whl', 'archive_info': {'hashes': {'sha256': DIGEST}}}, None),
        ({}, None),
    ],
)
def test_what_is_installed_here_is_the_default(
    kept: dict[str, Any], source: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(origin, '_direct_url', lambda: kept)
    if source is not None:
        assert pinned_source(None) == source
        return
    with pytest.raises(InputError, match='--install'):
        pinned_source(None)


def test_a_job_is_not_written_without_a_source(tmp_path: Path) -> None:
    """Nor is anything else: `init` is called once more, with one."""
    (tmp_path / 'package.xml').write_text('<package><name>arm</name></package>')
    command = [sys.executable, '-m', 'ros2cc_extract.cli.main', 'init', '--github']
    done = subprocess.run(
        [*command, '--install', 'ros2cc-extract'],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, len(done.stderr.splitlines())) == (2, 1)
    assert [path.name for path in tmp_path.iterdir()] == ['package.xml']
