"""
Which parameters of a launch reach which nodes.

Source: rcl (Jazzy), ``rcl_yaml_param_parser`` and ``arguments.c``: ``*`` stands for one part of a
name, ``**`` for any number of them; the last value counts.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from ros2cc_extract.spec.system.launched import ANY_NODE, Launched, SetParameter
from ros2cc_extract.spec.system.model import SystemNode

_WILD = re.compile(r'/\*\*|\*')
_SCALARS = (str, int, float, bool)
_OPEN = ('parameters', 'arguments', 'command')


def parameters_for(
    launched: Launched, nodes: Sequence[SystemNode]
) -> tuple[dict[str, object], bool]:
    """
    The values that the code of a process finds, and whether nothing else is set for it.

    :param nodes: of the process; what is set for one of several is left out, since the code is
        followed once for all. Without any, what is set for every node.
    """
    names = [node.name for node in nodes if isinstance(node.name, str)]
    found: dict[str, object] = {}
    are_all = are_all_known(launched)
    for each in launched.parameters:
        reached = [name for name in names if matches(each.node, name)]
        is_for_all = each.node == ANY_NODE or (bool(names) and len(reached) == len(nodes))
        if is_for_all and _is_plain(each.value):
            found[each.name] = each.value
        elif is_for_all or reached or not names:
            found.pop(each.name, None)
            are_all = False
    return found, are_all


def are_all_known(launched: Launched) -> bool:
    """Whether only known parameters may be set."""
    return not any(fact in _OPEN for fact, _ in launched.open)


def set_for(launched: Launched, node: SystemNode) -> dict[str, SetParameter]:
    """What is set for a node, by name: the last value counts."""
    name = node.name if isinstance(node.name, str) else ''
    reached = (p for p in launched.parameters if p.node == ANY_NODE or matches(p.node, name))
    return {each.name: each for each in reached}


def matches(pattern: str, name: str) -> bool:
    """Whether a pattern of a parameter file means the node of this fully qualified name."""
    whole = pattern if pattern.startswith('/') else f'/{pattern}'
    parts, at = [], 0
    for wild in _WILD.finditer(whole):
        parts.append(re.escape(whole[at : wild.start()]))
        parts.append('[^/]+' if wild.group() == '*' else '(?:/[^/]+)*')
        at = wild.end()
    parts.append(re.escape(whole[at:]))
    return re.fullmatch(''.join(parts), name) is not None


def _is_plain(value: object) -> bool:
    if isinstance(value, tuple):
        return all(map(_is_plain, value))
    return isinstance(value, _SCALARS)
