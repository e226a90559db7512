"""
Asks UPPAAL's own ``verifyta``, where it is installed: finds it, runs it, reads its verdicts.

Verdicts are taken from its text; its exit status says nothing dependable. Options used (``verifyta
--help`` of 4.1 and 5.0): ``-u`` figures after each query, ``-s`` no progress, ``-o 0`` breadth
first, ``-t 0`` prints the run behind a verdict. Verdicts go to its standard output, runs and
complaints to its error stream, as programs that read them know (Jack0Chan/PyUPPAAL,
``verifyta.py``; uppaal-emf/uppaal, ``DiagnosticTrace.xtext``).
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain
from pathlib import Path

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.errors import ToolNotFoundError
from ros2cc_extract.jobs.process_pool import ends_with_us
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.verify.uppaal.verifyta_processes import Runs
from ros2cc_extract.verify.uppaal.verifyta_trace import PrintedRun, read_runs

PROGRAM = 'verifyta'
USUAL_FOLDERS = ('/opt', '/usr/local', '/usr/local/share', '~', '~/opt', '~/.local/share')
ARGUMENTS = ('-u', '-s', '-o', '0', '-t', '0')
_TERMINAL_CODE = re.compile(r'\x1b\[[0-9;?]*[A-Za-z]')
_LICENCE = re.compile(r'licen[cs]e|failed to retrieve', re.IGNORECASE)
_VERDICTS = (
    (re.compile(r'(?:Formula|Property) is satisfied'), Verdict.SATISFIED),
    (re.compile(r'(?:Formula|Property) is NOT satisfied'), Verdict.NOT_SATISFIED),
    (re.compile(r'(?:Formula|Property) MAY'), Verdict.UNDECIDED),
)
_SHOWS_RUN = re.compile(r'Showing (?:counter example|example trace)')
_STATES = re.compile(r'States stored\s*:\s*(\d+)')
_MEMORY = re.compile(r'Resident memory used\s*:\s*(\d+) KiB')


class LicenceError(ToolNotFoundError):
    """``verifyta`` is there and refuses to work for want of a licence."""


@dataclass(frozen=True, kw_only=True)
class VerifytaAnswer:
    """
    One verdict.

    :param seconds: of the whole process that gave it.
    :param states: stored states, 0 where it printed none.
    :param peak_mb: resident memory, 0.0 where it printed none.
    :param printed: states of the run that it printed, not replayed yet; empty where it did not.
    """

    verdict: Verdict
    reason: str | None
    seconds: float
    states: int
    peak_mb: float
    printed: PrintedRun = ()


def find_verifyta(given: Path | None = None) -> Path:
    """
    Find the program: as given, in ``UPPAAL_HOME``, on ``PATH``, in the usual folders.

    :raises ToolNotFoundError: naming where it was looked for.
    """
    if given is not None:
        if _is_program(given):
            return given
        raise ToolNotFoundError('is no program', Place(str(given)), 'name verifyta itself')
    for candidate in _candidates():
        if _is_program(candidate):
            return candidate
    raise ToolNotFoundError(
        f'{PROGRAM} not found in UPPAAL_HOME, PATH or {", ".join(USUAL_FOLDERS)}',
        None,
        'install UPPAAL, or leave out --checker: the embedded checker needs nothing',
    )


def _candidates() -> Iterator[Path]:
    home = os.environ.get('UPPAAL_HOME')
    if home:
        yield from _inside(Path(home))
    found = shutil.which(PROGRAM)
    if found:
        yield Path(found)
    for folder in USUAL_FOLDERS:
        parent = Path(os.path.expanduser(folder))  # noqa: PTH111  Path's raises without a home
        installed = chain(parent.glob('uppaal*'), parent.glob('UPPAAL*'))
        for install in sorted(installed, reverse=True):
            yield from _inside(install)


def _inside(install: Path) -> Iterator[Path]:
    for folder in ('bin', 'bin-Linux', 'bin-linux', '.'):
        yield install / folder / PROGRAM


def _is_program(path: Path) -> bool:
    return path.is_file() and os.access(path, os.X_OK)


def run_verifyta(
    program: Path,
    xml: bytes,
    formulas: Sequence[str],
    *,
    runs: Runs = Runs.TOGETHER,
    seconds: float | None = None,
) -> tuple[VerifytaAnswer, ...]:
    """
    Check ``formulas`` on a model.

    :param seconds: limit of the whole call; what is open then is undecided.
    :raises LicenceError: when it asks for a licence.
    :raises ToolNotFoundError: when it gives no verdict, with the last line it printed.
    """
    deadline = None if seconds is None else time.monotonic() + seconds
    with tempfile.TemporaryDirectory(prefix='ros2cc-') as folder:
        model = Path(folder) / 'model.xml'
        model.write_bytes(xml)
        batches = [formulas] if runs is Runs.TOGETHER else [[formula] for formula in formulas]
        return tuple(
            answer for batch in batches for answer in _batch(program, model, batch, deadline)
        )


def _batch(
    program: Path, model: Path, formulas: Sequence[str], deadline: float | None
) -> tuple[VerifytaAnswer, ...]:
    queries = model.with_suffix('.q')
    queries.write_text('\n'.join(formulas) + '\n', encoding='utf-8')
    started = time.monotonic()
    said, complained, in_time = _call(
        [str(program), *ARGUMENTS, str(model), str(queries)], deadline
    )
    seconds = time.monotonic() - started
    answers = read_answers(said, seconds, read_runs(complained) or read_runs(said))
    missing = len(formulas) - len(answers)
    if missing and in_time:
        raise _no_verdict(program, f'{said}\n{complained}')
    late = VerifytaAnswer(
        verdict=Verdict.UNDECIDED, reason='time limit', seconds=seconds, states=0, peak_mb=0.0
    )
    return (*answers, *[late] * missing)


def _call(command: Sequence[str], deadline: float | None) -> tuple[str, str, bool]:
    """Run to the end or the deadline; output, error stream, and whether it ended by itself."""
    left = None if deadline is None else max(0.1, deadline - time.monotonic())
    try:
        done = subprocess.run(
            command,
            stdin=subprocess.DEVNULL,
            preexec_fn=ends_with_us(),
            capture_output=True,
            timeout=left,
            check=False,
        )
    except subprocess.TimeoutExpired as expired:
        return _decoded(expired.stdout), _decoded(expired.stderr), False
    except OSError as error:
        place = Place(command[0])
        raise ToolNotFoundError(f'cannot be started: {error.strerror}', place) from None
    return _decoded(done.stdout), _decoded(done.stderr), True


def _decoded(output: bytes | None) -> str:
    return _TERMINAL_CODE.sub('', (output or b'').decode('utf-8', 'replace'))


def read_answers(
    text: str, seconds: float, runs: Sequence[PrintedRun] = ()
) -> tuple[VerifytaAnswer, ...]:
    """
    Read the verdicts of one call, in the order of its queries, from what it printed.

    :param runs: those it printed, in order; the verdicts say which of them have one. When it
        announced more or fewer, they cannot be assigned and none is kept.
    """
    blocks = re.split(r'Verifying (?:formula|property) \d+', _TERMINAL_CODE.sub('', text))[1:]
    shows = [_SHOWS_RUN.search(block) is not None for block in blocks]
    left = iter(runs if len(runs) == sum(shows) else [()] * len(blocks))
    printed = [next(left) if announced else () for announced in shows]
    answers = (_answer(block, seconds) for block in blocks)
    return tuple(
        replace(answer, printed=run)
        for answer, run in zip(answers, printed, strict=True)
        if answer is not None
    )


def _answer(block: str, seconds: float) -> VerifytaAnswer | None:
    for pattern, verdict in _VERDICTS:
        if pattern.search(block):
            undecided = verdict is Verdict.UNDECIDED
            return VerifytaAnswer(
                verdict=verdict,
                reason='verifyta says it may be satisfied' if undecided else None,
                seconds=seconds,
                states=_figure(_STATES, block),
                peak_mb=_figure(_MEMORY, block) / 1024,
            )
    return None


def _figure(pattern: re.Pattern[str], block: str) -> int:
    match = pattern.search(block)
    return int(match.group(1)) if match else 0


def _no_verdict(program: Path, text: str) -> ToolNotFoundError:
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    if _LICENCE.search(text):
        line = next(line for line in lines if _LICENCE.search(line))
        return LicenceError(
            f'refuses to work without a licence ({line})',
            Place(str(program)),
            'lease it once with `verifyta --lease 168 --key KEY`; the embedded checker needs none',
        )
    said = lines[-1] if lines else 'it printed nothing'
    return ToolNotFoundError(f'gave no verdict: {said}', Place(str(program)))
