"""The page of the docs that lists all shapes: ``python -m tests.shapes.page`` writes it."""

from __future__ import annotations

from pathlib import Path

from tests.shapes.rows import Row, rows

PAGE = Path(__file__).parents[2] / 'docs' / 'waits.md'
HEAD = """# Shapes of waiting and ending

Drawn up from the standard library, rclpy and public issues, before the rules were looked at. Each
shape has a bad and a good node in `tests/shapes/`: small programs that ran on real rclpy of both
distributions (Jazzy 7.1.6, Kilted 9.1.2), watched for where their threads and coroutines stand
when the time is up. `make shapes` runs them again.

*Must say*: the rule whose finding has to stand at the marked line of the bad node, or *finding*
where any will do. *Undecided*, with the reason, is right in every row; where it alone stands here,
the answer is not in the program. The good node must be clean, or undecided. *Not yet*: what the
tool says of the bad or the good node where it is not what it must say.

This page is generated from `tests/shapes/table.yaml`: `make waits`.

| # | shape | kind | where | bad node | good node | must say | not yet | from |
|---|---|---|---|---|---|---|---|---|
"""


def page() -> str:
    return HEAD + ''.join(map(_line, rows())) + _sum()


def _line(row: Row) -> str:
    cells = (
        str(row.number),
        ' '.join(filter(None, (row.what, row.note))),
        row.kind,
        row.where,
        _observed(row.bad),
        _observed(row.good),
        _rules(row.finds),
        '; '.join(f'{word}: {said}' for word, said in row.not_yet.items()),
        row.source,
    )
    return f'| {" | ".join(cell.replace("|", "&#124;") for cell in cells)} |\n'


def _observed(seen: dict[str, str]) -> str:
    jazzy, kilted = seen['jazzy'], seen['kilted']
    return jazzy if jazzy == kilted else f'Jazzy: {jazzy}; Kilted: {kilted}'


def _rules(finds: str) -> str:
    words = (word.strip() for word in finds.split(','))
    return ', '.join(f'[{w}](rules/{w}.md)' if w.startswith('CC') else w for w in words)


def _sum() -> str:
    late = sum(bool(row.not_yet) for row in rows())
    return f'\n{len(rows())} shapes; {late} with a verdict that is not yet as it must be.\n'


if __name__ == '__main__':
    PAGE.write_text(page(), encoding='utf-8')
