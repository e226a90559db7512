"""Virtual environments of any CPython, with pip."""

from __future__ import annotations

import subprocess
import sys
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
