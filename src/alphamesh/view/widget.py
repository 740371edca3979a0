"""The view as a widget in a notebook: the page's own script, and a radius for both sides."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

from alphamesh.betti import checked_radii
from alphamesh.errors import MissingLibraryError, ParameterError
from alphamesh.view.bundle import bundle, style
from alphamesh.view.payload import first_radius, payload

if TYPE_CHECKING:
    from alphamesh.persistence import Persistence
    from alphamesh.radius import RadiusChoice

__all__ = ["make_widget"]

_EXPORT = '\nexport default { render: modules["widget.js"].render };\n'


def make_widget(
    persistence: Persistence,
    choice: RadiusChoice | None,
    *,
    radius: float | None = None,
    height: int = 560,
    title: str | None = None,
) -> Any:
    """Return a widget that shows the complex.

    Parameters
    ----------
    persistence, choice, radius, title
        See :func:`alphamesh.view.payload`, also for the errors.
    height : int, default 560
        In pixels.

    Returns
    -------
    anywidget.AnyWidget
        Its ``radius`` is that of the slider: what either side sets, the other one sees.
        ``widget.observe(function, "radius")`` calls a function when it changes.

    Raises
    ------
    MissingLibraryError
        If anywidget is not installed.
    ParameterError
        If `height` is no whole number of at least 200.
    """
    given: Any = height
    if not isinstance(given, int) or height < 200:
        raise ParameterError(f"height must be a whole number of at least 200; got {height!r}")
    packed = payload(persistence, choice, radius=radius, title=title)
    first = first_radius(persistence.filtration, choice, radius)
    signed = persistence.filtration.weights is not None
    return _widget_class()(data=packed, signed=signed, radius=first, height=f"{height}px")


@cache
def _widget_class() -> Any:
    try:
        import anywidget
        import traitlets
    except ImportError:
        raise MissingLibraryError.of("anywidget", "widget", "The widget") from None

    class ComplexWidget(anywidget.AnyWidget):
        """An alpha complex under a slider."""

        _esm = bundle("widget.js") + _EXPORT
        _css = style()
        data = traitlets.Bytes().tag(sync=True)
        signed = traitlets.Bool()
        radius = traitlets.Float().tag(sync=True)
        height = traitlets.Unicode().tag(sync=True)

        @traitlets.validate("radius")
        def _check(self, proposal: Any) -> float:
            checked = checked_radii(proposal["value"], signed=self.signed)
            return float(checked.reshape(()))

    return ComplexWidget
