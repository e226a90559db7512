"""Callback groups that a node makes and keeps, and that no code ever asks it for."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator

from ros2cc_extract.extract.static.libraries.rclpy.machine.state import GroupState, RosWorld
from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.values.values import Class, Instance, Value, options_of


def unused_groups(nodes: Iterable[Instance], world: RosWorld) -> Iterator[Instance]:
    """
    Groups that are empty, even if something was not followed.

    Only those are certain that are stored in an attribute which no line of the program reads.
    """
    used = {id(entity.group) for entity in (*world.entities, *world.builtins)}
    for node in nodes:
        for name, held in node.slots.items():
            if not isinstance(held, Value) or any(name in _read(t) for t in _trees(node, world)):
                continue
            for group in options_of(held):
                if isinstance(group, Instance) and isinstance(group.state, GroupState):
                    is_made = not group.state.default and group.state.library is None
                    if is_made and id(group) not in used:
                        used.add(id(group))
                        yield group


def _trees(node: Instance, world: RosWorld) -> Iterable[ast.AST]:
    """Everything that was run, and the classes of the node."""
    return (*world.trees, *(cls.node for cls in node.mro if isinstance(cls, Class)))


def _read(tree: ast.AST) -> frozenset[str]:
    return noted_on(tree, 'read_attributes', _attributes_read)


def _attributes_read(tree: ast.AST) -> frozenset[str]:
    """Names of attributes that are read, and texts, by which ``getattr`` may read one."""
    read = {
        part.attr
        for part in walk(tree)
        if isinstance(part, ast.Attribute) and isinstance(part.ctx, ast.Load)
    }
    texts = {
        part.value
        for part in walk(tree)
        if isinstance(part, ast.Constant) and isinstance(part.value, str)
    }
    return frozenset(read | texts)
