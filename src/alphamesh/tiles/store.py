"""A folder that holds a tiled complex, finished or not: what is there can be trusted.

Every file appears whole or not at all. A tile's record, which lists the checksums of its
files, is written after them: a tile without a record has to be computed (again). Files of
tiles are not forced to the disk one by one; what a power failure makes of them, the
checksums tell.
"""

from __future__ import annotations

import json
import os
from dataclasses import asdict, fields
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.errors import FileReadError
from alphamesh.io._atomic import atomic_path
from alphamesh.tiles.direct import checksum_of, write_direct
from alphamesh.tiles.labels import Border
from alphamesh.tiles.merge import Part, Summary, part_of
from alphamesh.tiles.parquet import write_parquet
from alphamesh.tiles.pieces import Boundary, Piece
from alphamesh.tiles.spool import Spool
from alphamesh.tiles.tiling import Tiling
from alphamesh.tiles.weighing import WeightRange

if TYPE_CHECKING:
    from alphamesh._arrays import CountArray

__all__ = ["TABLES", "Store"]

TABLES = ("vertices", "edges", "triangles", "tetrahedra")
"""The Parquet datasets in the folder, one file a tile in each; the last in space only."""

_RANGE = "weight_range"
_MANIFEST, _PLAN, _SUMMARY = "manifest.json", "plan.npz", "summary.json"


class _Plan(NamedTuple):
    tiling: Tiling
    first_rows: CountArray
    weights: WeightRange | None


class Store:
    """The files of a tiled complex.

    Parameters
    ----------
    folder : path-like
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder)

    # The run as a whole

    def manifest(self) -> dict[str, Any] | None:
        """Return what the folder was made for; None if there is nothing."""
        return self._json(_MANIFEST)

    def write_manifest(self, manifest: dict[str, Any]) -> None:
        """Begin: remember what the folder is for."""
        tables = TABLES[: manifest["dimension"] + 1]
        for name in ("chunks", "tiles", *tables):
            (self.folder / name).mkdir(parents=True, exist_ok=True)
        self._write_json(_MANIFEST, manifest)

    @property
    def periods(self) -> tuple[float | None, ...] | None:
        """The sides of the periodic box, None for open directions; None if there is none."""
        known = (self.manifest() or {}).get("periods")
        return None if known is None else tuple(known)

    def plan(self) -> Tiling | None:
        """Return the tiling; None if there is none yet."""
        known = self._known_plan()
        return None if known is None else known.tiling

    def first_rows(self) -> CountArray:
        """Return the first row of each chunk of the data, once there is a plan."""
        known = self._known_plan()
        assert known is not None
        return known.first_rows

    def weight_range(self) -> WeightRange | None:
        """Return the range of the weights once there is a plan; None if there are none."""
        known = self._known_plan()
        return None if known is None else known.weights

    def _known_plan(self) -> _Plan | None:
        """Return what :meth:`write_plan` kept, read once for all tasks of a process."""
        path = self.folder / _PLAN
        try:
            state = path.stat()
        except FileNotFoundError:
            return None
        return _plan_in(path, (state.st_mtime_ns, state.st_size, state.st_ino))

    def write_plan(
        self, tiling: Tiling, first_rows: CountArray, weights: WeightRange | None = None
    ) -> None:
        """Keep the tiling, where chunks begin, and the range of the weights."""
        arrays = {field.name: getattr(tiling, field.name) for field in fields(Tiling)}
        if weights is not None:
            arrays[_RANGE] = np.array([weights.least, weights.greatest])
        self._write_arrays(_PLAN, arrays | {"first_rows": first_rows})

    def summary(self) -> Summary | None:
        """Return the facts about the whole; None before it is finished."""
        found = self._json(_SUMMARY)
        if found is None:
            return None
        lists = {name: tuple(list_) for name, list_ in found.items() if isinstance(list_, list)}
        return Summary(**(found | lists))

    def write_summary(self, summary: Summary) -> None:
        """Finish: keep the facts about the whole."""
        self._write_json(_SUMMARY, asdict(summary))

    # Points on their way from chunks to tiles

    def spool(self, tiling: Tiling) -> Spool:
        """Return the files of points, of their weights and moves on their way."""
        columns = tiling.dimension + (self.weight_range() is not None)
        columns += self.periods is not None
        return Spool(self.folder / "chunks", columns, len(tiling))

    # Tiles

    def has_tile(self, tile: int) -> bool:
        """Tell whether a tile is complete, by its checksums."""
        sums = self._sums(tile)
        return bool(sums) and all(
            _checksum(self.folder / name) == known for name, known in sums.items()
        )

    def write_tile(self, piece: Piece) -> None:
        """Keep a finished tile: its simplices, and what the whole needs to know of it."""
        tables = TABLES[: len(piece.simplices)]
        files = dict(self._write_table(name, piece) for name in tables)
        name = self._summary(piece.tile)
        self._write_arrays(name, _flat(piece), forced=False)
        files[name] = _shown(checksum_of(self.folder / name))
        record = {"tile": piece.tile, "files": files}
        self._write_json(self._record(piece.tile), record, forced=False)

    def part(self, tile: int) -> tuple[Part, Boundary]:
        """Return what the whole needs to know of a finished tile.

        Raises
        ------
        FileReadError
            If the tile is not finished, or this file of it is damaged.
        """
        name = self._summary(tile)
        if _checksum(self.folder / name) != self._sums(tile).get(name, ""):
            raise FileReadError(
                f"{self.folder}: tile {tile} is missing or damaged; run it again"
            )
        arrays = self._arrays(name)
        assert arrays is not None
        return _unflat(arrays)

    def _summary(self, tile: int) -> str:
        return f"tiles/{tile:06}.npz"

    def _sums(self, tile: int) -> dict[str, str]:
        """Return the checksums of a tile's files; none without a record that is whole."""
        try:
            record = self._json(self._record(tile))
        except FileReadError:
            return {}
        return {} if record is None else record["files"]

    def _record(self, tile: int) -> str:
        return f"tiles/{tile:06}.json"

    def _write_table(self, name: str, piece: Piece) -> tuple[str, str]:
        """Write a table; return the name of its file, and the checksum."""
        name_of_file = f"{name}/part-{piece.tile:06}.parquet"
        target = self.folder / name_of_file
        with atomic_path(target, forced=False) as path, write_direct(path) as file:
            # Where points lie is worth a note; rows and radii lie anywhere.
            write_parquet(file, _columns(name, piece), ranges="xyz")
        return name_of_file, _shown(file.sum)

    # Files

    def _json(self, name: str) -> dict[str, Any] | None:
        try:
            found: dict[str, Any] = json.loads((self.folder / name).read_text("utf-8"))
        except FileNotFoundError:
            return None
        except ValueError as error:
            raise FileReadError(
                f"{self.folder / name} is damaged ({error}); start again with overwrite=True"
            ) from error
        return found

    def _write_json(self, name: str, content: dict[str, Any], *, forced: bool = True) -> None:
        with atomic_path(self.folder / name, forced=forced) as path:
            path.write_text(json.dumps(content, indent=1), "utf-8")

    def _arrays(self, name: str) -> dict[str, Any] | None:
        path = self.folder / name
        return _arrays_in(path) if path.exists() else None

    def _write_arrays(self, name: str, arrays: dict[str, Any], *, forced: bool = True) -> None:
        with (
            atomic_path(self.folder / name, forced=forced) as path,
            path.open("wb") as file,
        ):
            np.savez(file, **arrays)


