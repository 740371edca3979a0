"""Kinds of values on the command line, refused at once where they cannot be right."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import click
from click.shell_completion import CompletionItem

if TYPE_CHECKING:
    ParamType = click.ParamType[Any]
else:
    ParamType = click.ParamType  # generic in newer versions of click only

__all__ = [
    "AUTO",
    "RULE_OPTIONS",
    "AggregateType",
    "BettiType",
    "ColumnType",
    "ColumnsType",
    "ElementRadiusType",
    "MostRadius",
    "RadiiType",
    "RadiusType",
    "Rule",
    "RuleName",
    "SizeType",
    "SourceType",
]

AUTO = "auto"


class SourceType(ParamType):
    """An input: a file, ``-``, or a demo shape."""

    name = "input"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> str:
        """Return it as it is; what it stands for is found out when it is read."""
        return str(value)

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """Let the shell look for files."""
        return [CompletionItem(incomplete, type="file")]


class Rule(NamedTuple):
    """A rule that chooses a radius, and its options; ``auto`` is the usual one."""

    name: str
    options: dict[str, Any]


class RadiusType(ParamType):
    """A radius: a number of at least 0, ``auto``, or a rule, as in ``topology:holes=2``.

    With --weights, the number may be negative.
    """

    name = "radius"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float | Rule:
        """Return a number, or a rule."""
        if isinstance(value, Rule | float):
            return value
        name, *options = str(value).split(":")
        if name in _known_rules():
            return Rule(name, dict(self._option(text, param, ctx) for text in options))
        try:
            radius = float(value)
        except ValueError:
            rules = ", ".join(_known_rules())
            self.fail(
                f"{value!r} is neither a number nor one of the rules: {rules}", param, ctx
            )
        if not (radius >= 0 or (_weighted(ctx) and radius < 0)):
            self.fail(f"{value!r} is not a number of at least 0", param, ctx)
        return radius

    def _option(
        self, text: str, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[str, Any]:
        """Return an option of a rule, as in ``holes=2``."""
        name, equals, value = text.partition("=")
        name = name.strip().replace("-", "_")
        if not equals or name not in RULE_OPTIONS:
            self.fail(
                f"{text!r} is no option of a rule; they are written as in topology:holes=2, "
                f"and there are {', '.join(RULE_OPTIONS)}",
                param,
                ctx,
            )
        return name, RULE_OPTIONS[name].convert(value, param, ctx)

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """Return the rules that begin so."""
        return _rules_from(incomplete)


class MostRadius(ParamType):
    """A radius up to which something is taken: at least 0, with --weights any number."""

    name = "radius"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """Return the number."""
        radius: float = click.FLOAT.convert(value, param, ctx)
        if not (radius >= 0 or (_weighted(ctx) and radius < 0)):
            self.fail(f"{value!r} is not a number of at least 0", param, ctx)
        return radius


class RuleName(ParamType):
    """The name of a rule, whose options are options of the command."""

    name = "rule"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> str:
        """Return the name of a rule that there is."""
        if value not in _known_rules():
            listed = ", ".join(_known_rules())
            self.fail(f"there is no radius rule {value!r}; rules: {listed}", param, ctx)
        return str(value)

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """Return the rules that begin so."""
        return _rules_from(incomplete)


def _rules_from(start: str) -> list[CompletionItem]:
    return [CompletionItem(name) for name in _known_rules() if name.startswith(start)]


def _weighted(ctx: click.Context | None) -> bool:
    """Return whether --weights is given: then radii may be negative."""
    return ctx is not None and ctx.params.get("weights") is not None


def _known_rules() -> tuple[str, ...]:
    """Return ``auto`` and the names of the rules, those of the plane first."""
    from alphamesh.periodic import PERIODIC_RULES
    from alphamesh.radius import rule_names

    names = rule_names(2) + rule_names(3) + rule_names(weighted=True) + PERIODIC_RULES
    return (AUTO, *dict.fromkeys(names))


class RadiiType(ParamType):
    """The radii of a film: the name of a rule, or numbers with commas between them."""

    name = "radii"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> str | list[float]:
        """Return the name of a rule, or the numbers."""
        from alphamesh.film.radii import RADII_RULES

        if isinstance(value, list) or value in RADII_RULES:
            return value if isinstance(value, list) else str(value)
        try:
            radii = [float(part) for part in str(value).split(",")]
        except ValueError:
            self.fail(
                f"{value!r} is neither a list of numbers nor one of the rules: "
                + ", ".join(RADII_RULES),
                param,
                ctx,
            )
        least = -float("inf") if _weighted(ctx) else 0.0
        if not all(least <= radius < float("inf") for radius in radii):
            self.fail(f"{value!r} holds a number that is no finite radius", param, ctx)
        return radii


class ElementRadiusType(ParamType):
    """The radius of an element: ``Fe=1.4``."""

    name = "radius"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[str, float]:
        """Return the symbol and the radius."""
        if isinstance(value, tuple):
            return value
        symbol, _, text = str(value).partition("=")
        try:
            radius = float(text)
        except ValueError:
            radius = -1.0
        if not symbol.strip().isalpha() or not 0 <= radius < float("inf"):
            self.fail(f"{value!r} is not an element and a radius, such as Fe=1.4", param, ctx)
        return symbol.strip(), radius


class BettiType(ParamType):
    """Components and holes, ``b0,b1``; in space components, tunnels and voids."""

    name = "betti"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[int, ...]:
        """Return the two or three numbers."""
        if isinstance(value, tuple):
            return value
        parts = [part.strip() for part in str(value).split(",")]
        if len(parts) not in {2, 3} or not all(part.isdigit() for part in parts):
            self.fail(
                f"{value!r} is not components and holes, such as 1,2, nor components, tunnels "
                "and voids, such as 1,2,1",
                param,
                ctx,
            )
        return tuple(map(int, parts))


RULE_OPTIONS: dict[str, ParamType] = {
    "betti": BettiType(),
    "components": click.IntRange(1),
    "holes": click.IntRange(0),
    "voids": click.IntRange(0),
    "surface": click.BOOL,
    "min_hole": click.FloatRange(0),
    "regions": click.IntRange(1),
    "triangles": click.IntRange(1),
    "tetrahedra": click.IntRange(1),
}
"""Options of rules; what a rule does not know, it refuses by itself."""


class ColumnsType(ParamType):
    """Two columns, ``x,y``, or three, by name or by number counted from 0."""

    name = "columns"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[str | int, ...]:
        """Return the names or numbers."""
        if isinstance(value, tuple):
            return value
        names = [name.strip() for name in str(value).split(",")]
        if len(names) not in {2, 3} or not all(names):
            self.fail(f"{value!r} is not two or three columns, such as x,y or 0,1,2")
        return tuple(int(name) if name.isdigit() else name for name in names)


class ColumnType(ParamType):
    """One column, by name or by number counted from 0."""

    name = "column"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> str | int:
        """Return the name or the number."""
        name = str(value).strip()
        if not name:
            self.fail("name a column, or give its number, counted from 0", param, ctx)
        return int(name) if name.isdigit() else name


class SizeType(ParamType):
    """An area or a volume of at least 0; ``all`` is larger than any."""

    name = "size"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """Return the number."""
        try:
            size = float("inf" if value == "all" else value)
        except ValueError:
            size = -1.0
        if not size >= 0:
            self.fail(f"{value!r} is neither a number of at least 0 nor all", param, ctx)
        return size


class AggregateType(ParamType):
    """A column and what to make of it, ``height:max``."""

    name = "aggregate"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[str, str]:
        """Return the two words."""
        if isinstance(value, tuple):
            return value
        column, colon, how = str(value).rpartition(":")
        if not (colon and column and how):
            self.fail(f"{value!r} is not a column and what to make of it, such as height:max")
        return column, how
