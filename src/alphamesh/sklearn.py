"""Persistence diagrams as a step of scikit-learn's pipelines.

This module needs scikit-learn; nothing else of alphamesh does.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from numbers import Integral
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from alphamesh.complex import AlphaComplex
from alphamesh.errors import MissingLibraryError, ParameterError

try:
    from joblib import Parallel, delayed
    from sklearn.base import BaseEstimator, TransformerMixin
except ImportError as missing:
    raise MissingLibraryError.of("scikit-learn", "sklearn", "A transformer") from missing

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from alphamesh._arrays import FloatArray

__all__ = ["PersistenceTransformer"]

_FORMATS = ("arrays", "giotto")


class PersistenceTransformer(TransformerMixin, BaseEstimator):  # type: ignore[misc]
    """Turn each of a list of clouds into the persistence diagrams of its alpha complex.

    It stands where ``gudhi.sklearn`` or giotto-tda would compute diagrams. There is
    nothing to learn: `fit` only checks the parameters.

    Parameters
    ----------
    dimensions : int or sequence of int, default (0, 1)
        Which diagrams: 0 for components, 1 for loops, 2 for voids.
    squared : bool, default False
        Give squared radii, the values of GUDHI's alpha complexes.
    essential : bool, default True
        Keep the classes that never die; their death is infinite. Images and landscapes of
        diagrams need False.
    format : {"arrays", "giotto"}, default "arrays"
        "arrays": for each cloud a list with one ``(k, 2)`` array per dimension, or that
        array itself if `dimensions` is one number. "giotto": one ``(clouds, k, 3)`` array
        of births, deaths and dimensions, as giotto-tda has it; shorter diagrams are filled
        up with points on the diagonal.
    n_jobs : int, optional
        Clouds to work on at the same time, in threads; -1 for one per CPU.

    Examples
    --------
    >>> import alphamesh as am
    >>> from alphamesh.sklearn import PersistenceTransformer
    >>> clouds = [am.demo_cloud(name, 500, seed=1) for name in ("disc", "annulus")]
    >>> loops = PersistenceTransformer(dimensions=1).fit_transform(clouds)
    >>> [float((death - birth).max()) > 50 for birth, death in (d.T for d in loops)]
    [False, True]
    """

    def __init__(
        self,
        dimensions: int | Sequence[int] = (0, 1),
        *,
        squared: bool = False,
        essential: bool = True,
        format: Literal["arrays", "giotto"] = "arrays",  # noqa: A002 - the field's name
        n_jobs: int | None = None,
    ) -> None:
        self.dimensions = dimensions
        self.squared = squared
        self.essential = essential
        self.format = format
        self.n_jobs = n_jobs

    def fit(self, X: Iterable[ArrayLike], y: Any = None) -> PersistenceTransformer:
        """Check the parameters; the clouds are not looked at.

        Raises
        ------
        ParameterError
            If a parameter is not what it must be.
        """
        self._numbers()
        return self

    def transform(self, X: Iterable[ArrayLike]) -> list[Any] | FloatArray:
        """Return the diagrams of each cloud.

        Parameters
        ----------
        X : sequence of (n_i, d) array-like, or (clouds, n, d) array
            Whatever :class:`~alphamesh.AlphaComplex` takes.

        Returns
        -------
        list or (clouds, k, 3) float64
            As `format` says.

        Raises
        ------
        ParameterError
            If a parameter is not what it must be.
        CloudError
            If there is no alpha complex of a cloud; the message names the rows.
        """
        numbers = self._numbers()
        work = (delayed(self._diagrams)(cloud, numbers) for cloud in X)
        diagrams = list(Parallel(n_jobs=self.n_jobs, prefer="threads")(work))
        if self.format == "giotto":
            return _stacked(diagrams, numbers)
        return [one[0] for one in diagrams] if self._is_one_number() else diagrams

    def _diagrams(self, cloud: ArrayLike, numbers: Sequence[int]) -> list[FloatArray]:
        threads = None if self.n_jobs in (None, 1) else 1
        pairs = AlphaComplex(cloud, threads=threads).persistence()
        found = [pairs.diagram(k, squared=self.squared) for k in numbers]
        return found if self.essential else [rows[np.isfinite(rows[:, 1])] for rows in found]

    def _numbers(self) -> list[int]:
        if self.format not in _FORMATS:
            raise ParameterError(f"format must be one of {_FORMATS}; got {self.format!r}")
        given: Any = [self.dimensions] if self._is_one_number() else self.dimensions
        try:
            numbers = list(given)
        except TypeError:
            numbers = []
        if not numbers or any(isinstance(k, bool) or k not in (0, 1, 2) for k in numbers):
            raise ParameterError(
                "dimensions must be 0 (components), 1 (loops) or 2 (voids), or several of "
                f"them; got {self.dimensions!r}"
            )
        return [int(k) for k in numbers]

    def _is_one_number(self) -> bool:
        return isinstance(self.dimensions, Integral)

    def __sklearn_is_fitted__(self) -> bool:
        return True

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        tags.requires_fit = False
        tags.no_validation = True
        return tags


def _stacked(diagrams: list[list[FloatArray]], numbers: Sequence[int]) -> FloatArray:
    """Return diagrams as one array, those of each dimension filled up to the same length."""
    parts = [np.empty((len(diagrams), 0, 3))]
    for place, dimension in enumerate(numbers):
        columns = [diagram[place] for diagram in diagrams]
        part = np.zeros((len(diagrams), max(map(len, columns), default=0), 3))
        part[:, :, 2] = dimension
        for rows, column in zip(part, columns, strict=True):
            rows[: len(column), :2] = column
            rows[len(column) :, :2] = column[0, 0] if len(column) else 0.0
        parts.append(part)
    return np.concatenate(parts, axis=1)
