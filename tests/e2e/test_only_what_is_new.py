"""What a project accepts, demands and assumes: settings, comments, baselines, revisions."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from tests.e2e.conftest import Outcome, Run
from tests.support.packages import DEADLOCK, MENDED
from tests.support.repositories import commit, git, make_repository

LINE = '        self.client.call(Trigger.Request())\n'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Holds one node that deadlocks."""
    (tmp_path / 'node.py').write_text(DEADLOCK)
    return tmp_path


def findings(outcome: Outcome) -> list[tuple[str, int]]:
    """Code and line of everything that weighs more than a note."""
    return [
        (each['code'], each['line'])
        for each in json.loads(outcome.out)['findings']
        if each['severity'] != 'note'
    ]


def check(run: Run, *arguments: object) -> Outcome:
    return run('check', 'node.py', '--output-format', 'json', *arguments)


def settings(folder: Path, *lines: str) -> None:
    (folder / 'pyproject.toml').write_text('\n'.join(['[tool.ros2cc]', *lines, '']))


def test_without_settings_everything_counts(run: Run, folder: Path) -> None:
    outcome = check(run)
    assert (outcome.status, findings(outcome)) == (1, [('CC101', 44)])


@pytest.mark.parametrize(
    ('line', 'status'),
    [
        ('ignore = ["CC101"]', 0),
        ('ignore = ["CC1"]', 0),
        ('ignore = ["CC2"]', 1),
        ('per_path = {"*.py" = ["CC101"]}', 0),
        ('per_path = {"tests/*" = ["CC101"]}', 1),
    ],
)
def test_settings_switch_rules_off(run: Run, folder: Path, line: str, status: int) -> None:
    settings(folder, line)
    assert check(run).status == status


def test_settings_of_a_folder_above_count(run: Run, folder: Path) -> None:
    settings(folder, 'ignore = ["CC101"]')
    (folder / 'deep').mkdir()
    (folder / 'node.py').rename(folder / 'deep' / 'node.py')
    assert run('check', 'deep/node.py').status == 0


@pytest.mark.parametrize(
    ('demand', 'violated'),
    [
        ('never_together = [["drive", "on_map_ready"]]', True),
        ('never_together = [["drive", "map_ready_client"]]', False),
        ('can_overlap = [["drive", "on_map_ready"]]', False),
        ('can_overlap = [["drive", "map_ready_client"]]', True),
        ('never_starves = ["on_map_ready"]', False),
        ('never_starves = ["drive"]', False),
    ],
)
def test_demands_are_decided_by_the_model(
    run: Run, folder: Path, demand: str, violated: bool
) -> None:
    (folder / 'node.py').write_text(MENDED)
    settings(folder, demand)
    outcome = check(run)
    codes = {code for code, _ in findings(outcome)}
    assert (outcome.status, codes) == ((1, {'CC601'}) if violated else (0, set()))


def test_who_waits_behind_a_dead_lock_starves(run: Run, folder: Path) -> None:
    settings(folder, 'never_starves = ["map_ready_client"]', 'ignore = ["CC101"]')
    outcome = check(run)
    assert (outcome.status, [code for code, _ in findings(outcome)]) == (1, ['CC601'])


def test_a_demand_about_nobody_is_a_finding(run: Run, folder: Path) -> None:
    (folder / 'node.py').write_text(MENDED)
    settings(folder, 'never_starves = ["on_stop"]')
    outcome = check(run)
    assert outcome.status == 1
    assert [code for code, _ in findings(outcome)] == ['CC602']


@pytest.mark.parametrize(
    ('line', 'told'),
    [
        ('color = []', "unknown key 'color' in [tool.ros2cc]; known keys: never_together, "),
        ('never_togehter = []', "in [tool.ros2cc]; did you mean 'never_together'?"),
        ('ignore = ["CC1O1"]', "'CC1O1' in ignore of [tool.ros2cc] is no rule; did you mean 'CC1"),
        ('ignore = ["all"]', 'is no rule; `ros2cc-extract explain` lists them'),
        ('per_path = {"a*" = ["CC9"]}', '\'CC9\' in per_path."a*" of [tool.ros2cc] is no rule'),
        ('ignore = "CC101"', 'ignore of [tool.ros2cc] must be a list of texts'),
        ('timeout = -1', 'timeout of [tool.ros2cc] must be a number of seconds'),
        ('docs_url = "docs/"', 'docs_url of [tool.ros2cc] must be an address that begins with'),
        ('docs_url = "https://a b"', 'docs_url of [tool.ros2cc] must be an address'),
        ('baseline = 3', 'baseline of [tool.ros2cc] must be a path'),
        ('never_together = [["drive"]]', 'never_together'),
        ('ignore = [', 'no TOML'),
    ],
)
def test_wrong_settings_are_refused(run: Run, folder: Path, line: str, told: str) -> None:
    settings(folder, line)
    outcome = check(run)
    assert (outcome.status, outcome.out) == (2, '')
    assert 'pyproject.toml' in outcome.err
    assert told in outcome.err
    assert len(outcome.err.splitlines()) == 1


