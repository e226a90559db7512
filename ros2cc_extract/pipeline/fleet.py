"""
Many repositories, each checked on its own, within one budget of time.

A result names what it was made from. Where that has not changed, the result stands, so that a
fleet goes on where it was cut.
"""

from __future__ import annotations

import hashlib
import io
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from enum import Enum
from pathlib import Path
from time import monotonic
from typing import Any

from ros2cc_extract.cache_file import tool_version
from ros2cc_extract.deadline import Deadline
from ros2cc_extract.errors import InputError, Ros2ccError
from ros2cc_extract.extract.static.program.project import python_files
from ros2cc_extract.extract.static.program.source import SIZE_LIMIT_BYTES
from ros2cc_extract.files import DISK, read_regular
from ros2cc_extract.json_text import read_json
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.pipeline.check import Job, Outcome, check_paths
from ros2cc_extract.revision.git import Repository as GitRepository

KEY = 'origin'
LONGEST_ERROR = 200
_SETTINGS = ('package.xml', 'setup.cfg', 'pyproject.toml')
"""What a scan reads of a folder beside its Python files."""
Reporter = Callable[[Job, Outcome, Mapping[str, Any]], str]


@dataclass(frozen=True)
class Repository:
    """A folder to check, and the name of its result."""

    name: str
    folder: Path


class State(Enum):
    """What has come of a repository."""

    CHECKED = 'checked'
    UNCHANGED = 'unchanged'
    CUT = 'cut'
    FAILED = 'failed'
    LEFT = 'not reached'


@dataclass(frozen=True)
class Result:
    """
    What is known of a repository.

    :param summary: of its check, as the last line counts.
    :param text: its report; empty where there is no new one.
    :param error: why it could not be checked.
    """

    repository: Repository
    state: State
    summary: Mapping[str, int] = field(default_factory=dict)
    text: str = ''
    error: str = ''

    @property
    def found(self) -> Counter[str]:
        """Its counts, 0 where it has none."""
        return Counter(self.summary)


def repositories(folders: Sequence[Path]) -> list[Repository]:
    """
    Name each folder by as few of its last parts as distinguish it from the others.

    :raises InputError: when one is no folder, or is given twice.
    """
    whole = [folder.resolve() for folder in folders]
    for folder, path in zip(folders, whole, strict=True):
        if not path.is_dir():
            raise InputError(f'{folder} is no folder', None, 'name the folders of repositories')
        if whole.count(path) > 1:
            raise InputError(f'{folder} is given twice', None, 'name each repository once')
    return [
        Repository(_name(path, whole), folder) for folder, path in zip(folders, whole, strict=True)
    ]


def _name(path: Path, others: Sequence[Path]) -> str:
    parts = path.parts
    for length in range(1, len(parts)):
        tail = parts[-length:]
        if sum(other.parts[-length:] == tail for other in others) == 1:
            return '+'.join(tail)
    return '+'.join(parts[1:]) or 'root'


def origin_of(repository: Repository, job: Job) -> dict[str, Any]:
    """Say what a result is made from; modules that stand beside the folder are not looked at."""
    asked = (job.config, job.policy, job.options, job.assumptions)
    where = (Path.cwd(), repository.folder)
    digest = hashlib.sha256(f'{tool_version()}\0{where!r}\0{asked!r}'.encode())
    for path in _read_files(repository.folder):
        try:
            content = read_regular(path, SIZE_LIMIT_BYTES)
        except OSError:  # the scan reports it
            content = b''
        name = str(path).encode('utf-8', 'surrogatepass')
        digest.update(b'%d %d ' % (len(name), len(content)) + name + content)
    return {
        'folder': str(repository.folder),
        'revision': _revision(repository.folder),
        'key': digest.hexdigest(),
    }


def _read_files(folder: Path) -> Iterator[Path]:
    found = list(python_files(DISK, folder, lambda error: None))
    beside = {path.parent / name for path in found for name in _SETTINGS}
    own = {folder / name for name in _SETTINGS}
    yield from sorted({*found, *(path for path in beside | own if path.is_file())})


def _revision(folder: Path) -> str | None:
    """The commit of a clone, for the reader; changes on top of it are in the key."""
    try:
        answer = GitRepository(folder).try_to_ask('rev-parse', 'HEAD')
    except Ros2ccError:
        return None
    return answer.out.decode().strip() if answer.status == 0 else None


def kept_result(repository: Repository, path: Path, origin: Mapping[str, Any]) -> Result | None:
    """The result of an earlier call, where it stands."""
    try:
        data = read_json(path.read_bytes())
        if data[KEY]['key'] == origin['key'] and data[KEY]['complete']:
            counts = {k: n for k, n in data['summary'].items() if isinstance(n, int)}
            return Result(repository, State.UNCHANGED, counts)
    except (OSError, ValueError, TypeError, KeyError, AttributeError):
        pass  # there is none, or another file of that name
    return None


@dataclass(frozen=True)
class Part:
    """One repository to check, with how to."""

    repository: Repository
    job: Job
    origin: Mapping[str, Any]


def check_one(report_of: Reporter, deadline: Deadline, part: Part) -> Result:
    """
    Check one repository; what goes wrong with it does not end the others.

    :param report_of: writes the report.
    :param deadline: of the whole fleet.
    """
    if deadline.is_over:
        return Result(part.repository, State.LEFT)
    left_s = deadline.at - monotonic()
    job = replace(part.job, max_seconds=min(left_s, part.job.max_seconds or left_s))
    try:
        outcome = check_paths(job, io.StringIO())
    except Ros2ccError as error:
        return Result(part.repository, State.FAILED, error=str(error))
    except Exception as error:
        message = ' '.join(f'internal error: {type(error).__name__}: {error}'.split())
        return Result(part.repository, State.FAILED, error=message[:LONGEST_ERROR])
    if outcome.interrupted:
        raise KeyboardInterrupt
    is_cut = deadline.is_over and outcome.is_undecided
    text = report_of(job, outcome, {**part.origin, 'complete': not is_cut})
    state = State.CUT if is_cut else State.CHECKED
    return Result(part.repository, state, outcome.summary, text)
