"""Starts the node and what it meets, in processes of their own, and ends them."""

from __future__ import annotations

import contextlib
import fcntl
import functools
import json
import os
import random
import signal
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import IO

from ros2cc_extract.confirm.schedules import Schedule
from ros2cc_extract.errors import InputError, ToolNotFoundError
from ros2cc_extract.extract.live.environment import hooked_environment
from ros2cc_extract.extract.live.steering.plan import STUBS_VARIABLE, VARIABLE
from ros2cc_extract.extract.live.steering.stand_ins.stubs import VALUES_VARIABLE
from ros2cc_extract.light_dataclasses import dataclass

_SCRIPTS = Path(__file__).resolve().parents[1] / 'extract' / 'live' / 'steering'
# The ports of domains up to 101 stay below Linux' ephemeral ports.
_DOMAINS = range(1, 102)
_MOST_DOMAIN = 232
READY, REPORT = 'ready', 'report'
DOMAINS_VARIABLE = 'ROS2CC_DOMAINS'
"""Domains that may be used, as `10-39`."""
_MOST_LOG_BYTES = 4_000_000
_VERSION = """
from importlib import metadata
import rclpy
for name in ('ros-rclpy', 'rclpy'):
    try:
        print(metadata.version(name))
        break
    except metadata.PackageNotFoundError:
        pass
"""


@dataclass(frozen=True)
class Node:
    """
    A node that was started.

    :param report: what the steering inside it writes.
    :param log: what it says itself.
    """

    process: subprocess.Popen[bytes]
    report: Path
    log: Path

    @property
    def said(self) -> str:
        """The end of what it has said."""
        return self.log.read_bytes()[-_MOST_LOG_BYTES:].decode(errors='replace')


