"""What came of random programs: a line of JSON for each, kept so that a long run goes on."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path


@dataclass(frozen=True)
class Ran:
    """
    One program that was run.

    :param stuck: its functions that stood still.
    :param disturbed: the same with random pauses; ``None`` where it was not run so.
    :param judged: what the model says of each function; ``None`` where it was not asked.
    """

    seed: int
    stuck: tuple[str, ...]
    disturbed: tuple[str, ...] | None = None
    judged: Mapping[str, str] | None = None


def load(record: Path) -> dict[int, Ran]:
    """Read what is known by seeds: the last line of each; one that was cut off is left out."""
    if not record.exists():
        return {}
    found: dict[int, Ran] = {}
    for line in record.read_text(encoding='utf-8').splitlines():
        try:
            row = json.loads(line)
        except json.JSONDecodeError:
            continue
        disturbed = row['disturbed']
        found[row['seed']] = Ran(
            row['seed'],
            tuple(row['stuck']),
            None if disturbed is None else tuple(disturbed),
            row['judged'],
        )
    return found


def add(record: Path, programs: Iterable[Ran]) -> None:
    """Write down what is known now of some programs."""
    is_cut = record.exists() and not record.read_bytes().endswith(b'\n')
    with record.open('a', encoding='utf-8') as stream:
        stream.write('\n' if is_cut else '')
        stream.writelines(json.dumps(asdict(each)) + '\n' for each in programs)


def unfinished(seeds: Sequence[int], known: Mapping[int, Ran]) -> list[int]:
    """Those that were not run."""
    return [seed for seed in seeds if seed not in known]
