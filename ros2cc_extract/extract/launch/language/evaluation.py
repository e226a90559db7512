"""
What substitutions stand for, given what is set; ``Unknown`` if that cannot be resolved.

Source: launch (Jazzy) ``substitutions/``, ``conditions/evaluate_condition_expression_impl.py``
(``true`` and ``1``, ``false`` and ``0``, in any case).
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path as FilePath

from ros2cc_extract.extract.launch.language.actions import Condition
from ros2cc_extract.extract.launch.language.context import Context, Value
from ros2cc_extract.extract.launch.language.expressions import computed
from ros2cc_extract.extract.launch.language.substitutions import (
    Configuration,
    Evaluated,
    Expression,
    Logic,
    Path,
    Share,
    Substitution,
    Text,
    ThisFile,
    Unresolved,
    Variable,
)
from ros2cc_extract.source_locations import Unknown

# Of all texts that are put together in one launch: what refers to what refers to it doubles.
_MOST_LETTERS = 2_000_000
_TRUE, _FALSE = ('true', '1'), ('false', '0')
ShareOf = Callable[[str], FilePath | None]


class Evaluator:
    """
    Evaluates expressions.

    :param share_of: the folder of a package, ``None`` where it is not known.
    """

    def __init__(self, context: Context, share_of: ShareOf) -> None:
        self._context = context
        self._share_of = share_of

    def value(self, expression: Expression) -> Value:
        """The text of an expression."""
        parts: list[str] = []
        for substitution in expression:
            part = self._one(substitution)
            if isinstance(part, Unknown):
                return part
            parts.append(part)
        return parts[0] if len(parts) == 1 else self._joined(parts)

    def _joined(self, parts: Sequence[str]) -> Value:
        self._context.letters += sum(map(len, parts)) + 1
        if self._context.letters > _MOST_LETTERS:
            return Unknown('texts of the launch are too long to be put together')
        return ''.join(parts)

    def holds(self, condition: Condition) -> bool | Unknown:
        """Whether a condition holds."""
        operands = [self.value(operand) for operand in condition.operands]
        for operand in operands:
            if isinstance(operand, Unknown):
                return operand
        if condition.operator in ('equals', 'differs'):
            return (operands[0] == operands[1]) is (condition.operator == 'equals')
        found = _truth(str(operands[0]))
        if found is None:
            return Unknown(f'condition {operands[0]!r} is neither true nor false')
        return found if condition.operator == 'if' else not found

    def _one(self, part: Substitution) -> Value:
        if isinstance(part, Text):
            return part.text
        if isinstance(part, Configuration):
            return self._configuration(part)
        if isinstance(part, Path):
            return self._path(part)
        if isinstance(part, Share):
            return self._share(part)
        if isinstance(part, ThisFile):
            file = self._context.file
            return os.path.dirname(file) if part.is_folder else file  # noqa: PTH120
        if isinstance(part, Evaluated):
            text = self.value(part.text)
            return text if isinstance(text, Unknown) else computed(text)
        if isinstance(part, Logic):
            return self._logic(part)
        if isinstance(part, Variable):
            name = self.value(part.name)
            return Unknown(f'environment variable {name} of the launch')
        assert isinstance(part, Unresolved)
        return part.why

    def _configuration(self, part: Configuration) -> Value:
        name = self.value(part.name)
        if isinstance(name, Unknown):
            return name
        scope = self._context.scope
        if part.default is None and name in scope.perhaps:
            return scope.perhaps[name]
        known = scope.configurations.get(name)
        if known is not None:
            return known
        if part.default is not None:
            return self.value(part.default)
        self._context.unset.setdefault(name, None)
        return Unknown(f'launch argument {name!r} is not set: give {name}:=VALUE')

    def _path(self, part: Path) -> Value:
        parts: list[str] = []
        for each in part.parts:
            value = self.value(each)
            if isinstance(value, Unknown):
                return value
            parts.append(value)
        joined = self._joined(parts)
        is_known = parts and not isinstance(joined, Unknown)
        return os.path.join(*parts) if is_known else joined  # noqa: PTH118

    def _share(self, part: Share) -> Value:
        name = self.value(part.package)
        if isinstance(name, Unknown):
            return name
        folder = self._share_of(name)
        return Unknown(f'package {name} is not found') if folder is None else str(folder)

    def _logic(self, part: Logic) -> Value:
        values = [self.value(operand) for operand in part.operands]
        for value in values:
            if isinstance(value, Unknown):
                return value
        texts = [str(value) for value in values]
        if part.operator in ('equals', 'not-equals') and len(texts) == 2:
            return _as_text((texts[0] == texts[1]) is (part.operator == 'equals'))
        truths = [_truth(text) for text in texts]
        if part.operator == 'if' and truths and truths[0] is not None:
            rest = texts[1:] if truths[0] else texts[2:]
            return rest[0] if rest else ''
        if not truths or None in truths:
            return Unknown(f'{part.operator} of {", ".join(texts)}')
        if part.operator == 'not':
            return _as_text(not truths[0])
        return _as_text(all(truths) if part.operator == 'and' else any(truths))


def _as_text(value: bool) -> str:
    return 'true' if value else 'false'


def _truth(text: str) -> bool | None:
    word = text.strip().lower()
    return True if word in _TRUE else False if word in _FALSE else None
