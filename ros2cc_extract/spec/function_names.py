"""Names of functions as the file that defines them has them."""

from __future__ import annotations

from pathlib import PurePosixPath

from ros2cc_extract.source_locations import Place


def name_in_module(function: str | None, defined: Place | None) -> str | None:
    """
    Give ``Arm.on_goal`` for ``robot.arm.Arm.on_goal`` of ``robot/arm.py``: as its file has it.

    Where the file is unknown, the last part alone; of a function in a function, what is inside.
    """
    if not function:
        return None
    parts = function.rpartition('<locals>.')[2].split('.')
    if '<locals>' in function or len(parts) == 1:
        return parts[-1]
    if parts[0] == '__main__':
        return '.'.join(parts[1:])
    if defined is None:
        return parts[-1]
    module = PurePosixPath(defined.file).with_suffix('').parts
    package = module[:-1] if module[-1:] == ('__init__',) else module
    known = range(len(parts) - 1, 0, -1)
    own = next((n for n in known if tuple(parts[:n]) == package[-n:]), len(parts) - 1)
    return '.'.join(parts[own:])
