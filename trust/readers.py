"""Damaged files of every format: each must be read, or refused with a typed error.

A reader that raises anything else, warns of something unexpected, takes more than some
seconds or more memory than a small file can need, has failed. Each batch runs in a process
of its own with a limit on its memory, so that a crash is seen, too.
"""

from __future__ import annotations

import contextlib
import gzip
import io
import multiprocessing
import signal
import sys
import tempfile
import time
import warnings
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import alphamesh as am
from alphamesh.errors import AlphameshError, AlphameshWarning
from alphamesh.io.geo import GEO_FORMATS, read_geo, write_geo
from alphamesh.io.images import read_mask
from alphamesh.io.meshes import MESH_FORMATS, read_mesh
from alphamesh.io.molecules import read_molecule
from alphamesh.io.points import read_points, read_table

__all__ = ["campaign", "damaged", "outcome", "samples"]

_SECONDS = 20
_MEMORY = 3 << 30

Reader = Callable[[Path], object]


def samples(folder: Path) -> dict[str, tuple[bytes, Reader]]:
    """Return sound small files by their names, and what reads them."""
    points = np.random.default_rng(0).random((30, 2)) * 10
    found: dict[str, tuple[bytes, Reader]] = {}

    def keep(name: str, reader: Reader) -> None:
        found[name] = ((folder / name).read_bytes(), reader)

    table = "x,y,name\n" + "".join(f"{x},{y},p{k}\n" for k, (x, y) in enumerate(points))
    (folder / "points.csv").write_text(table)
    (folder / "points.tsv").write_text(table.replace(",", "\t"))
    (folder / "points.xyz").write_text("".join(f"{x} {y} {x + y}\n" for x, y in points))
    (folder / "points.csv.gz").write_bytes(gzip.compress(table.encode()))
    np.save(folder / "points.npy", points)
    np.savez_compressed(folder / "points.npz", points=points)
    _parquet(folder / "points.parquet", points)
    _scans(folder, points)
    for name in ("csv", "tsv", "xyz", "csv.gz", "npy", "npz", "parquet", "las", "laz", "pcd"):
        keep(f"points.{name}", _read_points_and_table)
    keep("layers.laz", _read_points_and_table)
    _molecules(folder, points[:6])
    for name in ("atoms.pdb", "atoms.cif"):
        keep(name, _read_molecule_and_points)
    shape = am.AlphaComplex(points).at(1.5)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AlphameshWarning)
        for extension, known in MESH_FORMATS.items():
            if known.read is not None:
                shape.save(folder / f"mesh{extension}")
                keep(f"mesh{extension}", read_mesh)
    found["scan.ply"] = (found["mesh.ply"][0], _read_points_and_table)
    for name in _geographic(folder, points):
        keep(name, _read_geo_and_points)
    _images(folder)
    for name in ("png", "tif", "gif", "jpg", "bmp"):
        keep(f"mask.{name}", read_mask)
    return found


def _read_points_and_table(path: Path) -> None:
    read_points(path)
    read_table(path)


def _read_geo_and_points(path: Path) -> None:
    read_geo(path)
    if path.suffix != ".wkb":
        read_points(path)


def _read_molecule_and_points(path: Path) -> None:
    read_molecule(path)
    read_points(path)


def _scans(folder: Path, points: Any) -> None:
    import laspy
    import pypcd4

    header = laspy.LasHeader(point_format=3, version="1.2")
    header.scales = np.array([0.001, 0.001, 0.001])
    scan = laspy.LasData(header)
    scan.x, scan.y, scan.z = points[:, 0], points[:, 1], points.sum(axis=1)
    scan.write(folder / "points.las")
    scan.write(folder / "points.laz")
    laspy.convert(scan, point_format_id=8).write(folder / "layers.laz")
    places = np.column_stack((points, points.sum(axis=1))).astype(np.float32)
    pypcd4.PointCloud.from_xyz_points(places).save(folder / "points.pcd")


def _molecules(folder: Path, points: Any) -> None:
    import gemmi

    structure = gemmi.Structure()
    chain = gemmi.Chain("A")
    for number, (x, y) in enumerate(points.tolist()):
        atom = gemmi.Atom()
        atom.name, atom.element = "CA", gemmi.Element("C")
        atom.pos = gemmi.Position(x, y, x + y)
        residue = gemmi.Residue()
        residue.name, residue.seqid = "ALA", gemmi.SeqId(str(number))
        residue.add_atom(atom)
        chain.add_residue(residue)
    model = gemmi.Model(1)
    model.add_chain(chain)
    structure.add_model(model)
    structure.setup_entities()
    structure.write_pdb(str(folder / "atoms.pdb"))
    structure.make_mmcif_document().write_file(str(folder / "atoms.cif"))


