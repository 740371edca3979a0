"""What a complex shows of itself: a live page, a widget, a card in notebooks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import os

    from alphamesh._arrays import FloatArray
    from alphamesh.persistence import Persistence

__all__ = ["Shown"]

# Of larger clouds a notebook shows the facts alone, which are there at once.
_MOST_PICTURED = 50_000


class Shown:
    """What a complex shows of itself: base of those that users hold."""

    __slots__ = ()

    _filtration: Any

    if TYPE_CHECKING:

        @property
        def points(self) -> FloatArray:
            """The cloud."""

        def persistence(self) -> Persistence:
            """Return when classes come and go."""

        def choose_radius(self) -> Any:
            """Choose a radius, and say why."""

        def at(self, radius: float) -> Any:
            """Return the complex at one radius."""

    def view(
        self,
        path: str | os.PathLike[str],
        radius: float | None = None,
        *,
        title: str | None = None,
    ) -> None:
        """Write a page that shows the complex live under a slider for the radius.

        One HTML file with all in it: it opens from disk in any browser with WebGL 2, and
        asks for nothing from the network.

        Parameters
        ----------
        path : path-like
            An existing file is replaced once the new one is complete.
        radius : float, optional
            The radius that is shown first; by default the one that
            :meth:`choose_radius` chooses.
        title : str, optional
            The heading of the page.

        Raises
        ------
        FileWriteError
            If it cannot be written.
        ParameterError
            If `radius` is not a number, NaN, or negative without weights, or `title` is no
            text.
        """
        from alphamesh.view import write_page

        choice = self.choose_radius() if len(self.points) else None
        write_page(path, self.persistence(), choice, radius=radius, title=title)

    def widget(
        self, radius: float | None = None, *, height: int = 560, title: str | None = None
    ) -> Any:
        """Return the view of :meth:`view` as a widget for notebooks.

        Parameters
        ----------
        radius, title : optional
            See :meth:`view`.
        height : int, default 560
            In pixels.

        Returns
        -------
        anywidget.AnyWidget
            Its ``radius`` is that of the slider: what either side sets, the other sees.

        Raises
        ------
        MissingLibraryError
            If anywidget is not installed (the extra ``widget``).
        ParameterError
            If an argument is not what it must be.
        """
        from alphamesh.view import make_widget

        choice = self.choose_radius() if len(self.points) else None
        return make_widget(
            self.persistence(), choice, radius=radius, height=height, title=title
        )

    def _repr_html_(self) -> str:
        """Return what notebooks show: a small picture and facts; of huge clouds, facts."""
        from alphamesh.view.card import complex_card

        choice = shape = None
        if 0 < len(self.points) <= _MOST_PICTURED:
            choice = self.choose_radius()
            shape = self.at(choice.radius)
        return complex_card(self._filtration, choice, shape)
