"""Vector files through GDAL, by pyogrio: GeoJSON, GeoPackage, FlatGeobuf and shapefiles."""

from __future__ import annotations

import shutil
import tempfile
import warnings
import zipfile
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from alphamesh.errors import FileReadError, MissingLibraryError
from alphamesh.io._atomic import atomic_path

__all__ = [
    "reader",
    "write_flatgeobuf",
    "write_geojson",
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
            _with_named_index(frame), path, layer=layer, driver=driver, **options
        )


def _with_named_index(frame: Any) -> Any:
    """Return the table with its index as columns, if it has names."""
    if any(name is not None for name in frame.index.names):
        return frame.reset_index()
    return frame


def write_geojson(frame: Any, temporary: Path, path: Path, layer: str | None) -> None:
    """Write GeoJSON, with as many digits as float64 needs."""
    temporary.unlink()
    _write(frame, temporary, "GeoJSON", path.stem, SIGNIFICANT_FIGURES=17)


def write_geopackage(frame: Any, temporary: Path, path: Path, layer: str | None) -> None:
    """Write a GeoPackage, or one layer of the one that is there."""
    if layer is not None and path.exists():
        shutil.copyfile(path, temporary)
    else:
        temporary.unlink()
    _write(frame, temporary, "GPKG", layer or path.stem)


def write_flatgeobuf(frame: Any, temporary: Path, path: Path, layer: str | None) -> None:
    """Write FlatGeobuf; its index would sort the rows."""
    temporary.unlink()
    _write(frame, temporary, "FlatGeobuf", path.stem, SPATIAL_INDEX="NO")


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
        name = layer or _only_layer(pyogrio, path)
        info = pyogrio.read_info(path, layer=name, force_feature_count=True)
        if info["driver"] != driver:
            raise FileReadError(
                f"{path} is a file of {info['driver']}, not of {driver} as its name says; "
                "rename it, or pass file_format="
            )
        with warnings.catch_warnings():
            # GDAL tells of damage in warnings; a file that it doubts is not read by us.
            warnings.simplefilter("error", RuntimeWarning)
            frame = pyogrio.read_dataframe(path, layer=name)
        if not hasattr(frame, "geometry"):
            raise FileReadError(f"{path} holds no geometries in the layer {name!r}")
        if len(frame) != info["features"]:
            raise FileReadError(
                f"{path} is cut off: it promises {info['features']:,} rows and has "
                f"{len(frame):,}; write or copy it again"
            )
        return frame

    return read


def _only_layer(pyogrio: Any, path: Path) -> str:
    """Return the name of the one layer with geometries."""
    layers = [(str(name), kind) for name, kind in pyogrio.list_layers(path).tolist()]
    spatial = [name for name, kind in layers if kind is not None]
    if len(spatial) == 1:
        return spatial[0]
    listed = ", ".join(repr(name) for name, _ in layers[:12]) or "none"
    if not spatial:
        raise FileReadError(f"{path} has no layer with geometries; its layers: {listed}")
    raise FileReadError(f"{path} has several layers; choose with layer= one of: {listed}")
