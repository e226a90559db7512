"""The environment variables by which processes are hooked without a change to their code."""

from __future__ import annotations

import os
import shlex
from collections.abc import Mapping
from pathlib import Path

from ros2cc_extract.extract.live.hook.diagnostics import VARIABLE as DIAGNOSTICS_VARIABLE
from ros2cc_extract.extract.live.hook.watch import VARIABLE as WATCH_VARIABLE
from ros2cc_extract.extract.live.hook.wrapping import OUTPUT_VARIABLE, TRACE_VARIABLE

BOOTSTRAP = Path(__file__).resolve().parent / 'bootstrap'


def publishing(environment: Mapping[str, str]) -> dict[str, str]:
    """Give ``environment`` with what makes watched processes publish on ``/diagnostics``."""
    return {**environment, DIAGNOSTICS_VARIABLE: '1'}


def hooked_environment(
    environment: Mapping[str, str],
    directory: Path,
    *,
    traced: bool = False,
    limit_s: float | None = None,
) -> dict[str, str]:
    """
    Give ``environment`` with what makes every Python process below it record itself.

    :param directory: exists; each process writes a file of its own into it.
    :param limit_s: explain what has not ended for so long; by default as the environment says.
    """
    before = environment.get('PYTHONPATH', '')
    # An empty entry would mean the current directory, so none is added.
    paths = [str(BOOTSTRAP), *(path for path in before.split(os.pathsep) if path)]
    return {
        **environment,
        'PYTHONPATH': os.pathsep.join(paths),
        OUTPUT_VARIABLE: str(directory.resolve()),
        TRACE_VARIABLE: '1' if traced else '0',
        **({} if limit_s is None else {WATCH_VARIABLE: f'{limit_s:g}'}),
    }


def shell_commands(
    environment: Mapping[str, str],
    directory: Path,
    *,
    traced: bool = False,
    limit_s: float | None = None,
) -> str:
    """Give the commands that set these variables in a POSIX shell."""
    hooked = hooked_environment(environment, directory, traced=traced, limit_s=limit_s)
    names = ('PYTHONPATH', OUTPUT_VARIABLE, TRACE_VARIABLE, WATCH_VARIABLE, DIAGNOSTICS_VARIABLE)
    set_ = (name for name in names if name in hooked)
    return ''.join(f'export {name}={shlex.quote(hooked[name])}\n' for name in set_)
