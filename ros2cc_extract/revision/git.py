"""
Ask git what an untrusted repository holds.

Settings of the repository may name programs to be run. None of them is: only commands that
look up objects are used, what they could start all the same is switched off, and nothing is
fetched, so that no transport, helper or hook is ever reached.
"""

from __future__ import annotations

import os
import re
import select
import selectors
import subprocess
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import IO

from ros2cc_extract.errors import InputError, ToolNotFoundError
from ros2cc_extract.jobs.process_pool import ends_with_us
from ros2cc_extract.light_dataclasses import dataclass

KNOWN = 'name a revision git knows'
PATIENCE_S = 300.0
"""git itself waits without end, such as for a FIFO that its settings include."""
MOST_BYTES = 400_000_000

_SETTINGS = (
    'core.alternateRefsCommand=',
    'core.attributesFile=/dev/null',
    'core.fsmonitor=false',
    'core.gitProxy=',
    'core.hooksPath=/dev/null',
    'core.pager=cat',
    'core.sshCommand=false',
    'credential.helper=',
    'fetch.recurseSubmodules=false',
    'gc.auto=0',
    'maintenance.auto=false',
    'protocol.allow=never',
    'protocol.ext.allow=never',
    'safe.bareRepository=explicit',
    'submodule.recurse=false',
)
_VARIABLES = {
    'GIT_ALLOW_PROTOCOL': 'none',  # goes before every setting of protocol.*
    'GIT_ATTR_NOSYSTEM': '1',
    'GIT_GRAFT_FILE': os.devnull,
    'GIT_NO_LAZY_FETCH': '1',
    'GIT_NO_REPLACE_OBJECTS': '1',
    'GIT_OPTIONAL_LOCKS': '0',
    'GIT_PAGER': 'cat',
    'GIT_TERMINAL_PROMPT': '0',
    'LC_ALL': 'C',
}
_SETTING_VARIABLE = re.compile(
    r'GIT_(CONFIG_(GLOBAL|SYSTEM|NOSYSTEM|PARAMETERS|COUNT|(KEY|VALUE)_\d+)'
    r'|CEILING_DIRECTORIES|DISCOVERY_ACROSS_FILESYSTEM|TEST_ASSUME_DIFFERENT_OWNER)'
)
_REPOSITORY_VARIABLE = re.compile(
    r'GIT_(DIR|WORK_TREE|COMMON_DIR|OBJECT_DIRECTORY|ALTERNATE_OBJECT_DIRECTORIES|NAMESPACE'
    r'|QUARANTINE_PATH)'
)
_PIECE_BYTES = 1 << 16


@dataclass(frozen=True)
class Answer:
    """What a call of git said."""

    status: int
    out: bytes
    said: str


@dataclass(frozen=True)
class Repository:
    """
    A repository, asked from a folder in it.

    :param is_named: environment variables such as ``GIT_DIR`` name it, as inside of a hook;
        otherwise it is the one that the folder is in.
    """

    folder: Path
    is_named: bool = False

    def ask(self, *arguments: str, given: bytes = b'') -> bytes:
        """
        Give what a call prints.

        :raises InputError: with git's own reason, when it fails.
        """
        answer = self.try_to_ask(*arguments, given=given)
        if answer.status:
            said = answer.said.strip().splitlines() or ['no reason given']
            reason = next((line for line in said if line.startswith('fatal: ')), said[-1])
            raise InputError(f'git {arguments[0]}: {reason}', None, _advice(said))
        return answer.out

    def try_to_ask(self, *arguments: str, given: bytes = b'') -> Answer:
        """
        Call git; whether it worked is for the caller to see.

        :raises ToolNotFoundError: when there is no git.
        """
        settings = [word for setting in _SETTINGS for word in ('-c', setting)]
        command = [_program(), '--no-pager', *settings, *arguments]
        try:
            process = subprocess.Popen(
                command,
                cwd=self.folder,
                env=_environment(os.environ, self.is_named),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                preexec_fn=ends_with_us(),
            )
        except OSError as error:
            raise ToolNotFoundError(f'git cannot be started: {error.strerror}') from None
        with process:
            try:
                out, said = _talk(process, given, f'git {arguments[0]}')
            except BaseException:
                process.kill()
                raise
        return Answer(process.returncode, out, said.decode('utf-8', 'replace'))


