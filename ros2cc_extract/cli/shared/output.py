"""Files are written whole or not at all."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import TextIO

from ros2cc_extract.cli.shared.streams import ESCAPED
from ros2cc_extract.errors import InputError
from ros2cc_extract.source_locations import Place


def write_text(text: str, path: Path | None, stdout: TextIO) -> None:
    """Write to ``path`` whole or not at all; without a path to ``stdout``."""
    if path is None:
        stdout.write(text)
    else:
        write_atomically(path, text)


def make_folder(path: Path) -> None:
    """
    Make a folder with its parents.

    :raises InputError: when that is not possible.
    """
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise _refused(path, error) from None


def write_atomically(path: Path, text: str) -> None:
    """
    Write ``text`` under a temporary name beside ``path`` and rename it.

    :raises InputError: when the folder cannot be made or written; nothing is left behind then.
    """
    make_folder(path.parent)
    try:
        descriptor, name = tempfile.mkstemp(dir=path.parent, prefix=f'.{path.name}.')
    except OSError as error:
        raise _refused(path, error) from None
    temporary = Path(name)
    try:
        with os.fdopen(descriptor, 'w', encoding='utf-8', errors=ESCAPED) as stream:
            stream.write(text)
        temporary.chmod(0o666 & ~_umask())
        temporary.replace(path)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        raise _refused(path, error) from None
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def _refused(path: Path, error: OSError) -> InputError:
    return InputError(
        f'cannot be written: {error.strerror or error}', Place(str(path)), 'choose another -o'
    )


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
