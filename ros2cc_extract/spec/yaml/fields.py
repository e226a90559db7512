"""
The table of keys of the format: one row per fact, read in both directions.

A row says which YAML keys one attribute of a frozen value takes, when they are written, and
what a schema says of them. ``record`` turns rows into a codec for the whole value.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields
from enum import Enum
from typing import Any, Protocol

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.yaml.codecs import FLAG, PLACE, TEXT, Codec, JsonSchema, optional
from ros2cc_extract.spec.yaml.cursor import Cursor


class Absent(Enum):
    """No value at all, where ``None`` would be one."""

    ABSENT = 'absent'


ABSENT = Absent.ABSENT


class Flow(dict[str, Any]):
    """A mapping that is written on one line."""


class Row(Protocol):
    """One fact of a value, under one or more keys."""

    @property
    def attribute(self) -> str:
        """The attribute of the value."""

    @property
    def schemas(self) -> Mapping[str, JsonSchema]:
        """The keys, in the order of writing, with what each may hold."""

    def encode(self, owner: Any) -> dict[str, Any]:
        """Give the keys to write for ``owner``; none when the fact is at its default."""

    def decode(self, found: Mapping[str, Cursor]) -> Any:
        """Give the attribute's value, or ``ABSENT`` when no key of the row is there."""


@dataclass(frozen=True)
class Plain:
    """
    A fact under one key.

    :param shown: writes the key although the value is at its default.
    """

    key: str
    attribute: str
    codec: Codec
    default: Any = ABSENT
    shown: Callable[[Any], bool] = lambda owner: False

    @property
    def schemas(self) -> Mapping[str, JsonSchema]:
        return {self.key: self.codec.schema}

    def encode(self, owner: Any) -> dict[str, Any]:
        value = getattr(owner, self.attribute)
        if value == self.default and not self.shown(owner):
            return {}
        return {self.key: self.codec.encode(value)}

    def decode(self, found: Mapping[str, Cursor]) -> Any:
        return self.codec.decode(found[self.key]) if self.key in found else ABSENT


@dataclass(frozen=True)
class Open:
    """
    A fact that may be ``Unknown``: value under one key, why it is unknown under others.

    :param keys: the keys the value may stand under; ``choose`` picks the one to write.
    :param mark: key and value that say the fact is unknown; ``null`` stands at the value's key
        unless the mark is that key itself.
    :param prefix: of the keys ``<prefix>reason`` and ``<prefix>at``.
    """

    keys: tuple[str, ...]
    attribute: str
    codec: Codec
    mark: tuple[str, Any]
    prefix: str
    default: Any = ABSENT
    choose: Callable[[Any], str | None] = lambda owner: None

    @property
    def schemas(self) -> Mapping[str, JsonSchema]:
        open_values: list[JsonSchema] = [self.codec.schema, {'type': 'null'}]
        mark_key, mark_value = self.mark
        if mark_key in self.keys:
            open_values.append({'const': mark_value})
        table: dict[str, JsonSchema] = {key: {'anyOf': open_values} for key in self.keys}
        table.setdefault(mark_key, {'type': 'boolean'})
        table[f'{self.prefix}reason'] = TEXT.schema
        table[f'{self.prefix}at'] = optional(PLACE).schema
        return table

    def encode(self, owner: Any) -> dict[str, Any]:
        value = getattr(owner, self.attribute)
        key = self.choose(owner)
        if isinstance(value, Unknown):
            written = {key: None} if key else {}
            return {**written, **dict([self.mark]), **_reason(self.prefix, value)}
        if value == self.default and not key:
            return {}
        return {key or self.keys[0]: optional(self.codec).encode(value)}

    def decode(self, found: Mapping[str, Cursor]) -> Any:
        reason_key = f'{self.prefix}reason'
        if reason_key in found:
            return _unknown(self.prefix, found)
        for key in self.keys:
            if key in found:
                return optional(self.codec).decode(found[key])
        return ABSENT


@dataclass(frozen=True)
class Resolution:
    """``resolved: false`` with ``reason`` and ``at``, for an ``Unknown | None`` attribute."""

    attribute: str = 'unresolved'

    @property
    def schemas(self) -> Mapping[str, JsonSchema]:
        return {'resolved': FLAG.schema, 'reason': TEXT.schema, 'at': optional(PLACE).schema}

    def encode(self, owner: Any) -> dict[str, Any]:
        value = getattr(owner, self.attribute)
        return {} if value is None else {'resolved': False, **_reason('', value)}

    def decode(self, found: Mapping[str, Cursor]) -> Any:
        if 'reason' in found:
            return _unknown('', found)
        if 'resolved' in found and not found['resolved'].flag():
            raise found['resolved'].error("'resolved: false' without 'reason'", 'say the reason')
        return ABSENT


@dataclass(frozen=True)
class Escape:
    """``<attribute>: reason`` with ``<attribute>_at``, for an ``Unknown | None`` attribute."""

    attribute: str

    @property
    def schemas(self) -> Mapping[str, JsonSchema]:
        return {self.attribute: TEXT.schema, f'{self.attribute}_at': optional(PLACE).schema}

    def encode(self, owner: Any) -> dict[str, Any]:
        value = getattr(owner, self.attribute)
        if value is None:
            return {}
        place = {f'{self.attribute}_at': PLACE.encode(value.at)} if value.at else {}
        return {self.attribute: value.reason, **place}

    def decode(self, found: Mapping[str, Cursor]) -> Any:
        if self.attribute not in found:
            return ABSENT
        at = found.get(f'{self.attribute}_at')
        place = optional(PLACE).decode(at) if at is not None else None
        return Unknown(found[self.attribute].text(), place)


def record(
    kind: Callable[..., Any],
    rows: Sequence[Row],
    *,
    required: Sequence[str] = (),
    flow: bool = False,
) -> Codec:
    """Make the codec of a frozen value from its rows."""
    schemas = {key: schema for row in rows for key, schema in row.schemas.items()}

    def encode(owner: Any) -> dict[str, Any]:
        written = {key: value for row in rows for key, value in row.encode(owner).items()}
        return Flow(written) if flow else written

    def decode(cursor: Cursor) -> Any:
        found = cursor.mapping(schemas, required)
        values = ((row.attribute, row.decode(found)) for row in rows)
        return kind(**{name: value for name, value in values if value is not ABSENT})

    return Codec(encode, decode, _object_schema(schemas, required))


def plain_rows(kind: Any, table: Sequence[tuple[str, str, Codec]]) -> tuple[Plain, ...]:
    """Make rows that are written when they differ from the default of the dataclass field."""
    defaults = {field.name: field.default for field in fields(kind)}
    return tuple(Plain(key, name, codec, defaults[name]) for key, name, codec in table)


def _object_schema(schemas: Mapping[str, JsonSchema], required: Sequence[str]) -> JsonSchema:
    schema: JsonSchema = {
        'type': 'object',
        'properties': dict(schemas),
        'additionalProperties': False,
    }
    if required:
        schema['required'] = list(required)
    return schema


def _reason(prefix: str, value: Unknown) -> dict[str, Any]:
    place = {f'{prefix}at': PLACE.encode(value.at)} if value.at else {}
    return {f'{prefix}reason': value.reason, **place}


def _unknown(prefix: str, found: Mapping[str, Cursor]) -> Unknown:
    place_key = f'{prefix}at'
    place = optional(PLACE).decode(found[place_key]) if place_key in found else None
    return Unknown(found[f'{prefix}reason'].text(), place)
