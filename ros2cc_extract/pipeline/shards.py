"""
A check in several parts, each on a machine of its own, and their results as one.

Each part scans all files and verifies its share of the units. What it has found out of them is
plain data in its JSON. Merging the parts scans once more and verifies nothing: so
findings, comments, baselines and formats are those of one whole check, by the same code.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ros2cc_extract.cache_file import tool_version
from ros2cc_extract.errors import InputError
from ros2cc_extract.json_text import read_json
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.pipeline.sources import read_input
from ros2cc_extract.pipeline.unit_jobs import KEPT, Kept
from ros2cc_extract.pipeline.unit_task import Examined
from ros2cc_extract.plain_data import Packer, PackingError
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Spec

KEY = 'shard'


@dataclass(frozen=True)
class Shard:
    """The ``number``-th of ``of`` parts, counted from 1."""

    number: int
    of: int

    def holds(self, unit: Spec) -> bool:
        """Whether a unit is of this part; that does not change with what else there is."""
        name = '\0'.join((unit.name, unit.entry or '', *unit.sources))
        digest = hashlib.sha256(name.encode('utf-8', 'surrogatepass')).digest()
        return int.from_bytes(digest, 'big') % self.of == self.number - 1


_SHARD: Packer[Shard] = Packer(Shard)
_SAME = 'name the results of one check'
_WRITTEN = 'name what check --shard i/n --output-format json has written'


def shard_data(shard: Shard, answers: Mapping[str, Examined]) -> dict[str, Any]:
    """What the JSON of a part keeps for merging the parts."""
    units = {key: KEPT.pack(Kept.of(examined)) for key, examined in answers.items()}
    return {'number': shard.number, 'of': shard.of, 'tool': tool_version(), 'units': units}


def read_shards(paths: Sequence[Path]) -> dict[str, Examined]:
    """
    Read the results of all parts.

    :raises InputError: when a file is no part, is of another version of the tool, or a part is
        missing.
    """
    found: dict[str, Examined] = {}
    shards: set[Shard] = set()
    for path in paths:
        shard, units = _read(path)
        shards.add(shard)
        found.update(units)
    counts = {shard.of for shard in shards}
    if len(counts) > 1:
        words = ' and '.join(map(str, sorted(counts)))
        raise InputError(f'some are of {words} shards', None, _SAME)
    missing = sorted(set(range(1, max(counts) + 1)) - {shard.number for shard in shards})
    if missing:
        words = ', '.join(f'{number}/{max(counts)}' for number in missing)
        raise InputError(f'there is no result of shard {words}', None, 'name the files of all')
    return found


def _read(path: Path) -> tuple[Shard, dict[str, Examined]]:
    data = _shard_part(path)
    if data.get('tool') != tool_version():
        what = 'it was written by another version of ros2cc-extract or of Python'
        raise InputError(what, Place(str(path)), _SAME)
    try:
        shard = _SHARD.unpack({name: data[name] for name in ('number', 'of')})
        units = {key: KEPT.unpack(each).examined for key, each in data['units'].items()}
    except (PackingError, KeyError, AttributeError):
        raise InputError('it is damaged', Place(str(path)), _WRITTEN) from None
    return shard, units


def _shard_part(path: Path) -> dict[str, Any]:
    try:
        data = read_json(read_input(path))
    except ValueError as error:
        raise InputError(f'no JSON: {error}', Place(str(path)), _WRITTEN) from None
    part = data.get(KEY) if isinstance(data, dict) else None
    if not isinstance(part, dict):
        raise InputError('it is no result of a shard', Place(str(path)), _WRITTEN)
    return part
