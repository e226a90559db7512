"""
Repositories whose configuration names a program wherever git has a place for one.

Each says what a user of git may do to have it run, as far as that can be done here: where that
does not run it, the configuration is none, and proves nothing.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from tests.support.packages import DEADLOCK
from tests.support.repositories import commit, git, make_repository

HOOKS = ('post-checkout', 'post-index-change', 'pre-auto-gc', 'reference-transaction')
ALL_PYTHON = '*.py filter=x diff=x merge=x\n'


@dataclass(frozen=True)
class Scene:
    """
    One repository.

    :param program: writes a canary when it is run.
    """

    folder: Path
    program: Path

    def configure(self, *lines: str) -> None:
        """Append to the repository's own settings, in which ``PROGRAM`` is the program."""
        text = '\n'.join(['', *lines, '']).replace('PROGRAM', str(self.program))
        with (self.folder / '.git' / 'config').open('a') as stream:
            stream.write(text)

    def write(self, name: str, text: str) -> Path:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.replace('PROGRAM', str(self.program)))
        return path

    def fill_hooks(self, folder: Path) -> None:
        folder.mkdir(exist_ok=True)
        for name in HOOKS:
            shutil.copy(self.program, folder / name)

    def lack_the_base(self, url: str) -> None:
        """Make it a partial clone that has not the file as it was: git would fetch it."""
        name = git(self.folder, 'rev-parse', 'HEAD~1:node.py').stdout.strip()
        (self.folder / '.git' / 'objects' / name[:2] / name[2:]).unlink()
        git(self.folder, 'config', 'core.repositoryFormatVersion', '1')
        git(self.folder, 'config', 'extensions.partialClone', 'origin')
        git(self.folder, 'config', 'remote.origin.promisor', 'true')
        git(self.folder, 'config', 'remote.origin.url', url.replace('PROGRAM', str(self.program)))
        git(self.folder, 'config', 'remote.origin.fetch', '+refs/heads/*:refs/remotes/origin/*')


SetUp = Callable[[Scene], None]


@dataclass(frozen=True)
class Attack:
    """
    One way to name a program.

    :param trigger: a call of git that runs it; empty where there is none without a terminal,
        a key or a server.
    :param status: how a check ends; a clone that lacks objects cannot be compared.
    :param told: what the line of an error says then.
    :param below: the folder in which the tool and git are called.
    """

    set_up: SetUp
    trigger: tuple[str, ...] = ()
    status: int = 0
    told: str = ''
    below: str = ''
    environment: Mapping[str, str] = field(default_factory=dict)


def settings(*lines: str, attributes: bool = False) -> SetUp:
    def set_up(scene: Scene) -> None:
        if attributes:
            scene.write('.git/info/attributes', ALL_PYTHON)
        scene.configure(*lines)

    return set_up


def lacking(url: str, *lines: str) -> SetUp:
    def set_up(scene: Scene) -> None:
        scene.lack_the_base(url)
        scene.configure(*lines)

    return set_up


def committed_attributes(scene: Scene) -> None:
    scene.write('.gitattributes', ALL_PYTHON)
    commit(scene.folder, 'attributes')
    scene.write('node.py', f'# once more\n{DEADLOCK}')
    commit(scene.folder, 'once more')
    scene.configure('[filter "x"]', 'smudge = PROGRAM')


def attributes_elsewhere(scene: Scene) -> None:
    file = scene.write('.git/more-attributes', ALL_PYTHON)
    scene.configure('[core]', f'attributesFile = {file}', '[filter "x"]', 'smudge = PROGRAM')


def hooks_elsewhere(scene: Scene) -> None:
    folder = scene.folder / '.git' / 'others'
    scene.fill_hooks(folder)
    scene.configure('[core]', f'hooksPath = {folder}')


def included(head: str) -> SetUp:
    def set_up(scene: Scene) -> None:
        file = scene.write('.git/more', '[core]\nfsmonitor = PROGRAM\n')
        scene.configure(head.replace('TOP', str(scene.folder)), f'path = {file}')

    return set_up


def settings_of_work_tree(scene: Scene) -> None:
    git(scene.folder, 'config', 'core.repositoryFormatVersion', '1')
    scene.configure('[extensions]', 'worktreeConfig = true')
    scene.write('.git/config.worktree', '[core]\nfsmonitor = PROGRAM\n')


def submodule_to_update(scene: Scene) -> None:
    _with_module(scene)
    (scene.folder / 'module' / '.git').unlink()
    scene.configure('[submodule "module"]', 'update = !PROGRAM')


def submodule_with_settings(scene: Scene) -> None:
    _with_module(scene)
    with (scene.folder / '.git' / 'modules' / 'module' / 'config').open('a') as stream:
        stream.write(f'[core]\nfsmonitor = {scene.program}\n')