def release_of(python: str) -> str | None:
    """
    Return the version of rclpy that an interpreter has, `None` if it does not say.

    :raises ToolNotFoundError: if it has no rclpy, or is no interpreter.
    """
    mend = 'source the workspace of ROS, or name an interpreter with --python'
    try:
        found = subprocess.run(
            [python, '-c', _VERSION], capture_output=True, text=True, timeout=60
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise ToolNotFoundError(f'{python} cannot be started: {error}', None, mend) from error
    if found.returncode:
        raise ToolNotFoundError(f'{python} cannot import rclpy', None, mend)
    return found.stdout.strip() or None


@dataclass(frozen=True)
class Stimulus:
    """
    What is sent to a node; fields as of a ``Schedule``.

    :param is_sent: whether anything is.
    """

    values: Sequence[str | int | float] = ()
    at_once: int = 1
    defaults: bool = True
    filled: bool = True
    is_sent: bool = True


@contextmanager
def started(schedule: Schedule, python: str, *, stubs: bool = False) -> Iterator[Node]:
    """
    Start the program of a schedule beside its stimulus; both are killed in the end.

    :raises InputError, ToolNotFoundError: as ``started_beside``.
    """
    command = [python, str(_SCRIPTS / 'launch.py'), schedule.entry]
    command += [schedule.function] if schedule.function else []
    stimulus = Stimulus(
        schedule.values, schedule.at_once, defaults=schedule.defaults, filled=schedule.filled
    )
    with started_beside(
        command, {VARIABLE: functools.partial(_plan, schedule)}, stimulus, python, stubs=stubs
    ) as node:
        yield node


@contextmanager
def started_beside(
    command: Sequence[str],
    plan: Mapping[str, Callable[[Path], str]],
    stimulus: Stimulus,
    python: str,
    *,
    stubs: bool = False,
) -> Iterator[Node]:
    """
    Start a command, hooked, beside a stimulus; both are killed in the end.

    They see a domain of their own, and nothing beyond this machine.

    :param plan: the variable that names the plan of the hook, and what gives its text for a folder
        with the files `report` and, once the stimulus is there, ``READY``.
    :param python: runs the stimulus.
    :raises InputError: when all domains are in use.
    :raises ToolNotFoundError: when they cannot be started.
    """
    with tempfile.TemporaryDirectory(prefix='ros2cc-confirm-') as name, _domain() as domain:
        folder = Path(name)
        (folder / 'recordings').mkdir()
        (folder / REPORT).touch()
        plain = {
            **{key: value for key, value in os.environ.items() if key != 'ROS_LOCALHOST_ONLY'},
            'ROS_DOMAIN_ID': str(domain),
            'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
            'ROS_LOG_DIR': str(folder / 'log'),
            'PYTHONUNBUFFERED': '1',
            'PYTHONDONTWRITEBYTECODE': '1',
        }
        hooked = hooked_environment(plain, folder / 'recordings')
        for variable, text in plan.items():
            (folder / 'plan').write_text(text(folder), encoding='utf-8')
            hooked[variable] = str(folder / 'plan')
        hooked[STUBS_VARIABLE] = '1' if stubs else '0'
        hooked[VALUES_VARIABLE] = json.dumps(stimulus.values)
        sends = [python, str(_SCRIPTS / 'stimulus.py'), str(folder / READY)]
        sends += [json.dumps(stimulus.values), str(stimulus.at_once)]
        sends += ['1' if each else '0' for each in (stimulus.defaults, stimulus.filled)]
        with ExitStack() as stack:
            said = stack.enter_context((folder / 'said').open('wb'))
            if stimulus.is_sent:
                stack.enter_context(_running(sends, plain, subprocess.DEVNULL))
            process = stack.enter_context(_running(command, hooked, said))
            yield Node(process, folder / REPORT, folder / 'said')


def _plan(schedule: Schedule, folder: Path) -> str:
    row = {
        'report': str(folder / REPORT),
        'surroundings': str(folder / READY),
        'points': [asdict(each) for each in schedule.points],
        'race': None if schedule.race is None else asdict(schedule.race),
        'destroys': schedule.destroys,
        'inside': schedule.runs_inside,
        'held': [asdict(each) for each in schedule.held],
    }
    return json.dumps(row)


@contextmanager
def _running(
    command: Sequence[str], environment: Mapping[str, str], output: IO[bytes] | int
) -> Iterator[subprocess.Popen[bytes]]:
    try:
        process = subprocess.Popen(
            command,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
    except OSError as error:
        raise ToolNotFoundError(f'{command[0]} cannot be started: {error.strerror}') from error
    try:
        yield process
    finally:
        # Its session is its own: all that it has started ends with it.
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()


@contextmanager
def _domain() -> Iterator[int]:
    """Hold a domain that no other run of ours on this machine has, nor the user."""
    own = os.environ.get('ROS_DOMAIN_ID')
    domains = _domains()
    for number in random.sample(domains, len(domains)):
        path = Path(tempfile.gettempdir()) / f'ros2cc-confirm-{os.getuid()}-{number}.lock'
        with _held(path) as is_ours:
            if is_ours and str(number) != own:
                yield number
                return
    raise InputError('all domains of ROS are in use')


@contextmanager
def _held(path: Path) -> Iterator[bool]:
    """
    Hold a file against other runs of ours, and remove it in the end.

    It lies where every user may put one: no link is followed, nothing is written to it, and one
    that cannot be had counts as held.
    """
    flags = os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC | os.O_NONBLOCK
    try:
        descriptor = os.open(path, flags, 0o600)
    except OSError:
        yield False
        return
    try:
        # Its last holder may have removed it meanwhile, and the next one has another.
        is_ours = _is_locked(descriptor) and _is_at(descriptor, path)
        try:
            yield is_ours
        finally:
            if is_ours:
                with contextlib.suppress(OSError):
                    path.unlink()
    finally:
        os.close(descriptor)


def _is_locked(descriptor: int) -> bool:
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def _is_at(descriptor: int, path: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(descriptor), path.lstat())
    except OSError:
        return False


def _domains() -> range:
    text = os.environ.get(DOMAINS_VARIABLE)
    if not text:
        return _DOMAINS
    first, _, last = text.partition('-')
    if not (first.isdecimal() and last.isdecimal() and int(first) <= int(last) <= _MOST_DOMAIN):
        what = f'{DOMAINS_VARIABLE}={text!r} names no domains'
        raise InputError(what, None, f'write 10-39; the highest is {_MOST_DOMAIN}')
    return range(int(first), int(last) + 1)
