"""Says once, before a command runs, that a native part is not there, and what that costs."""

from __future__ import annotations

import argparse
import importlib
import os
from collections.abc import Iterator
from typing import TextIO

MEND = (
    'install a wheel for this Python, or a C++ compiler and Python.h and this package again '
    '(docs/install.md)'
)
CORE = 'ros2cc_extract.checker._core'
JOURNAL = 'ros2cc_extract.extract.live._journal'
PARTS = {
    CORE: (
        'the native core of the checker',
        'a check takes some twenty times as long, and large units stay undecided',
    ),
    JOURNAL: (
        'the native journal of the hook',
        'each step of an observed process costs two to three times as much',
    ),
}
"""Of each native part what it is, and what it costs to do without."""
HOOKS = {'run', 'env', 'attach'}
"""Commands that put the hook into a process."""


def report_missing_parts(name: str, args: argparse.Namespace, stderr: TextIO) -> None:
    """Report missing parts that ``name`` would use, unless plain Python was asked for."""
    for module in _used(name, args):
        fault = _fault_of(module)
        if fault:
            part, cost = PARTS[module]
            words = f'{part} is not built, or does not load here ({fault}): {cost}; {MEND}'
            print(f'ros2cc-extract: note: {words}', file=stderr)


def _fault_of(module: str) -> str:
    try:
        importlib.import_module(module)
    except ImportError as error:
        return str(error)
    if module == JOURNAL:
        from ros2cc_extract.extract.live.recorder import journal

        # Used in place, what was built of an older text stays where it is.
        if journal.native is None:
            return 'it was built of an older text'
    return ''


def _used(name: str, args: argparse.Namespace) -> Iterator[str]:
    if getattr(args, 'engine', '') == 'auto':
        yield CORE
    # As extract/live/recorder/journal.py reads it, which is not imported for that.
    if name in HOOKS and os.environ.get('ROS2CC_LIVE_NATIVE') != '0':
        yield JOURNAL
