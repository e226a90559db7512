"""
How one value stands in YAML: encode, decode and its JSON Schema, side by side.

``fields.py`` combines codecs into the tables of keys; reading, writing and ``schema.json``
are all derived from those tables, so that they cannot drift apart.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from typing import Any, TypeVar

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.yaml.cursor import Cursor

JsonSchema = dict[str, Any]
E = TypeVar('E', bound=Enum)


@dataclass(frozen=True)
class Codec:
    """
    One kind of value.

    :param encode: value to plain YAML data.
    :param decode: YAML node to value; raises ``SpecFormatError`` at the node's place.
    """

    encode: Callable[[Any], Any]
    decode: Callable[[Cursor], Any]
    schema: JsonSchema


def _same(value: Any) -> Any:
    return value


TEXT = Codec(_same, Cursor.text, {'type': 'string'})
FLAG = Codec(_same, Cursor.flag, {'type': 'boolean'})
COUNT = Codec(_same, Cursor.count, {'type': 'integer', 'minimum': 0})
SECONDS = Codec(_same, Cursor.number, {'type': 'number'})
PLACE = Codec(
    str,
    lambda cursor: Place.parse(cursor.text()),
    {'type': 'string', 'description': 'file, file:line or file:line:column'},
)
NAME = Codec(_same, Cursor.text, {'type': 'string', 'pattern': '^[A-Za-z_][A-Za-z0-9_]*$'})


def optional(codec: Codec) -> Codec:
    """Allow ``null``, which stands for ``None``."""
    return Codec(
        lambda value: None if value is None else codec.encode(value),
        lambda cursor: None if cursor.is_null else codec.decode(cursor),
        {'anyOf': [codec.schema, {'type': 'null'}]},
    )


def listing(codec: Codec, *, at_least: int = 0) -> Codec:
    """Stand for a tuple of values of ``codec``."""
    schema: JsonSchema = {'type': 'array', 'items': codec.schema}
    if at_least:
        schema['minItems'] = at_least
    return Codec(
        lambda values: [codec.encode(value) for value in values],
        lambda cursor: tuple(codec.decode(item) for item in cursor.items(at_least=at_least)),
        schema,
    )


def member(choices: type[E]) -> Codec:
    """Stand for one of the values of an enumeration of texts."""
    return Codec(
        lambda choice: choice.value,
        lambda cursor: cursor.member(choices),
        {'enum': [choice.value for choice in choices]},
    )
