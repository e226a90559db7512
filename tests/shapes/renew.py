"""
Ask the tool about every node and renew what the table excuses: ``python -m tests.shapes.renew``.

Prints the sums: bad nodes found at the marked line, left open there, silent; good nodes clean,
left open, with a finding.
"""

from __future__ import annotations

import concurrent.futures
import os
import re
from collections import Counter, defaultdict

from tests.shapes.rows import TABLE, nodes
from tests.shapes.told import is_right, verdict

ROW = re.compile('^(?=- shape: )', re.MULTILINE)
EXCUSE = re.compile('^  tool: .*\n', re.MULTILINE)


def main() -> None:
    every = nodes()
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        said = list(zip(every, pool.map(verdict, every), strict=True))
    late: defaultdict[str, dict[str, str]] = defaultdict(dict)
    sums: Counter[str] = Counter()
    for node, words in said:
        is_found = words.startswith('CC')
        sums[f'{node.word}: {"finding" if is_found else words}'] += 1
        if not is_right(node, words):
            late[node.row.shape][node.word] = words
            print(f'{node.name}: {words}')
    head, *parts = ROW.split(TABLE.read_text(encoding='utf-8'))
    renewed = (_renewed(part, late) for part in parts)
    TABLE.write_text(head + ''.join(renewed), encoding='utf-8')
    for what, number in sorted(sums.items()):
        print(f'{number:4} {what}')


def _renewed(part: str, late: dict[str, dict[str, str]]) -> str:
    shape = part.split()[2]
    excuses = ', '.join(f"{word}: '{said}'" for word, said in late.get(shape, {}).items())
    return EXCUSE.sub('', part) + (f'  tool: {{{excuses}}}\n' if excuses else '')


if __name__ == '__main__':
    main()
