"""Reading files that may be anything: only regular ones, by descriptor, up to a stated size."""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path


def read_regular(path: Path, most_bytes: int, *, follow: bool = True) -> bytes:
    """
    Read a file whole.

    What is read is what was looked at, since both are done by one descriptor; a FIFO or a device
    is not waited for.

    :param follow: read what a symbolic link leads to.
    :raises OSError: when it cannot be opened, is not a regular file, or is larger.
    """
    flags = os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC | (0 if follow else os.O_NOFOLLOW)
    descriptor = os.open(path, flags)
    with os.fdopen(descriptor, 'rb') as stream:
        if not stat.S_ISREG(os.fstat(descriptor).st_mode):
            raise OSError(errno.EINVAL, 'it is not a regular file', str(path))
        content = stream.read(most_bytes + 1)
    if len(content) > most_bytes:
        raise OSError(errno.EFBIG, f'it is larger than {most_bytes} bytes', str(path))
    return content
