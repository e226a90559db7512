"""The environment variables by which processes are hooked without a change to their code."""

from __future__ import annotations

import os
import shlex
from collections.abc import Mapping
from pathlib import Path

from ros2cc_extract.extract.live.hook.wrapping import OUTPUT_VARIABLE, TRACE_VARIABLE

BOOTSTRAP = Path(__file__).resolve().parent / 'bootstrap'


def hooked_environment(
    environment: Mapping[str, str], directory: Path, *, traced: bool = False
) -> dict[str, str]:
    """
    Give ``environment`` with what makes every Python process below it record itself.

    :param directory: exists; each process writes a file of its own into it.
    """
    before = environment.get('PYTHONPATH', '')
    # An empty entry would mean the current directory, so none is added.
    paths = [str(BOOTSTRAP), *(path for path in before.split(os.pathsep) if path)]
    return {
        **environment,
        'PYTHONPATH': os.pathsep.join(paths),
        OUTPUT_VARIABLE: str(directory.resolve()),
        TRACE_VARIABLE: '1' if traced else '0',
    }


def shell_commands(
    environment: Mapping[str, str], directory: Path, *, traced: bool = False
) -> str:
    """Give the commands that set these variables in a POSIX shell."""
    hooked = hooked_environment(environment, directory, traced=traced)
    names = ('PYTHONPATH', OUTPUT_VARIABLE, TRACE_VARIABLE)
    return ''.join(f'export {name}={shlex.quote(hooked[name])}\n' for name in names)