def _geographic(folder: Path, points: Any) -> list[str]:
    """Write one file of each format of a GIS; return their names."""
    import geopandas
    import shapely

    columns = {"height": points[:, 0], "name": [f"p{k}" for k in range(len(points))]}
    frame = geopandas.GeoDataFrame(columns, geometry=shapely.points(points), crs=25832)
    names = [f"places{extension}" for extension in GEO_FORMATS if extension != ".shp"]
    for name in names:
        rows = frame.iloc[:5] if name.endswith(".gpkg") else frame
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", AlphameshWarning)
            write_geo(rows, folder / name)
    return names


def _parquet(path: Path, points: Any) -> None:
    import pyarrow as pa
    import pyarrow.parquet as pq

    pq.write_table(pa.table({"x": points[:, 0], "y": points[:, 1]}), path)


def _images(folder: Path) -> None:
    from PIL import Image

    mask = am.demo_mask("annulus", size=64).astype(np.uint8) * 255
    for name in ("png", "tif", "gif", "jpg", "bmp"):
        Image.fromarray(mask).save(folder / f"mask.{name}")


_WORDS = (
    b"nan", b"inf", b"-1", b"999999999999999999999", b"1e400", b"2147483648", b"\x00",
    b"\xff\xff\xff\xff", b"\xff\xff\xff\x7f", b"\x00\x00\x00\x80", b'"', b"\n" * 3, b"\xfe\xff",
    b"../../x", b"[" * 2000,
)  # fmt: skip


def damaged(content: bytes, rng: np.random.Generator) -> bytes:
    """Return a file that was cut off, or changed in a few places."""
    data = bytearray(content)
    for _ in range(int(rng.integers(1, 4))):
        at = int(rng.integers(0, max(1, len(data))))
        if rng.random() < 0.4:  # headers decide most
            at = min(at, int(rng.integers(0, 200)))
        what = int(rng.integers(6))
        if what == 0:
            del data[at:]
        elif what == 1 and data:
            data[at % len(data)] ^= 1 << int(rng.integers(8))
        elif what == 2:
            del data[at : at + int(rng.integers(1, 40))]
        elif what == 3:
            data[at:at] = data[at : at + int(rng.integers(1, 40))]
        elif what == 4:
            data[at : at + int(rng.integers(0, 8))] = _WORDS[int(rng.integers(len(_WORDS)))]
        else:
            data[at : at + 4] = bytes(reversed(data[at : at + 4]))
    return bytes(data)


class _TooSlowError(Exception):
    pass


def _alarm(number: int, frame: object) -> None:
    raise _TooSlowError(f"more than {_SECONDS} s")


def outcome(name: str, content: bytes, reader: Reader, folder: Path) -> str:
    """Read `content` as a file of that name: "read" or "refused"; all else is raised."""
    path = folder / name
    path.write_bytes(content)
    # Libraries that we read with also complain on the terminal.
    silent = io.StringIO()
    with (
        warnings.catch_warnings(),
        contextlib.redirect_stdout(silent),
        contextlib.redirect_stderr(silent),
    ):
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", AlphameshWarning)
        # What GDAL has to say of a damaged file, it says as it reads.
        warnings.filterwarnings("ignore", category=RuntimeWarning, module="pyogrio")
        try:
            reader(path)
        except AlphameshError:
            return "refused"
    return "read"


def _batch(task: tuple[int, int]) -> tuple[Counter[str], list[str]]:
    first, count = task
    _limit()
    tally: Counter[str] = Counter()
    failures = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        sound = samples(folder)
        names = list(sound)
        for seed in range(first, first + count):
            rng = np.random.default_rng(seed)
            file = names[int(rng.integers(len(names)))]
            content, reader = sound[file]
            signal.setitimer(signal.ITIMER_REAL, _SECONDS)
            try:
                tally[outcome(file, damaged(content, rng), reader, folder)] += 1
            except BaseException as error:
                tally["failed"] += 1
                failures.append(f"seed {seed}, {file}: {type(error).__name__}: {error}"[:400])
            finally:
                signal.setitimer(signal.ITIMER_REAL, 0)
    return tally, failures


def _limit() -> None:
    import resource

    signal.signal(signal.SIGALRM, _alarm)
    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))


def campaign(
    count: int, *, first: int = 0, processes: int = 1, size: int = 500
) -> dict[str, Any]:
    """Read many damaged files.

    Returns
    -------
    dict
        How many were read all the same, refused, or failed; the seconds.
    """
    start = time.perf_counter()
    tasks = [(k, min(size, first + count - k)) for k in range(first, first + count, size)]
    tally: Counter[str] = Counter()
    context = multiprocessing.get_context("spawn")
    with context.Pool(processes, maxtasksperchild=1) as pool:
        for found, messages in pool.imap_unordered(_batch, tasks):
            tally.update(found)
            for message in messages:
                print(message, file=sys.stderr)
    return {
        "campaign": "damaged files",
        "cases": count,
        "read": tally["read"],
        "refused": tally["refused"],
        "failed": tally["failed"],
        "seconds": round(time.perf_counter() - start),
    }
