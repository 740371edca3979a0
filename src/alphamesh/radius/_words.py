"""Numbers in words for the reasons of rules."""

from __future__ import annotations

__all__ = ["components_and_holes", "counted"]


def counted(number: int, singular: str, plural: str | None = None) -> str:
    """Return ``"1 hole"``, ``"2 holes"`` or ``"no holes"``."""
    name = singular if number == 1 else plural or f"{singular}s"
    return f"{number:,} {name}" if number else f"no {name}"


def components_and_holes(b0: int, b1: int) -> str:
    """Return ``"1 component and 2 holes"``."""
    return f"{counted(b0, 'component')} and {counted(b1, 'hole')}"
