"""Draws cost against size on a logarithmic axis."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass

import matplotlib

matplotlib.use('svg')
from matplotlib import pyplot as plt


@dataclass(frozen=True)
class Series:
    """Seconds for 1, 2, 3 … callbacks on as many threads; ``None`` where it did not finish."""

    label: str
    seconds: Sequence[float | None]


def draw_growth(series: Sequence[Series]) -> str:
    """Give the picture as SVG text, the same for the same figures."""
    with plt.rc_context({'svg.hashsalt': 'growth', 'svg.fonttype': 'none', 'font.size': 11}):
        figure, axes = plt.subplots(figsize=(7, 4.6))
        for each in series:
            points = [(n, s) for n, s in enumerate(each.seconds, start=1) if s]
            axes.plot(*zip(*points, strict=True), marker='o', label=each.label)
        axes.set_yscale('log')
        axes.set_xlabel('callbacks and threads, one reentrant group')
        axes.set_ylabel('CPU seconds')
        axes.set_xticks(range(1, max(len(each.seconds) for each in series) + 1))
        axes.grid(True, which='major', alpha=0.3)
        axes.legend(frameon=False)
        figure.tight_layout()
        buffer = io.StringIO()
        figure.savefig(buffer, format='svg', metadata={'Date': None})
        plt.close(figure)
    return buffer.getvalue()