@pytest.mark.parametrize(
    ('line', 'expected'),
    [
        ('docs_url = "https://example.org/1.2/"', 'https://example.org/1.2/rules/CC101.html'),
        ('docs_url = ""', None),
        ('timeout = 60', None),
    ],
)
def test_sarif_points_to_the_pages_where_a_project_keeps_them(
    run: Run, folder: Path, line: str, expected: str | None
) -> None:
    settings(folder, line)
    log = json.loads(check(run, '--output-format', 'sarif').out)
    rules = log['runs'][0]['tool']['driver']['rules']
    assert {rule['id']: rule.get('helpUri') for rule in rules}['CC101'] == expected


@pytest.mark.parametrize(
    ('comment', 'above'),
    [
        ('# ros2cc: ignore[CC101] the map server answers from another process', False),
        ('# ros2cc: ignore[CC101]', True),
        ('# ros2cc: ignore[own-group-call]', False),
        ('# ros2cc: ignore[CC301, CC101]', False),
    ],
)
def test_a_comment_accepts_a_finding(run: Run, folder: Path, comment: str, above: bool) -> None:
    line = f'        {comment}\n{LINE}' if above else f'{LINE[:-1]}  {comment}\n'
    (folder / 'node.py').write_text(DEADLOCK.replace(LINE, line))
    outcome = check(run)
    assert ('CC101', 44) not in findings(outcome)
    assert ('CC101', 45) not in findings(outcome)
    assert json.loads(outcome.out)['summary']['accepted'] == 1


def test_a_comment_that_accepts_nothing_is_told(run: Run, folder: Path) -> None:
    mended = MENDED.replace(
        'call_async(Trigger.Request())', 'call_async(Trigger.Request())  # ros2cc: ignore[CC101]'
    )
    (folder / 'node.py').write_text(mended)
    outcome = check(run)
    assert outcome.status == 1
    assert 'CC101 is not found here any more' in outcome.out


def test_a_baseline_accepts_what_it_lists(run: Run, folder: Path) -> None:
    written = run('check', 'node.py', '--write-baseline', 'known.json')
    assert (written.status, written.out) == (0, '')
    (entry,) = json.loads((folder / 'known.json').read_text())['findings']
    assert (entry['code'], entry['path']) == ('CC101', 'node.py')
    (folder / 'node.py').write_text('# moved\n\n' + DEADLOCK)
    outcome = check(run, '--baseline', 'known.json')
    assert (outcome.status, findings(outcome)) == (0, [])
    assert json.loads(outcome.out)['summary']['accepted'] == 1


def test_a_baseline_hides_nothing_new(run: Run, folder: Path) -> None:
    (folder / 'node.py').write_text(MENDED)
    run('check', 'node.py', '--write-baseline', 'known.json')
    (folder / 'node.py').write_text(DEADLOCK)
    outcome = check(run, '--baseline', 'known.json')
    assert (outcome.status, findings(outcome)) == (1, [('CC101', 44)])


def test_settings_name_the_baseline_relative_to_their_file(run: Run, folder: Path) -> None:
    settings(folder, 'baseline = "ci/known.json"')
    assert run('check', 'node.py', '--write-baseline', 'ci/known.json').status == 0
    assert check(run).status == 0


@pytest.mark.parametrize(
    ('text', 'told'),
    [
        ('[', 'no JSON'),
        ('{"ros2cc_baseline": 99}', 'no baseline of version 1'),
        (None, 'known.json'),
    ],
)
def test_a_baseline_that_cannot_be_used(
    run: Run, folder: Path, text: str | None, told: str
) -> None:
    if text is not None:
        (folder / 'known.json').write_text(text)
    outcome = check(run, '--baseline', 'known.json')
    assert (outcome.status, outcome.out) == (2, '')
    assert told in outcome.err


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    """Committed: a node that deadlocks."""
    make_repository(tmp_path)
    (tmp_path / 'node.py').write_text(DEADLOCK)
    assert commit(tmp_path, 'start').returncode == 0
    return tmp_path


