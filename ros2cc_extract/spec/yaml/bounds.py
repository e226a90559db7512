"""
What a YAML text would become, counted before it is composed.

PyYAML composes recursively, 6.0.2 in C, where nothing bounds it; and an alias stands for all that
its anchor holds, so that some lines of aliases of aliases are more than any memory takes.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import yaml

from ros2cc_extract.light_dataclasses import dataclass

# PyYAML's own, or that of libyaml.
Mark = yaml.Mark | Any
LOADER: Any = getattr(yaml, 'CSafeLoader', yaml.SafeLoader)
MOST_DEPTH = 100
# Far more than a specification, a launch file or a file of parameters of that size holds.
_MOST_NODES = 2_000_000
TOO_DEEP = 'the YAML is nested too deeply'
TOO_LARGE = 'the YAML holds too much by its aliases'
ITSELF = 'the YAML holds itself by an alias'


@dataclass
class UnboundedYamlError(Exception):
    """What is not composed, with its reason and the place where it was noticed."""

    problem: str
    mark: Mark | None


def composed(text: str) -> Iterator[yaml.Node | None]:
    """
    Compose the roots of a stream.

    :raises yaml.YAMLError: when the text is no YAML.
    :raises UnboundedYamlError: when it is nested too deeply, or its aliases repeat too much.
    """
    check(text)
    yield from yaml.compose_all(text, Loader=LOADER)


def composed_alone(text: str) -> yaml.Node | None:
    """
    Compose the only document of a stream.

    :raises yaml.YAMLError, UnboundedYamlError: as ``composed``; also for a second document.
    """
    check(text)
    return yaml.compose(text, Loader=LOADER)


def check(text: str) -> None:
    """
    Walk over a stream without building it.

    :raises yaml.YAMLError, UnboundedYamlError: as ``composed``.
    """
    sizes: dict[str | None, int] = {}
    # Anchors and sizes of the collections that are open.
    inside: list[tuple[str | None, int]] = []
    for event in yaml.parse(text, Loader=LOADER):
        if isinstance(event, yaml.DocumentStartEvent):
            sizes, inside = {}, []
        elif isinstance(event, yaml.CollectionStartEvent):
            inside.append((event.anchor, 1))
            if len(inside) > MOST_DEPTH:
                raise UnboundedYamlError(TOO_DEEP, event.start_mark)
        elif isinstance(event, yaml.CollectionEndEvent):
            anchor, size = inside.pop()
            _add(inside, sizes, anchor, size, event.start_mark)
        elif isinstance(event, yaml.AliasEvent):
            if any(anchor == event.anchor for anchor, _ in inside):
                raise UnboundedYamlError(ITSELF, event.start_mark)
            _add(inside, sizes, None, sizes.get(event.anchor, 1), event.start_mark)
        elif isinstance(event, yaml.ScalarEvent):
            _add(inside, sizes, event.anchor, 1, event.start_mark)


def _add(
    inside: list[tuple[str | None, int]],
    sizes: dict[str | None, int],
    anchor: str | None,
    size: int,
    mark: Mark | None,
) -> None:
    """Count a node that is whole to what it stands in."""
    if size > _MOST_NODES:
        raise UnboundedYamlError(TOO_LARGE, mark)
    if anchor is not None:
        sizes[anchor] = size
    if inside:
        around, so_far = inside[-1]
        inside[-1] = around, so_far + size