def _with_module(scene: Scene) -> None:
    library = scene.folder.parent / 'library'
    make_repository(library)
    (library / 'arm.py').write_text(DEADLOCK)
    commit(library, 'start')
    local = ('-c', 'protocol.file.allow=always')
    git(scene.folder, *local, 'submodule', 'add', '--quiet', str(library), 'module')
    commit(scene.folder, 'use')
    scene.write('node.py', f'# once more\n{DEADLOCK}')
    commit(scene.folder, 'once more')


def alternate(scene: Scene) -> None:
    other = scene.folder.parent / 'other'
    shutil.copytree(scene.folder / '.git' / 'objects', other / '.git' / 'objects')
    scene.write('.git/objects/info/alternates', f'{other}/.git/objects\n')
    scene.configure('[core]', 'alternateRefsCommand = PROGRAM')


def embedded(scene: Scene) -> None:
    """What a commit can hold: a folder that is a repository without a work tree around it."""
    inner = scene.folder / 'docs'
    shutil.copytree(scene.folder / '.git', inner, ignore=shutil.ignore_patterns('index'))
    with (inner / 'config').open('a') as stream:
        stream.write(f'[core]\nbare = false\nworktree = ..\nfsmonitor = {scene.program}\n')
    shutil.copy(scene.folder / '.git' / 'index', inner / 'index')


def elsewhere(scene: Scene) -> None:
    scene.configure('[core]', 'fsmonitor = PROGRAM', f'worktree = {scene.folder}')
    moved = scene.folder.parent / 'moved.git'
    (scene.folder / '.git').rename(moved)
    (scene.folder / '.git').write_text(f'gitdir: {moved}\n')


def programs_of_git(scene: Scene) -> None:
    scene.lack_the_base('ext::sh -c true')
    folder = scene.folder.parent / 'programs'
    folder.mkdir()
    for name in ('git', 'git-fetch', 'git-remote-ext', 'git-remote-https', 'git-ls-tree'):
        shutil.copy(scene.program, folder / name)


def git_in_the_folder(scene: Scene) -> None:
    shutil.copy(scene.program, scene.folder / 'git')


def nothing(scene: Scene) -> None:
    """Only the environment differs."""


def signed(scene: Scene) -> None:
    scene.configure('[gpg]', 'program = PROGRAM', '[log]', 'showSignature = true')
    head = git(scene.folder, 'cat-file', 'commit', 'HEAD').stdout
    at = head.index('\n\n')
    text = f'{head[:at]}\ngpgsig -----BEGIN PGP SIGNATURE-----\n \n -----END PGP SIGNATURE-----'
    scene.write('.git/signed', text + head[at:])
    made = git(scene.folder, 'hash-object', '-t', 'commit', '-w', '.git/signed').stdout.strip()
    git(scene.folder, 'update-ref', 'refs/heads/main', made)


LAZY = 'is not in this clone|promisor remote|transport|not allowed'
STATUS, ARCHIVE, DIFF = ('status',), ('archive', 'HEAD'), ('diff', 'HEAD~1')
FETCH = ('fetch', 'origin')
REF = ('update-ref', 'refs/heads/new', 'HEAD')
READ = ('cat-file', '-p', 'HEAD~1:node.py')
WITH_EXT = ('[protocol "ext"]', 'allow = always', '[protocol]', 'allow = always')

