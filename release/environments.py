"""Virtual environments of any CPython, with pip, and what runs in them for long."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

QUIET = ('--quiet', '--disable-pip-version-check')


def made(python: Path, folder: Path) -> Path:
    """Make an environment and give its Python; Debian leaves ``ensurepip`` to another package."""
    has_pip = not subprocess.run(
        [python, '-c', 'import ensurepip'], capture_output=True
    ).returncode
    subprocess.run(
        [python, '-m', 'venv', *([] if has_pip else ['--without-pip']), folder], check=True
    )
    own = folder / 'bin/python'
    if not has_pip:
        pip = [sys.executable, '-m', 'pip']
        where = ['--no-deps', '-d', folder]
        subprocess.run([*pip, 'download', *QUIET, *where, 'pip'], check=True)
        (wheel,) = folder.glob('pip-*.whl')
        # A wheel of pip runs as it is, and installs itself.
        subprocess.run([own, wheel / 'pip', 'install', *QUIET, '--no-index', wheel], check=True)
    return own


def watched(
    command: Sequence[str | Path], output: Path, cwd: Path, env: Mapping[str, str] | None = None
) -> tuple[bool, str]:
    """
    Run what takes long, and give whether it succeeded and its last line.

    All that it says is in ``output`` at once: a run that is cut, or ends with this process, is not
    lost, and one that goes on can be looked at.
    """
    with output.open('w', encoding='utf-8') as told:
        done = subprocess.run(command, cwd=cwd, env=env, stdout=told, stderr=subprocess.STDOUT)
    lines = output.read_text(encoding='utf-8', errors='replace').strip().splitlines()
    return done.returncode == 0, f'{lines[-1] if lines else "no output"}; see {output}'