def test_a_change_answers_only_for_what_it_adds(run: Run, repository: Path) -> None:
    (repository / 'node.py').write_text('# moved\n\n' + DEADLOCK)
    assert findings(check(run, '--diff-base', 'HEAD')) == []
    other = repository / 'other.py'
    other.write_text(DEADLOCK)
    outcome = run('check', '.', '--output-format', 'json', '--diff-base', 'HEAD')
    assert outcome.status == 1
    (path,) = {
        each['path'] for each in json.loads(outcome.out)['findings'] if each['severity'] != 'note'
    }
    assert path == 'other.py'


def test_a_file_that_the_base_has_not_is_all_new(run: Run, repository: Path) -> None:
    (repository / 'new.py').write_text(DEADLOCK)
    assert run('check', 'new.py', '--diff-base', 'HEAD').status == 1


def test_the_work_tree_is_left_alone(run: Run, repository: Path) -> None:
    (repository / 'node.py').write_text(MENDED)
    run('check', '.', '--diff-base', 'HEAD')
    assert (repository / 'node.py').read_text() == MENDED
    names = {path.name for path in repository.iterdir()} - {'cache'}  # of the tests' user
    assert names == {'.git', 'node.py'}


def test_what_was_mended_elsewhere_meanwhile_is_not_new_here(run: Run, repository: Path) -> None:
    git(repository, 'branch', 'mine')
    (repository / 'node.py').write_text(MENDED)
    assert commit(repository, 'mend').returncode == 0
    git(repository, 'switch', '--quiet', 'mine')
    (repository / 'other.py').write_text('OTHER = 1\n')
    assert commit(repository, 'add').returncode == 0
    assert findings(check(run, '--diff-base', 'main')) == []