ATTACKS: dict[str, Attack] = {
    'core.fsmonitor': Attack(settings('[core]', 'fsmonitor = PROGRAM'), STATUS),
    'core.hooksPath': Attack(hooks_elsewhere, REF),
    'hooks': Attack(lambda scene: scene.fill_hooks(scene.folder / '.git' / 'hooks'), REF),
    'filter.smudge': Attack(
        settings('[filter "x"]', 'smudge = PROGRAM', attributes=True), ('checkout', 'HEAD~1')
    ),
    'filter.smudge, .gitattributes': Attack(committed_attributes, ARCHIVE),
    'filter.smudge, core.attributesFile': Attack(attributes_elsewhere, ARCHIVE),
    'filter.clean': Attack(
        settings('[filter "x"]', 'clean = PROGRAM', attributes=True),
        ('add', '--renormalize', 'node.py'),
    ),
    'filter.process': Attack(
        settings('[filter "x"]', 'process = PROGRAM', 'required = true', attributes=True), ARCHIVE
    ),
    'tar.command': Attack(
        settings('[tar "x"]', 'command = PROGRAM'), ('archive', '--format=x', 'HEAD')
    ),
    'diff.external': Attack(settings('[diff]', 'external = PROGRAM'), DIFF),
    'diff.command': Attack(settings('[diff "x"]', 'command = PROGRAM', attributes=True), DIFF),
    'diff.textconv': Attack(settings('[diff "x"]', 'textconv = PROGRAM', attributes=True), DIFF),
    'merge.driver': Attack(settings('[merge "x"]', 'driver = PROGRAM', attributes=True)),
    'core.pager': Attack(settings('[core]', 'pager = PROGRAM')),
    'pager.command': Attack(
        settings('[pager]', *(f'{name} = PROGRAM' for name in ('ls-tree', 'rev-parse')))
    ),
    'alias': Attack(
        settings(
            '[alias]',
            *(f'{name} = !PROGRAM' for name in ('ls-tree', 'cat-file', 'merge-base', 'status1')),
        ),
        ('status1',),
    ),
    'core.editor': Attack(
        settings('[core]', 'editor = PROGRAM', '[sequence]', 'editor = PROGRAM'),
        ('commit', '--allow-empty'),
    ),
    'gpg.program': Attack(signed, ('log', '-1')),
    'include.path': Attack(included('[include]'), STATUS),
    'includeIf.gitdir': Attack(included('[includeIf "gitdir:TOP/"]'), STATUS),
    'includeIf.onbranch': Attack(included('[includeIf "onbranch:main"]'), STATUS),
    'config.worktree': Attack(settings_of_work_tree, STATUS),
    'lazy fetch, ext': Attack(lacking('ext::PROGRAM', *WITH_EXT), READ, status=2, told=LAZY),
    'lazy fetch, ext, by vcs': Attack(
        lacking('PROGRAM', '[remote "origin"]', 'vcs = ext', *WITH_EXT), READ, status=2, told=LAZY
    ),
    'lazy fetch, ext, by insteadOf': Attack(
        lacking('https://x/y', '[url "ext::PROGRAM "]', 'insteadOf = https://', *WITH_EXT),
        READ,
        status=2,
        told=LAZY,
    ),
    'lazy fetch, core.sshCommand': Attack(
        lacking('ssh://localhost/x', '[core]', 'sshCommand = PROGRAM', *WITH_EXT),
        READ,
        status=2,
        told=LAZY,
    ),
    'lazy fetch, core.gitProxy': Attack(
        lacking('git://localhost/x', '[core]', 'gitProxy = PROGRAM', *WITH_EXT),
        READ,
        status=2,
        told=LAZY,
    ),
    'lazy fetch, remote.uploadpack': Attack(
        lacking('.', '[remote "origin"]', 'uploadpack = PROGRAM', *WITH_EXT),
        READ,
        status=2,
        told=LAZY,
    ),
    'lazy fetch, uploadpack.packObjectsHook': Attack(
        lacking('.', '[uploadpack]', 'packObjectsHook = PROGRAM', *WITH_EXT), status=2, told=LAZY
    ),
    'lazy fetch, credential.helper': Attack(
        lacking(
            'http://127.0.0.1:9/x',
            '[credential]',
            'helper = !PROGRAM',
            '[core]',
            'askPass = PROGRAM',
            *WITH_EXT,
        ),
        status=2,
        told=LAZY,
    ),
    'submodule.update': Attack(submodule_to_update, ('submodule', 'update')),
    'settings of a submodule': Attack(submodule_with_settings, ('-C', 'module', 'status')),
    'core.alternateRefsCommand': Attack(alternate),
    'embedded bare repository': Attack(
        embedded, STATUS, status=2, told='safe.bareRepository|bare repository', below='docs'
    ),
    'gitdir elsewhere': Attack(elsewhere, STATUS),
    'environment: settings': Attack(
        nothing,
        STATUS,
        environment={
            'GIT_CONFIG_COUNT': '1',
            'GIT_CONFIG_KEY_0': 'core.fsmonitor',
            'GIT_CONFIG_VALUE_0': 'PROGRAM',
        },
    ),
    'environment: programs': Attack(
        lacking('ssh://localhost/x'),
        READ,
        status=2,
        told=LAZY,
        environment=dict.fromkeys(
            (
                'GIT_ASKPASS',
                'GIT_EDITOR',
                'GIT_EXTERNAL_DIFF',
                'GIT_PAGER',
                'GIT_PROXY_COMMAND',
                'GIT_SSH',
                'GIT_SSH_COMMAND',
                'SSH_ASKPASS',
            ),
            'PROGRAM',
        ),
    ),
    'environment: where programs of git are': Attack(
        programs_of_git,
        status=2,
        told=LAZY,
        environment={'GIT_EXEC_PATH': 'PARENT/programs', 'GIT_ALLOW_PROTOCOL': 'ext'},
    ),
    'git in the folder': Attack(
        git_in_the_folder, environment={'PATH': os.pathsep.join(['', '.', os.environ['PATH']])}
    ),
}
