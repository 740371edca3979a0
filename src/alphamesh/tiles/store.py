"""A folder that holds a tiled complex, finished or not: what is there can be trusted.

Every file appears whole or not at all. A tile's record, which lists the checksums of its
files, is written after them: a tile without a record has to be computed (again).
"""

from __future__ import annotations

import hashlib
import json
import os
from dataclasses import asdict, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.errors import FileReadError, MissingLibraryError
from alphamesh.io._atomic import atomic_path
from alphamesh.tiles.labels import Border
from alphamesh.tiles.merge import Part, Summary, part_of
from alphamesh.tiles.pieces import Boundary, Piece
from alphamesh.tiles.tiling import Tiling

if TYPE_CHECKING:
    from alphamesh._arrays import CountArray, FloatArray

__all__ = ["TABLES", "Store"]

TABLES = ("vertices", "edges", "triangles", "tetrahedra")
"""The Parquet datasets in the folder, one file a tile in each; the last in space only."""

_MANIFEST, _PLAN, _SUMMARY = "manifest.json", "plan.npz", "summary.json"


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

    def plan(self) -> Tiling | None:
        """Return the tiling; None if there is none yet."""
        arrays = self._arrays(_PLAN)
        if arrays is None:
            return None
        dimension, *tree = (arrays[field.name] for field in fields(Tiling))
        return Tiling(int(dimension), *tree)

    def write_plan(self, tiling: Tiling) -> None:
        """Keep the tiling."""
        arrays = {field.name: getattr(tiling, field.name) for field in fields(Tiling)}
        self._write_arrays(_PLAN, arrays)

    def summary(self) -> Summary | None:
        """Return the facts about the whole; None before it is finished."""
        found = self._json(_SUMMARY)
        if found is None:
            return None
        lists = {name: tuple(found[name]) for name in ("betti", "counts")}
        return Summary(**(found | lists))

    def write_summary(self, summary: Summary) -> None:
        """Finish: keep the facts about the whole."""
        self._write_json(_SUMMARY, asdict(summary))

    # Points on their way from chunks to tiles

    def has_chunk(self, chunk: int) -> bool:
        """Tell whether a chunk has been spread over the tiles."""
        return self._chunk(chunk, "offsets").exists()

    def write_chunk(
        self, chunk: int, offsets: CountArray, rows: CountArray, points: FloatArray
    ) -> None:
        """Keep the points of a chunk, tile by tile."""
        for name, array in (("points", points), ("rows", rows), ("offsets", offsets)):
            with atomic_path(self._chunk(chunk, name)) as path, path.open("wb") as file:
                np.save(file, array, allow_pickle=False)

    def points_of(
        self, tile: int, chunks: int, dimension: int
    ) -> tuple[CountArray, FloatArray]:
        """Return rows and points of a tile and its halo, ascending by row."""
        rows, points = [np.empty(0, dtype=np.int64)], [np.empty((0, dimension))]
        for chunk in range(chunks):
            part = slice(*self._slice(chunk, "offsets", slice(tile, tile + 2)).tolist())
            if part.start < part.stop:
                rows.append(self._slice(chunk, "rows", part))
                points.append(self._slice(chunk, "points", part))
        return np.concatenate(rows), np.concatenate(points)

    def _slice(self, chunk: int, name: str, part: slice) -> Any:
        array = np.load(self._chunk(chunk, name), mmap_mode="r", allow_pickle=False)
        return np.array(array[part])

    def drop_chunks(self) -> None:
        """Delete the points on their way, once no tile needs them."""
        for file in (self.folder / "chunks").glob("*.npy"):
            file.unlink()

    def _chunk(self, chunk: int, name: str) -> Path:
        return self.folder / "chunks" / f"{chunk:06}.{name}.npy"

    # Tiles

    def has_tile(self, tile: int) -> bool:
        """Tell whether a tile is complete, by its checksums."""
        record = self._json(self._record(tile))
        return record is not None and all(
            (self.folder / name).exists() and _checksum(self.folder / name) == known
            for name, known in record["files"].items()
        )

    def write_tile(self, piece: Piece) -> None:
        """Keep a finished tile: its simplices, and what the whole needs to know of it."""
        tables = TABLES[: len(piece.simplices)]
        written = [self._write_table(name, piece) for name in tables]
        name = f"tiles/{piece.tile:06}.npz"
        self._write_arrays(name, _flat(piece))
        files = {name: _checksum(self.folder / name) for name in (*written, name)}
        self._write_json(self._record(piece.tile), {"tile": piece.tile, "files": files})

    def part(self, tile: int) -> tuple[Part, Boundary]:
        """Return what the whole needs to know of a finished tile.

        Raises
        ------
        FileReadError
            If the tile is not finished, or its files are damaged.
        """
        arrays = self._arrays(f"tiles/{tile:06}.npz") if self.has_tile(tile) else None
        if arrays is None:
            raise FileReadError(
                f"{self.folder}: tile {tile} is missing or damaged; run it again"
            )
        return _unflat(arrays)

    def _record(self, tile: int) -> str:
        return f"tiles/{tile:06}.json"

    def _write_table(self, name: str, piece: Piece) -> str:
        try:
            import pyarrow as pa
            import pyarrow.parquet as pq
        except ImportError as error:
            raise MissingLibraryError.of("pyarrow", "tiles", "writing tiles") from error
        file = f"{name}/part-{piece.tile:06}.parquet"
        table = pa.table(_columns(name, piece))
        with atomic_path(self.folder / file) as path:
            # Rows and radii hardly repeat: a dictionary of them costs more than it saves.
            pq.write_table(table, path, use_dictionary=False)
        return file

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

    def _write_json(self, name: str, content: dict[str, Any]) -> None:
        with atomic_path(self.folder / name) as path:
            path.write_text(json.dumps(content, indent=1), "utf-8")

    def _arrays(self, name: str) -> dict[str, Any] | None:
        path = self.folder / name
        if not path.exists():
            return None
        with np.load(path, allow_pickle=False) as arrays:
            return {key: read_only(arrays[key]) for key in arrays.files}

    def _write_arrays(self, name: str, arrays: dict[str, Any]) -> None:
        with atomic_path(self.folder / name) as path, path.open("wb") as file:
            np.savez(file, **arrays)


def _checksum(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _columns(name: str, piece: Piece) -> dict[str, Any]:
    """Return the columns of one of the tables."""
    if name == "vertices":
        places = dict(zip("xyz", piece.points.T, strict=False))
        return {"row": piece.rows, **places, "representative": piece.representative}
    k = TABLES.index(name)
    columns = {f"vertex{i}": rows for i, rows in enumerate(piece.simplices[k].T)}
    columns["radius"] = piece.radii[k]
    if k == len(piece.simplices) - 2:
        columns["kind"] = piece.facet_kinds
    return columns


_BOUNDARY = tuple(field.name for field in fields(Boundary))
_BORDERS = ("components", "regions", "fronts")


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
    return arrays | {f"boundary_{key}": getattr(piece.boundary, key) for key in _BOUNDARY}


def _unflat(arrays: dict[str, Any]) -> tuple[Part, Boundary]:
    borders = (
        Border(int(arrays[f"{name}_count"]), arrays[f"{name}_keys"], arrays[f"{name}_labels"])
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
