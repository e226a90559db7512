"""Which function bodies can stand as an expression in place of a call."""

from __future__ import annotations

import collections
import dataclasses
from collections.abc import Iterator, Sequence

from ros2cc_extract.checker.uppaal.language import syntax


def is_expression(body: syntax.Block) -> bool:
    """Whether a body is a tree of branches that return, over local constants used once."""
    uses = collections.Counter(names_in(body.statements))
    for declaration in body.declarations:
        if isinstance(declaration, syntax.Variables):
            initials = [d.initial for d in declaration.declarators]
            uses.update(names_in(initials))
    locals_ = [
        d.name for v in body.declarations if isinstance(v, syntax.Variables) for d in v.declarators
    ]
    return all(uses[name] <= 1 for name in locals_) and _returns_tree(body.statements)


def _returns_tree(statements: Sequence[syntax.Statement]) -> bool:
    if not statements:
        return False
    first, rest = statements[0], statements[1:]
    if isinstance(first, syntax.Return):
        return first.value is not None
    if not isinstance(first, syntax.Branch) or not _returns_tree(statements_of(first.then)):
        return False
    return _returns_tree(statements_of(first.otherwise) if first.otherwise else rest)


def statements_of(node: syntax.Statement) -> tuple[syntax.Statement, ...]:
    """Return the statements of a block without declarations, else the statement itself."""
    if isinstance(node, syntax.Block) and not node.declarations:
        return node.statements
    return (node,)


def names_in(tree: object) -> Iterator[str]:
    """Yield every name that a syntax tree uses, as often as it does."""
    waiting = [tree]
    while waiting:
        node = waiting.pop()
        if isinstance(node, syntax.Name):
            yield node.name
        elif isinstance(node, (tuple, list)):
            waiting += node
        elif dataclasses.is_dataclass(node):
            waiting += [getattr(node, field.name) for field in dataclasses.fields(node)]
