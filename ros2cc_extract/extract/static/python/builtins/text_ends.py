"""How a text begins and ends that the source puts together."""

from __future__ import annotations

import ast


def ends_of(text: ast.expr | None) -> tuple[str, str] | None:
    """How a text that the source puts together begins and ends, if anything of it is known."""
    match text:
        case ast.JoinedStr(values=[first, *_] as parts):
            ends = _constant(first), _constant(parts[-1])
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            ends = _beginning(left), _constant(right)
        case ast.BinOp(left=ast.Constant(value=str(form)), op=ast.Mod()):
            ends = form.partition('%s')[0], form.rpartition('%s')[2]
        case _:
            return None
    return ends if any(ends) else None


def _beginning(sum_: ast.expr) -> str:
    while isinstance(sum_, ast.BinOp) and isinstance(sum_.op, ast.Add):
        sum_ = sum_.left
    return _constant(sum_)


def _constant(part: ast.expr) -> str:
    return str(part.value) if isinstance(part, ast.Constant) else ''
