"""
What an edge of our templates means: the annotation that stands in its comment.

``event wait lock; who: callback my_cb(); thread: thread id`` names a kind, a form of it, and
fields: each has a noun, which says what is numbered, and an expression that gives the number in
the state after the step; one that ends in ``before``, in the state before it.
"""

from __future__ import annotations

from ros2cc_extract.light_dataclasses import dataclass

_MARK, _BEFORE = 'event ', ' before'


@dataclass(frozen=True)
class FieldText:
    """
    One field of an annotation.

    :param noun: ``callback``, ``thread``, ``group``, ``number`` … or ``executor``, which has no
        expression.
    :param is_before: the expression is asked before the step.
    """

    name: str
    noun: str
    expression: str
    is_before: bool


@dataclass(frozen=True)
class Annotation:
    """What an edge means, before its fields are evaluated."""

    kind: str
    form: str
    fields: tuple[FieldText, ...]

    @property
    def key(self) -> str:
        """Kind and form."""
        return f'{self.kind} {self.form}'.strip()


def read_annotation(comment: str) -> Annotation | None:
    """Read the comment of an edge; ``None`` if it is not one of our annotations."""
    head, *fields = ' '.join(comment.split()).split('; ')
    if not head.startswith(_MARK) or not all(': ' in field for field in fields):
        return None
    kind, _, form = head.removeprefix(_MARK).partition(' ')
    return Annotation(kind, form, tuple(map(_read_field, fields)))


def _read_field(text: str) -> FieldText:
    name, _, value = text.partition(': ')
    noun, _, expression = value.partition(' ')
    is_before = expression.endswith(_BEFORE)
    return FieldText(name, noun, expression.removesuffix(_BEFORE), is_before)
