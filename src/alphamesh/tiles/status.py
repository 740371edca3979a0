"""How far a run in a folder has come."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING

from alphamesh.errors import FileReadError
from alphamesh.tiles.store import Store

if TYPE_CHECKING:
    from typing import Any

__all__ = ["Status", "status"]


@dataclass(frozen=True, slots=True)
class Status:
    """The state of a run.

    Attributes
    ----------
    radius : float
    points : int
    chunks, chunks_done : int
        Parts of the data; how many have been sorted into tiles.
    tiles, tiles_done : int
        None tells that space has not been divided yet. A tile is done if all of its
        files are there and have their checksums.
    finished : bool
        Whether the facts about the whole are there.
    """

    radius: float
    points: int
    chunks: int
    chunks_done: int
    tiles: int | None
    tiles_done: int
    finished: bool


def status(folder: str | os.PathLike[str]) -> Status:
    """Tell how far the run in a folder has come.

    Raises
    ------
    FileReadError
        If no run was ever begun there.
    """
    store = Store(folder)
    manifest: dict[str, Any] | None = store.manifest()
    if manifest is None:
        raise FileReadError(f"{folder} holds no tiles; begin with: alphamesh tiles run")
    tiling = store.plan()
    finished = store.summary() is not None
    chunks, chunks_done = manifest["chunks"], 0
    if finished:
        chunks_done = chunks
    elif tiling is not None:
        chunks_done = sum(map(store.spool(tiling).holds, range(chunks)))
    return Status(
        radius=manifest["radius"],
        points=manifest["points"],
        chunks=chunks,
        chunks_done=chunks_done,
        tiles=None if tiling is None else len(tiling),
        tiles_done=0 if tiling is None else sum(map(store.has_tile, range(len(tiling)))),
        finished=finished,
    )
