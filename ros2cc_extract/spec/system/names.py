"""
Names of nodes, topics, services and actions: how they are expanded and remapped.

Sources: design.ros2.org, "Topic and Service name mapping to DDS" and "Remapping Names in ROS"
(relative names, private ``~``, the first rule that matches); rcl (Jazzy) ``expand_topic_name.c``
and ``remap.c`` (both sides of a rule are expanded with the namespace and the name of the node);
launch_ros (Jazzy) ``utilities/namespace_utils.py``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

_RULE = re.compile(
    r'(?:(?P<node>[\w/~*]+):(?!//))?(?:(?P<kind>rostopic|rosservice)://)?(?P<old>[^:]+)'
)
NODE, NAMESPACE = '__node', '__ns'
_OF_NODE = {'__name': NODE, NODE: NODE, NAMESPACE: NAMESPACE}
_TOPIC, _SERVICE = 'rostopic', 'rosservice'


@dataclass(frozen=True, kw_only=True)
class Remap:
    """
    One rule ``old:=new``.

    :param node: the rule holds for nodes of this name only.
    :param kind: ``rostopic`` or ``rosservice`` where it holds for these alone.
    """

    old: str
    new: str
    node: str | None = None
    kind: str | None = None
    source: Place | None = None

    def __str__(self) -> str:
        of_node = f'{self.node}:' if self.node else ''
        kind = f'{self.kind}://' if self.kind else ''
        return f'{of_node}{kind}{self.old}:={self.new}'


def read_remap(text: str, source: Place | None = None) -> Remap | None:
    """Read ``[node:][kind://]old:=new``; ``None`` for another text."""
    left, assigns, new = text.partition(':=')
    match = _RULE.fullmatch(left.strip()) if assigns else None
    if match is None:
        return None
    old = match['old']
    return Remap(
        old=_OF_NODE.get(old, old),
        new=new.strip(),
        node=match['node'],
        kind=match['kind'],
        source=source,
    )


def joined_namespace(base: str, namespace: str) -> str:
    """The namespace that ``namespace`` gives below ``base``: an absolute one replaces it."""
    if namespace.startswith('/'):
        combined = namespace
    else:
        combined = f'{base.rstrip("/")}/{namespace}' if namespace else base
    return absolute(combined)


def absolute(namespace: str) -> str:
    """The namespace with its first slash and without a last one."""
    stripped = namespace.strip('/')
    return f'/{stripped}' if stripped else '/'


def full_name(namespace: str, name: str) -> str:
    """The fully qualified name of a node."""
    return f'{absolute(namespace).rstrip("/")}/{name}'


def expanded(name: str, namespace: str, node: str) -> str:
    """The name of a topic, service or action, with the namespace that it has in ``node``."""
    if name.startswith('/'):
        return name
    if name == '~' or name.startswith('~/'):
        return f'{full_name(namespace, node)}{name[1:]}'
    return f'{absolute(namespace).rstrip("/")}/{name}'


@dataclass(frozen=True, kw_only=True)
class Naming:
    """
    How one node names what it has.

    :param name: of the node, after its own remaps; ``own_name`` is what the code says.
    """

    name: str
    namespace: str
    own_name: str
    remaps: tuple[Remap, ...] = ()

    @property
    def full_name(self) -> str:
        """The fully qualified name of the node."""
        return full_name(self.namespace, self.name)

    def resolved(self, name: str, *, is_service: bool = False) -> str:
        """What a topic or service is called in the graph."""
        whole = expanded(name, self.namespace, self.name)
        rule = self.rule_for(name, is_service=is_service)
        return whole if rule is None else expanded(rule.new, self.namespace, self.name)

    def rule_for(self, name: str, *, is_service: bool = False) -> Remap | None:
        """The first rule that renames it."""
        whole = expanded(name, self.namespace, self.name)
        other = _TOPIC if is_service else _SERVICE
        for rule in self.remaps:
            is_of_this = rule.node in (None, self.own_name) and rule.old not in (NODE, NAMESPACE)
            if not is_of_this or rule.kind == other:
                continue
            if expanded(rule.old, self.namespace, self.name) == whole:
                return rule
        return None


def naming(name: str, namespace: str, remaps: Iterable[Remap]) -> Naming:
    """Apply the rules for the name of a node and for its namespace, then keep the others."""
    rules = tuple(remaps)
    own = [rule for rule in rules if rule.node in (None, name)]
    new_name = next((rule.new for rule in own if rule.old == NODE), name)
    new_space = next((rule.new for rule in own if rule.old == NAMESPACE), namespace)
    return Naming(name=new_name, namespace=absolute(new_space), own_name=name, remaps=rules)
