"""Figures of the publication (IJSEKE 2026, DOI 10.1142/S0218194026500439), as facts."""

from __future__ import annotations

CALLBACKS = (1, 2, 3, 4, 5)
THREADS = (1, 2, 3, 4, 5)

# Seconds of Q1 by threads, then by callbacks: (exclusive, reentrant); None: not finished.
COSTS: dict[int, list[tuple[float, float | None]]] = {
    1: [(0.002, 0.003), (0.007, 0.007), (0.016, 0.024), (0.053, 0.052), (0.368, 0.702)],
    2: [(0.001, 0.006), (0.014, 0.011), (0.055, 0.075), (0.559, 0.719), (6.095, 7.524)],
    3: [(0.005, 0.007), (0.009, 0.043), (0.066, 0.61), (0.56, 9.421), (6.137, 113.739)],
    4: [(0.004, 0.013), (0.009, 0.19), (0.06, 5.403), (0.566, 101.186), (6.293, 1531.545)],
    5: [(0.002, 0.014), (0.015, 1.004), (0.067, 44.338), (0.591, 1051.959), (6.341, None)],
}

# Satisfied in case 1, 2, 3; Q1 to Q29 as the paper's table numbers them.
VERDICTS: list[tuple[bool, bool, bool]] = [
    *[(True, True, True)] * 5,
    *[(True, True, False)] * 6,
    *[(True, True, False)] * 4,
    *[(False, False, True)] * 6,
    *[(False, False, True)] * 4,
    *[(False, False, False)] * 2,
    *[(True, False, True)] * 2,
]