def _program() -> str:
    """git by its absolute path: one that lies about in the current folder is not meant."""
    for folder in os.environ.get('PATH', os.defpath).split(os.pathsep):
        candidate = Path(folder, 'git')
        if candidate.is_absolute() and os.access(candidate, os.X_OK) and not candidate.is_dir():
            return str(candidate)
    raise ToolNotFoundError('git cannot be started: No such file or directory')


def _environment(given: Mapping[str, str], is_named: bool) -> dict[str, str]:
    """Of git's own variables those that say which repository and whose settings are meant."""
    kept = {
        name: value
        for name, value in given.items()
        if not name.startswith(('GIT_', 'SSH_ASKPASS'))
        or _SETTING_VARIABLE.fullmatch(name)
        or (is_named and _REPOSITORY_VARIABLE.fullmatch(name))
    }
    return {**kept, **_VARIABLES}


def _talk(process: subprocess.Popen[bytes], given: bytes, title: str) -> tuple[bytes, bytes]:
    """
    As ``Popen.communicate``, up to a size.

    :raises InputError: when it takes too long, or says too much.
    """
    assert process.stdin and process.stdout and process.stderr
    ends_at = time.monotonic() + PATIENCE_S
    out: dict[IO[bytes], list[bytes]] = {process.stdout: [], process.stderr: []}
    size, left = 0, memoryview(given)
    with selectors.DefaultSelector() as selector:
        for stream in out:
            selector.register(stream, selectors.EVENT_READ)
        selector.register(process.stdin, selectors.EVENT_WRITE)
        while selector.get_map():
            ready = selector.select(max(ends_at - time.monotonic(), 0))
            if not ready:
                raise InputError(f'{title} takes longer than {PATIENCE_S:g} s', None, KNOWN)
            for key, _ in ready:
                if key.fileobj is process.stdin:
                    left = _write(process.stdin, left)
                    if not left:
                        selector.unregister(process.stdin)
                        _close(process.stdin)
                    continue
                piece = os.read(key.fd, _PIECE_BYTES)
                size += len(piece)
                if not piece:
                    selector.unregister(key.fileobj)
                elif size > MOST_BYTES:
                    raise InputError(f'{title} gives more than {MOST_BYTES:,} bytes', None, KNOWN)
                out[key.fileobj].append(piece)  # type: ignore[index]
    return b''.join(out[process.stdout]), b''.join(out[process.stderr])


def _write(stream: IO[bytes], left: memoryview) -> memoryview:
    """Write what a pipe that is ready takes at once; gives the rest."""
    try:
        return left[os.write(stream.fileno(), left[: select.PIPE_BUF]) :] if left else left
    except BrokenPipeError:  # why, it says on its other streams
        return memoryview(b'')


def _close(stream: IO[bytes]) -> None:
    try:
        stream.close()
    except BrokenPipeError:
        return


def _advice(said: Sequence[str]) -> str:
    if 'safe.directory' in said[-1]:
        return said[-1].strip()
    if any('promisor remote' in line or 'transport' in line for line in said):
        return NOT_WHOLE
    return KNOWN


NOT_WHOLE = 'nothing is fetched on the way: take a clone without --filter'


def objects(
    repository: Repository, names: Sequence[str], most_bytes: int
) -> Iterator[bytes | int]:
    """
    Read blobs in the order of their names; of a larger one only its size is returned.

    :raises InputError: when one is not there.
    """
    given = ''.join(f'{name}\n' for name in names).encode()
    listing = repository.ask('cat-file', '--batch-check', given=given).decode().splitlines()
    sizes = [_size(line) for line in listing]
    if sum(size for size in sizes if size <= most_bytes) > MOST_BYTES:
        raise InputError(f'the revision has more than {MOST_BYTES:,} bytes to read', None, '')
    small = [name for name, size in zip(names, sizes, strict=True) if size <= most_bytes]
    out = repository.ask('cat-file', '--batch', given=''.join(f'{n}\n' for n in small).encode())
    at = 0
    for size in sizes:
        if size > most_bytes:
            yield size
            continue
        at = out.index(b'\n', at) + 1
        yield out[at : at + size]
        at += size + 1


def _size(line: str) -> int:
    """The size of an object, from a line of ``cat-file --batch-check``."""
    name, _, size = line.rpartition(' ')
    if not size.isdecimal():
        raise InputError(f'git cat-file: {name or size} is not in this clone', None, NOT_WHOLE)
    return int(size)