def _arrays_in(path: Path) -> dict[str, Any]:
    with np.load(path, allow_pickle=False) as arrays:
        return {key: read_only(arrays[key]) for key in arrays.files}


@lru_cache(maxsize=1)
def _plan_in(path: Path, _state: tuple[int, ...]) -> _Plan:
    """Read a plan, unless the file is the same as the last time."""
    arrays = _arrays_in(path)
    dimension, *tree = (arrays[field.name] for field in fields(Tiling))
    weights = WeightRange(*arrays[_RANGE].tolist()) if _RANGE in arrays else None
    return _Plan(Tiling(int(dimension), *tree), arrays["first_rows"], weights)


def _checksum(path: Path) -> str | None:
    """Return the checksum of a file as it is read back; None if there is none."""
    return _shown(checksum_of(path)) if path.exists() else None


def _shown(total: int) -> str:
    return f"{total:016x}"


def _columns(name: str, piece: Piece) -> dict[str, Any]:
    """Return the columns of one of the tables."""
    if name == "vertices":
        places = dict(zip("xyz", piece.points.T, strict=False))
        columns = {"row": piece.rows, **places, "representative": piece.representative}
        if piece.weights is not None:
            # Of points that are no vertices up to the radius, nothing is known.
            radii = np.full(len(piece.rows), np.nan)
            radii[np.searchsorted(piece.rows, piece.simplices[0][:, 0])] = piece.radii[0]
            columns |= {"weight": piece.weights, "radius": radii}
        return columns
    k = TABLES.index(name)
    columns = {f"vertex{i}": rows for i, rows in enumerate(piece.simplices[k].T)}
    if piece.offsets is not None:
        for i in range(1, k + 1):  # those of the first are zero
            moves = np.ascontiguousarray(piece.offsets[k][:, i].T)
            columns |= {f"offset{i}{axis}": m for axis, m in zip("xyz", moves, strict=False)}
    columns["radius"] = piece.radii[k]
    if k == len(piece.simplices) - 2:
        columns["kind"] = piece.facet_kinds
    return columns


_BOUNDARY = tuple(field.name for field in fields(Boundary))
_BORDERS = ("components", "regions", "fronts")
_MOVES = "components_moves"


def _flat(piece: Piece) -> dict[str, Any]:
    """Return part and boundary of a piece as named arrays."""
    part = part_of(piece)
    arrays: dict[str, Any] = {
        field.name: getattr(part, field.name)
        for field in fields(Part)
        if field.name not in _BORDERS
    }
    for name in _BORDERS:
        border: Border = getattr(part, name)
        arrays |= {f"{name}_{key}": getattr(border, key) for key in ("count", "keys", "labels")}
    if part.components.moves is not None:
        arrays[_MOVES] = part.components.moves
    return arrays | {f"boundary_{key}": getattr(piece.boundary, key) for key in _BOUNDARY}


def _unflat(arrays: dict[str, Any]) -> tuple[Part, Boundary]:
    borders = (
        Border(
            int(arrays[f"{name}_count"]),
            arrays[f"{name}_keys"],
            arrays[f"{name}_labels"],
            arrays.get(_MOVES) if name == "components" else None,
        )
        for name in _BORDERS
    )
    part = Part(
        int(arrays["points"]),
        arrays["counts"],
        arrays["facet_kinds"],
        float(arrays["boundary_size"]),
        arrays["region_sizes"],
        *borders,
    )
    return part, Boundary(*(arrays[f"boundary_{key}"] for key in _BOUNDARY))