def test_a_submodule_is_taken_as_the_base_has_it(
    run: Run, repository: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    library = tmp_path_factory.mktemp('library')
    make_repository(library)
    (library / 'arm.py').write_text(DEADLOCK)
    assert commit(library, 'start').returncode == 0
    local = ('-c', 'protocol.file.allow=always')
    added = git(repository, *local, 'submodule', 'add', '--quiet', str(library), 'deps/library')
    assert added.returncode == 0, added.stdout
    assert commit(repository, 'use the library').returncode == 0
    checked = ('check', '.', '--output-format', 'json', '--diff-base', 'HEAD')
    assert findings(run(*checked)) == []
    (repository / 'deps' / 'library' / 'new.py').write_text(DEADLOCK)
    assert findings(run(*checked)) == [('CC101', 44)]


@pytest.mark.parametrize('target', ['/etc', '/nonexistent/x', '../..', 'loop.py', 'node.py', ''])
def test_links_of_the_base_are_no_hindrance(run: Run, repository: Path, target: str) -> None:
    if target:
        (repository / 'loop.py').symlink_to(target)
    else:
        (repository / 'deep').mkdir()
        (repository / 'deep' / 'link').symlink_to(repository)
    assert commit(repository, 'link').returncode == 0
    outcome = run('check', '.', '--output-format', 'json', '--diff-base', 'HEAD')
    assert [code for code, _ in findings(outcome) if code != 'CC500'] == []


def test_a_node_behind_a_link_is_the_one_of_the_base(run: Run, repository: Path) -> None:
    (repository / 'src').mkdir()
    (repository / 'node.py').rename(repository / 'src' / 'arm.py')
    (repository / 'node.py').symlink_to('src/../src/arm.py')
    assert commit(repository, 'move').returncode == 0
    assert findings(check(run, '--diff-base', 'HEAD')) == []
    (repository / 'src' / 'arm.py').write_text(MENDED)
    assert commit(repository, 'mend').returncode == 0
    (repository / 'src' / 'arm.py').write_text(DEADLOCK)
    assert findings(check(run, '--diff-base', 'HEAD')) == [('CC101', 44)]


def test_what_is_left_out_of_archives_is_in_the_base(run: Run, repository: Path) -> None:
    (repository / '.gitattributes').write_text('node.py export-ignore\n')
    assert commit(repository, 'attributes').returncode == 0
    assert findings(check(run, '--diff-base', 'HEAD')) == []


def test_an_absolute_path_outside_of_the_current_folder(run: Run, repository: Path) -> None:
    (repository / 'elsewhere').mkdir()
    node = repository / 'node.py'
    arguments = ('check', node, '--output-format', 'json', '--diff-base', 'HEAD')
    assert findings(run(*arguments, cwd=repository / 'elsewhere')) == []
    node.write_text(MENDED)
    assert commit(repository, 'mend').returncode == 0
    node.write_text(DEADLOCK)
    assert findings(run(*arguments, cwd=repository / 'elsewhere')) == [('CC101', 44)]


def test_a_path_that_is_in_no_repository_is_refused(
    run: Run, repository: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    other = tmp_path_factory.mktemp('other') / 'node.py'
    other.write_text(DEADLOCK)
    outcome = run('check', other, '--diff-base', 'HEAD')
    (line,) = outcome.err.splitlines()
    assert (outcome.status, f'is not in the repository {repository}' in line) == (2, True)


def test_a_folder_that_had_no_python_is_all_new(run: Run, repository: Path) -> None:
    (repository / 'tools').mkdir()
    (repository / 'tools' / 'README').write_text('nothing yet\n')
    assert commit(repository, 'tools').returncode == 0
    (repository / 'tools' / 'node.py').write_text(DEADLOCK)
    assert run('check', 'tools', '--diff-base', 'HEAD').status == 1


def test_nothing_of_the_base_is_written(
    run: Run,
    repository: Path,
    tmp_path_factory: pytest.TempPathFactory,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """So nothing is left behind, however the check ends."""
    temporary = tmp_path_factory.mktemp('temporary')
    monkeypatch.setenv('TMPDIR', str(temporary))
    os.utime(temporary, (1, 1))
    assert findings(check(run, '--diff-base', 'HEAD')) == []
    assert temporary.stat().st_mtime == 1


def test_a_repository_of_somebody_else_is_told_with_what_git_advises(
    run: Run, repository: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As in a container job, where the checkout belongs to another user."""
    monkeypatch.setenv('GIT_TEST_ASSUME_DIFFERENT_OWNER', '1')
    outcome = check(run, '--diff-base', 'HEAD')
    assert (outcome.status, outcome.out) == (2, '')
    (line,) = outcome.err.splitlines()
    assert line.startswith('ros2cc-extract: error: git rev-parse: fatal: ')
    assert line.endswith(f'; git config --global --add safe.directory {repository}')


@pytest.mark.parametrize('revision', ['no-such-branch', '--output=stolen'])
def test_a_revision_that_is_none_is_an_error(run: Run, repository: Path, revision: str) -> None:
    outcome = check(run, f'--diff-base={revision}')
    assert outcome.status == 2
    assert not (repository / 'stolen').exists()
    assert len(outcome.err.splitlines()) == 1


def test_outside_git_there_is_no_base(run: Run, folder: Path) -> None:
    outcome = check(run, '--diff-base', 'HEAD')
    assert outcome.status == 2
    assert 'git' in outcome.err


OPEN = """import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_subscription(String, 'a', self.on_a, 10)
        self.create_subscription(String, 'b', self.on_b, 10)

    def on_a(self, message):
        pass

    def on_b(self, message):
        pass
"""


def executor_of(outcome: Outcome) -> tuple[str, int]:
    executor = json.loads(outcome.out)['units'][0]['node']['executor']
    return executor['kind'], len(executor['threads'])


def test_assumptions_fill_holes(run: Run, tmp_path: Path) -> None:
    (tmp_path / 'node.py').write_text(OPEN)
    outcome = check(run, '--assume', 'executor=MultiThreadedExecutor', '--assume', 'threads=4')
    assert executor_of(outcome) == ('MultiThreadedExecutor', 4)


def test_assumptions_of_the_command_line_go_before_those_of_the_settings(
    run: Run, tmp_path: Path
) -> None:
    (tmp_path / 'node.py').write_text(OPEN)
    settings(tmp_path, 'assume = ["executor=MultiThreadedExecutor", "threads=2"]')
    assert executor_of(check(run)) == ('MultiThreadedExecutor', 2)
    assert executor_of(check(run, '--assume', 'threads=3')) == ('MultiThreadedExecutor', 3)


def test_assumptions_do_not_overrule_what_the_source_says(run: Run, folder: Path) -> None:
    assert executor_of(check(run, '--assume', 'threads=7')) == ('MultiThreadedExecutor', 4)


@pytest.mark.parametrize('fact', ['threads=none', 'speed=4', 'threads'])
def test_an_assumption_that_is_none_is_refused(run: Run, folder: Path, fact: str) -> None:
    outcome = check(run, '--assume', fact)
    assert (outcome.status, outcome.out) == (2, '')
    assert len(outcome.err.splitlines()) == 1


def test_comments_count_in_a_module_that_is_only_imported(run: Run, folder: Path) -> None:
    ignored = DEADLOCK.replace(LINE, LINE.rstrip() + '  # ros2cc: ignore[CC101] known\n')
    (folder / 'arm.py').write_text(f'# ros2cc: ignore[CC201] of another program\n{ignored}')
    (folder / 'node.py').write_text('import rclpy\nfrom arm import main\n\nmain()\n')
    assert LINE in DEADLOCK
    outcome = check(run)
    assert (outcome.status, findings(outcome)) == (0, [])
    assert json.loads(outcome.out)['summary']['accepted'] == 1
