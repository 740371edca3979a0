"""Vector files through GDAL, by pyogrio: GeoJSON, GeoPackage, FlatGeobuf and shapefiles."""

from __future__ import annotations

import shutil
import tempfile
import warnings
import zipfile
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from alphamesh.errors import FileReadError, MissingLibraryError
from alphamesh.io._atomic import atomic_path
from alphamesh.io._geo_frames import with_named_index

__all__ = [
    "reader",
    "write_flatgeobuf",
    "write_geopackage",
    "write_shapefile",
    "write_zipped_shapefile",
]

# What a shapefile may consist of besides: indexes and metadata of other programs.
_PARTS = (".shx", ".dbf", ".prj", ".cpg", ".qix", ".sbn", ".sbx", ".qpj", ".shp.xml")


def _pyogrio(purpose: str) -> Any:
    try:
        import pyogrio
    except ImportError as missing:
        raise MissingLibraryError.of("pyogrio", "geo", purpose) from missing
    return pyogrio


def _write(frame: Any, path: Path, driver: str, layer: str, **options: Any) -> None:
    """Write a table by one of GDAL's drivers."""
    pyogrio = _pyogrio(f"Writing {driver} files")
    with warnings.catch_warnings():
        # Tables without a reference system are written without one.
        warnings.filterwarnings("ignore", "'crs' was not provided", UserWarning)
        pyogrio.write_dataframe(
            with_named_index(frame), path, layer=layer, driver=driver, **options
        )


def write_geopackage(frame: Any, temporary: Path, path: Path, layer: str | None) -> None:
    """Write a GeoPackage, or one layer of the one that is there."""
    with _named(temporary, ".gpkg") as made:
        if layer is not None and path.exists():
            shutil.copyfile(path, made)
        _write(frame, made, "GPKG", layer or path.stem)


def write_flatgeobuf(frame: Any, temporary: Path, path: Path, layer: str | None) -> None:
    """Write FlatGeobuf; its index would sort the rows."""
    with _named(temporary, ".fgb") as made:
        _write(frame, made, "FlatGeobuf", path.stem, SPATIAL_INDEX="NO")


@contextmanager
def _named(temporary: Path, suffix: str) -> Iterator[Path]:
    """Give a file with the extension that a driver wants; then fill `temporary` with it."""
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder, f"made{suffix}")
        yield made
        shutil.copyfile(made, temporary)


def write_zipped_shapefile(frame: Any, temporary: Path, path: Path, layer: str | None) -> None:
    """Write the files of a shapefile into one archive."""
    stem = path.name.removesuffix(path.suffix).removesuffix(".shp")
    with tempfile.TemporaryDirectory() as folder:
        _write(frame, Path(folder, f"{stem}.shp"), "ESRI Shapefile", stem)
        with zipfile.ZipFile(temporary, "w", zipfile.ZIP_DEFLATED) as archive:
            for part in sorted(Path(folder).iterdir()):
                archive.write(part, part.name)


def write_shapefile(frame: Any, _: Path, path: Path, layer: str | None) -> None:
    """Write the files of a shapefile; none takes its name before all are complete."""
    with tempfile.TemporaryDirectory() as folder, ExitStack() as files:
        _write(frame, Path(folder, f"{path.stem}.shp"), "ESRI Shapefile", path.stem)
        # Those entered last take their names first: the .shp when all others are there.
        made = sorted(Path(folder).iterdir(), key=lambda part: part.suffix != ".shp")
        for part in made:
            target = files.enter_context(atomic_path(path.with_suffix(part.suffix)))
            shutil.copyfile(part, target)
    kept = {part.suffix for part in made}
    for suffix in _PARTS:
        if suffix not in kept:  # an index or a reference system of the older file
            path.with_suffix(suffix).unlink(missing_ok=True)


def reader(driver: str) -> Callable[[Path, str | None], Any]:
    """Return a function that reads files of one of GDAL's drivers."""

    def read(path: Path, layer: str | None) -> Any:
        pyogrio = _pyogrio(f"Reading {driver} files")
        with warnings.catch_warnings():
            # Of names that do not go with a format; what it is, is looked at below.
            warnings.simplefilter("ignore", RuntimeWarning)
            name = layer or _only_layer(pyogrio, path, driver)
            info = pyogrio.read_info(path, layer=name, force_feature_count=True)
        _refuse_driver(path, info["driver"], driver)
        if path.suffix.lower() == ".shp":
            _refuse_short_shapefile(path)
        frame = pyogrio.read_dataframe(path, layer=name)
        if not hasattr(frame, "geometry"):
            raise FileReadError(f"{path} has no geometries in the layer {name!r}")
        if len(frame) != info["features"]:
            raise FileReadError(
                f"{path} is cut off: it promises {info['features']:,} rows and has "
                f"{len(frame):,}; write or copy it again"
            )
        return frame

    return read


def _only_layer(pyogrio: Any, path: Path, driver: str) -> str:
    """Return the name of the one layer with geometries."""
    layers = [(str(name), kind) for name, kind in pyogrio.list_layers(path).tolist()]
    if layers:
        info = pyogrio.read_info(path, layer=layers[0][0])
        _refuse_driver(path, info["driver"], driver)
    spatial = [name for name, kind in layers if kind is not None]
    if len(spatial) == 1:
        return spatial[0]
    listed = ", ".join(repr(name) for name, _ in layers[:12]) or "none"
    if not spatial:
        raise FileReadError(f"{path} has no layer with geometries; its layers: {listed}")
    raise FileReadError(f"{path} has several layers; choose with layer= one of: {listed}")


def _refuse_driver(path: Path, found: str, driver: str) -> None:
    if found != driver:
        raise FileReadError(
            f"{path} is a file of {found}, not of {driver} as its name says; rename it, or "
            "pass file_format="
        )


def _refuse_short_shapefile(path: Path) -> None:
    """Refuse a shapefile that is shorter than it says; GDAL reads on without a word."""
    for part in (path, path.with_suffix(".shx")):
        if not part.exists():
            continue
        with part.open("rb") as file:
            words = int.from_bytes(file.read(28)[24:], "big")
        if part.stat().st_size < 2 * words:
            raise FileReadError(
                f"{part} is cut off: it promises {2 * words:,} bytes and has "
                f"{part.stat().st_size:,}; write or copy it again"
            )
