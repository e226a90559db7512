"""Which files are launch files; asked of every path, so it loads nothing else of launch files."""

from __future__ import annotations

from pathlib import Path

from ros2cc_extract.files import Files

XML, YAML = '.xml', ('.yaml', '.yml')
SUFFIXES = ('.launch.py', '_launch.py', '.launch.xml', '_launch.xml', '.launch.yaml')
_MORE_SUFFIXES = ('_launch.yaml', '.launch.yml', '_launch.yml', '.launch')
_MARKS = (b'generate_launch_description', b'<launch', b'launch:')


def is_launch_file(path: Path, files: Files) -> bool:
    """Whether a path is a launch file, by its name or, below a folder ``launch``, by its text."""
    if path.name.endswith((*SUFFIXES, *_MORE_SUFFIXES)):
        return files.is_file(path)
    is_likely = path.suffix in ('.py', XML, *YAML) and path.parent.name == 'launch'
    if not is_likely or not files.is_file(path):
        return False
    try:
        data = files.read(path, 1_000_000)
    except OSError:
        return False
    return any(mark in data for mark in _MARKS)
