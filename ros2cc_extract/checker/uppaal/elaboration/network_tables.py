"""The tables of a network while it grows, and what the elaboration passes share."""

from __future__ import annotations

from dataclasses import field

from ros2cc_extract.checker.network.network import (
    Channel,
    Check,
    Const,
    Expr,
    Function,
    Network,
    Process,
    Site,
    Variable,
)
from ros2cc_extract.errors import ModelFormatError
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

MAX_VARIABLES = 1_000_000


@dataclass(eq=False)
class Tables:
    """Grows during elaboration; ``snapshot`` gives what engines see."""

    variables: list[Variable] = field(default_factory=list)
    channels: list[Channel] = field(default_factory=list)
    functions: list[Function] = field(default_factory=list)
    sites: list[Site] = field(default_factory=list)
    processes: list[Process] = field(default_factory=list)

    def snapshot(self) -> Network:
        """Return the network as it is now."""
        return Network(
            tuple(self.processes),
            tuple(self.variables),
            tuple(self.channels),
            tuple(self.functions),
            tuple(self.sites),
        )

    def check_room(self, more: int, place: Place) -> None:
        """Refuse declarations no search could hold."""
        if len(self.variables) + len(self.channels) + more > MAX_VARIABLES:
            raise ModelFormatError(
                f'more than {MAX_VARIABLES} variables', place, 'make the arrays smaller'
            )

    def checked(self, expr: Expr, low: int, high: int, site: Site) -> Expr:
        """
        Return the expression with a run-time check where its interval may leave the range.

        :raises ModelFormatError: when a constant is outside the range.
        """
        if low <= expr.low and expr.high <= high:
            return expr
        if isinstance(expr, Const):
            raise ModelFormatError(site.what.format(value=expr.low), site.place, site.mend)
        self.sites.append(site)
        bounds = max(low, min(expr.low, high)), min(high, max(expr.high, low))
        return Check(*bounds, expr, len(self.sites) - 1)

    def nonzero(self, expr: Expr, site: Site) -> Expr:
        """Return the expression with a run-time check where it may be zero."""
        if isinstance(expr, Const) and not expr.low:
            raise ModelFormatError(site.what, site.place, site.mend)
        if not expr.low <= 0 <= expr.high:
            return expr
        self.sites.append(site)
        return Check(expr.low, expr.high, expr, len(self.sites) - 1, is_zero_bad=True)

    def failure(self, site: Site) -> Expr:
        """Return an expression that is an error when it is evaluated."""
        self.sites.append(site)
        return Check(1, 1, Const(0, 0), len(self.sites) - 1)
