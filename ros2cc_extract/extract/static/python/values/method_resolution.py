"""In which order the classes of an object are looked through."""

from __future__ import annotations

from collections import Counter, deque
from itertools import islice

from ros2cc_extract.extract.static.python.values.values import Class, Value


def cost_of_order(cls: Class) -> int:
    """How many classes are looked at to find the order of ``cls``."""
    return len(cls.bases) * sum(len(_order_of(base)) for base in cls.bases)


def resolution_order(cls: Class) -> tuple[Value, ...]:
    """C3 order of ``cls``; depth first where the classes do not allow it."""
    sequences = [deque(_order_of(base)) for base in cls.bases]
    if len(sequences) == 1:
        return (cls, *sequences[0])
    sequences.append(deque(cls.bases))
    behind = Counter(entry for sequence in sequences for entry in islice(sequence, 1, None))
    order: dict[Value, None] = {cls: None}
    while sequences := [sequence for sequence in sequences if sequence]:
        heads = (sequence[0] for sequence in sequences)
        order[next((head for head in heads if not behind[head]), sequences[0][0])] = None
        for sequence in sequences:
            while sequence and sequence[0] in order:
                sequence.popleft()
                if sequence:
                    behind[sequence[0]] -= 1
    return tuple(order)


def _order_of(base: Value) -> tuple[Value, ...]:
    return base.mro if isinstance(base, Class) else (base,)
