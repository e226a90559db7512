"""No program that a repository's settings name is run by ``--diff-base``."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from ros2cc_extract.errors import InputError
from ros2cc_extract.revision.git import Repository
from tests.attack.repositories import ATTACKS, Scene
from tests.attack.running import Ended, run_tool
from tests.support.packages import DEADLOCK
from tests.support.repositories import commit, environment, git, make_repository

CLASS = 'git configurations'
CANARY = 'canary'


@pytest.fixture(scope='module')
def two_commits(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A repository with two commits, between which nothing was added but a line."""
    folder = tmp_path_factory.mktemp('commits') / 'repository'
    make_repository(folder)
    (folder / 'node.py').write_text(DEADLOCK)
    assert commit(folder, 'start').returncode == 0
    (folder / 'node.py').write_text(f'# moved\n{DEADLOCK}')
    assert commit(folder, 'move').returncode == 0
    return folder


@pytest.fixture
def scene(two_commits: Path, tmp_path: Path) -> Scene:
    """A copy of the repository, and a program that none of its settings may have run."""
    program = tmp_path / 'program'
    program.write_text(f'#!/bin/sh\necho "$0 $@" >> "{tmp_path / CANARY}"\nexit 1\n')
    program.chmod(0o755)
    return Scene(shutil.copytree(two_commits, tmp_path / 'repository', symlinks=True), program)


def variables(name: str, scene: Scene) -> dict[str, str]:
    given = ATTACKS[name].environment.items()
    places = {'PROGRAM': str(scene.program), 'PARENT': str(scene.folder.parent)}
    pattern = re.compile('|'.join(places))
    return {key: pattern.sub(lambda found: places[found[0]], value) for key, value in given}


def check(scene: Scene, below: str = '', base: str = 'HEAD~1', **more: str) -> Ended:
    node = str(scene.folder / 'node.py')
    cache = {'XDG_CACHE_HOME': f'{scene.folder}.cache'}
    return run_tool(node, '--diff-base', base, cwd=scene.folder / below, **cache, **more)


@pytest.mark.parametrize('name', ATTACKS)
def test_no_program_of_the_repository_is_run(name: str, scene: Scene) -> None:
    attack = ATTACKS[name]
    attack.set_up(scene)
    canary = scene.folder.parent / CANARY
    canary.unlink(missing_ok=True)
    done = check(scene, attack.below, **variables(name, scene))
    assert not canary.exists(), canary.read_text()
    assert done.status == attack.status, done.told
    if attack.told:
        (line,) = done.err.splitlines()
        assert re.search(attack.told, line)


@pytest.mark.parametrize('name', [name for name in ATTACKS if ATTACKS[name].trigger])
def test_git_itself_would_run_it(name: str, scene: Scene) -> None:
    attack = ATTACKS[name]
    attack.set_up(scene)
    canary = scene.folder.parent / CANARY
    canary.unlink(missing_ok=True)
    folder = scene.folder / attack.below
    done = git(folder, *attack.trigger, **variables(name, scene))
    assert canary.exists(), done.stdout


@pytest.fixture
def clean(scene: Scene) -> str:
    """The work tree adds a deadlock to a commit that has none: its name."""
    (scene.folder / 'node.py').write_text('PASS = 1\n')
    assert commit(scene.folder, 'empty').returncode == 0
    (scene.folder / 'node.py').write_text(DEADLOCK)
    return git(scene.folder, 'rev-parse', 'HEAD').stdout.strip()


def test_what_the_base_holds_is_not_replaced(scene: Scene, clean: str) -> None:
    assert git(scene.folder, 'replace', clean, 'HEAD~1').returncode == 0
    assert git(scene.folder, 'grep', '-q', 'rclpy', 'HEAD').returncode == 0
    assert check(scene, base='HEAD').status == 1


def test_a_graft_does_not_move_the_base(scene: Scene, clean: str) -> None:
    start = git(scene.folder, 'rev-parse', 'HEAD~1').stdout.strip()
    assert commit(scene.folder, 'mine').returncode == 0
    mine = git(scene.folder, 'rev-parse', 'HEAD').stdout.strip()
    scene.write('.git/info/grafts', f'{mine} {start}\n')
    assert git(scene.folder, 'merge-base', clean, 'HEAD').stdout.strip().endswith(start)
    assert check(scene, base=clean).status == 1


def test_settings_that_never_end_are_not_waited_for(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr('ros2cc_extract.revision.git.PATIENCE_S', 0.5)
    fifo = scene.folder / '.git' / 'fifo'
    os.mkfifo(fifo)
    scene.configure('[include]', f'path = {fifo}')
    with pytest.raises(InputError, match=r'git rev-parse takes longer than 0\.5 s'):
        Repository(scene.folder).ask('rev-parse', 'HEAD')
    with pytest.raises(OSError, match='No such device or address'):  # nobody reads any more
        os.open(fifo, os.O_WRONLY | os.O_NONBLOCK)


def tree_of(scene: Scene, *entries: bytes) -> str:
    """A tree as git itself would make none."""
    made = subprocess.run(
        ['git', 'hash-object', '-t', 'tree', '-w', '--literally', '--stdin'],
        cwd=scene.folder,
        env=environment(),
        input=b''.join(entries),
        capture_output=True,
        check=True,
    )
    return made.stdout.decode().strip()


def commit_of(scene: Scene, tree: str) -> str:
    return git(scene.folder, 'commit-tree', tree, '-m', 'hostile').stdout.strip()


@pytest.mark.parametrize(
    'name', [b'..', b'.', b'.git', b'/etc/evil.py', b'../../evil.py', b'a\nb.py', b'\xff.py']
)
def test_names_in_a_tree_lead_nowhere(name: bytes, scene: Scene) -> None:
    blob = bytes.fromhex(git(scene.folder, 'rev-parse', 'HEAD:node.py').stdout.strip())
    node, other = (b'100644 ' + each + b'\0' + blob for each in (b'node.py', name))
    before = sorted(scene.folder.parent.rglob('*'))
    base = commit_of(scene, tree_of(scene, node, other))
    done = check(scene, base=base)
    assert done.status == 0, done.err
    grown = {path.name for path in set(scene.folder.parent.rglob('*')) - set(before)}
    assert 'evil.py' not in grown


def test_a_tree_that_doubles_is_refused(scene: Scene) -> None:
    """Forty small trees that name 2**40 files, as a clone gets them in a few kilobytes."""
    blob = git(scene.folder, 'rev-parse', 'HEAD:node.py').stdout.strip()
    tree = tree_of(scene, *(b'100644 %c.py\0' % n + bytes.fromhex(blob) for n in b'ab'))
    for _ in range(40):
        tree = tree_of(scene, *(b'40000 %c\0' % n + bytes.fromhex(tree) for n in b'ab'))
    done = check(scene, base=commit_of(scene, tree))
    (line,) = done.err.splitlines()
    assert (done.status, 'gives more than' in line) == (2, True)


def test_a_submodule_within_itself_ends(scene: Scene) -> None:
    blob = git(scene.folder, 'rev-parse', 'HEAD:node.py').stdout.strip()
    start = git(scene.folder, 'rev-parse', 'HEAD').stdout.strip()
    module, node = (
        mode + b'\0' + bytes.fromhex(name)
        for mode, name in ((b'160000 a', start), (b'100644 node.py', blob))
    )
    (scene.folder / 'a').symlink_to('.')
    assert check(scene, base=commit_of(scene, tree_of(scene, module, node))).status == 0
