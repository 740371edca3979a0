"""Surfaces and solids in files and in the hands of other libraries; clouds of scanners."""

from __future__ import annotations

import io
import struct
import sys
from importlib.util import find_spec

import numpy as np
import pytest

import alphamesh as am
from alphamesh.errors import FileReadError, MissingLibraryError
from alphamesh.io.meshes import read_mesh
from alphamesh.io.points import read_points

SURFACE_FORMATS = (".ply", ".obj", ".off", ".stl", ".vtu", ".vtk", ".msh", ".npz")
VOLUME_FORMATS = (".vtu", ".vtk", ".msh", ".npz")
NEEDS_MESHIO = pytest.mark.skipif(find_spec("meshio") is None, reason="meshio is missing")


@pytest.fixture(scope="module")
def shape():
    return am.AlphaComplex(am.sample_solid("hollow-torus", 4000, seed=1)).at(0.165)


@pytest.fixture(scope="module")
def ragged():
    """A complex with simplices of every kind."""
    return am.AlphaComplex(am.sample_solid("torus", 600, seed=1)).at(0.1)


@pytest.fixture
def without(monkeypatch):
    """Return a function that makes a library impossible to import."""

    def hide(name):
        monkeypatch.setitem(sys.modules, name, None)

    return hide


# ---------------------------------------------------------------------- files


@NEEDS_MESHIO
@pytest.mark.parametrize("extension", SURFACE_FORMATS)
def test_surfaces_come_back(shape, tmp_path, extension):
    surface = shape.surface()
    path = tmp_path / f"surface{extension}"
    surface.save(path)
    back = read_mesh(path)
    rounded = np.float32 if extension == ".stl" else np.float64
    np.testing.assert_array_equal(
        back.points[back.cells["triangle"]],
        surface.points[surface.triangles].astype(rounded).astype(np.float64),
    )
    if extension in (".ply", *VOLUME_FORMATS):
        np.testing.assert_array_equal(back.point_data["input_row"], surface.source_rows)
    if extension in VOLUME_FORMATS:
        labels = back.cell_data["shell"]["triangle"]
        np.testing.assert_array_equal(labels, surface.shell_labels)


@pytest.mark.parametrize("extension", [".ply", ".obj", ".off", ".stl"])
def test_trimesh_reads_them_as_closed_volumes(shape, tmp_path, extension):
    trimesh = pytest.importorskip("trimesh")
    surface = shape.surface()
    # Points that are pinched would be merged again by trimesh.
    assert len(np.unique(surface.source_rows)) == len(surface.source_rows)
    path = tmp_path / f"surface{extension}"
    surface.save(path)
    mesh = trimesh.load_mesh(path)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.euler_number == 0
    assert mesh.body_count == 2
    assert mesh.volume == pytest.approx(shape.volume, rel=1e-5)


@NEEDS_MESHIO
@pytest.mark.parametrize("extension", VOLUME_FORMATS)
def test_solids_come_back_with_their_tetrahedra(ragged, tmp_path, extension):
    path = tmp_path / f"solid{extension}"
    ragged.save(path)
    back = read_mesh(path)
    rows = back.point_data["input_row"].astype(int)
    wanted = {
        "tetra": ragged.tetrahedra,
        "triangle": ragged.singular_triangles,
        "line": ragged.isolated_edges,
        "vertex": ragged.isolated_vertices[:, np.newaxis],
    }
    for kind, simplices in wanted.items():
        assert len(simplices) > 0, kind
        np.testing.assert_array_equal(rows[back.cells[kind]], simplices)
    corners = back.points[back.cells["tetra"]]
    volumes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
    assert (volumes > 0).all()
    assert volumes.sum() == pytest.approx(ragged.volume)


def test_vtk_reads_both(ragged, tmp_path):
    pyvista = pytest.importorskip("pyvista")
    pytest.importorskip("meshio")
    for extension in (".vtu", ".vtk"):
        path = tmp_path / f"solid{extension}"
        ragged.save(path)
        grid = pyvista.read(path)
        assert grid.n_cells == sum(
            ragged.counts[kind]
            for kind in (
                "tetrahedra",
                "singular_triangles",
                "isolated_edges",
                "isolated_vertices",
            )
        )
        # VTK measures lines and triangles, too: 0 is their volume.
        assert grid.compute_cell_sizes()["Volume"].sum() == pytest.approx(ragged.volume)
    path = tmp_path / "surface.ply"
    ragged.surface().save(path)
    assert pyvista.read(path).is_manifold


# ---------------------------------------------------------------------- other libraries


def test_to_trimesh(shape):
    pytest.importorskip("trimesh")
    surface = shape.surface()
    mesh = surface.to_trimesh()
    np.testing.assert_array_equal(mesh.faces, surface.triangles)
    np.testing.assert_array_equal(mesh.vertices, surface.points)
    np.testing.assert_array_equal(mesh.vertex_attributes["input_row"], surface.source_rows)
    np.testing.assert_array_equal(mesh.face_attributes["shell"], surface.shell_labels)
    assert mesh.vertices.flags.writeable


def test_to_pyvista(ragged, shape):
    pyvista = pytest.importorskip("pyvista")
    grid = ragged.to_pyvista()
    assert isinstance(grid, pyvista.UnstructuredGrid)
    cells = grid.cells_dict
    np.testing.assert_array_equal(cells[pyvista.CellType.TETRA], ragged.tetrahedra)
    np.testing.assert_array_equal(cells[pyvista.CellType.TRIANGLE], ragged.singular_triangles)
    np.testing.assert_array_equal(cells[pyvista.CellType.LINE], ragged.isolated_edges)
    assert (grid.cell_data["radius"] <= ragged.radius).all()
    surface = shape.surface()
    poly = surface.to_pyvista()
    assert isinstance(poly, pyvista.PolyData)
    assert poly.n_open_edges == 0
    assert poly.is_manifold
    assert poly.volume == pytest.approx(shape.volume, rel=1e-4)  # VTK rounds to 32 bits
    rows = poly.point_data["input_row"][poly.regular_faces]
    np.testing.assert_array_equal(shape.points[rows], surface.points[surface.triangles])
    empty = am.AlphaComplex(np.empty((0, 3))).at(1)
    assert empty.to_pyvista().n_cells == 0


def test_to_meshio(ragged, shape):
    pytest.importorskip("meshio")
    mesh = ragged.to_meshio()
    np.testing.assert_array_equal(mesh.cells_dict["tetra"], ragged.tetrahedra)
    np.testing.assert_array_equal(mesh.points, ragged.points)
    assert set(mesh.cell_data) == {"radius"}
    mesh = shape.surface().to_meshio()
    np.testing.assert_array_equal(mesh.cells_dict["triangle"], shape.surface().triangles)


def test_to_open3d(shape):
    pytest.importorskip("open3d")
    mesh = shape.to_open3d()
    np.testing.assert_array_equal(np.asarray(mesh.triangles), shape.surface().triangles)
    assert mesh.is_watertight()


@pytest.mark.parametrize("library", ["trimesh", "pyvista", "meshio", "open3d"])
def test_missing_libraries_are_named(shape, without, library):
    without(library)
    for thing in (shape, shape.surface()):
        with pytest.raises(MissingLibraryError, match=rf"{library}.*pip install \"alphamesh\["):
            getattr(thing, f"to_{library}")()


# ---------------------------------------------------------------------- scanners


@pytest.fixture(scope="module")
def scanned():
    # Quarters of a millimetre, as whole numbers in the file.
    rng = np.random.default_rng(1)
    return 4_500_000 + rng.integers(0, 4000, (200, 3)) / 4000


@pytest.fixture
def las(scanned, tmp_path):
    laspy = pytest.importorskip("laspy")

    def write(name):
        header = laspy.LasHeader(point_format=3, version="1.2")
        header.offsets, header.scales = scanned.min(axis=0), np.full(3, 1 / 4000)
        cloud = laspy.LasData(header)
        cloud.x, cloud.y, cloud.z = scanned.T
        cloud.intensity = np.arange(len(scanned), dtype=np.uint16)
        path = tmp_path / name
        cloud.write(str(path))
        return path

    return write


@pytest.mark.parametrize("name", ["scan.las", "scan.laz", "SCAN.LAZ"])
def test_las_files_are_read(las, scanned, name):
    if name.lower().endswith("laz"):
        pytest.importorskip("lazrs")
    path = las(name)
    points = read_points(path)
    assert points.shape == (200, 3)
    np.testing.assert_allclose(points, scanned, rtol=0, atol=1e-9)
    np.testing.assert_array_equal(read_points(path, dimension=2), points[:, :2])
    table = am.read_table(path)
    np.testing.assert_array_equal(table.points, points)
    np.testing.assert_array_equal(table.columns["intensity"], np.arange(200))
    assert not {"x", "y", "z", "X"} & set(table.columns)
    chosen = read_points(path, columns=("z", "intensity"))
    np.testing.assert_array_equal(chosen, np.column_stack([points[:, 2], np.arange(200.0)]))
    assert am.AlphaComplex(points - points[0]).dimension == 3


def test_damaged_las_files_are_refused(las, tmp_path):
    whole = las("scan.las").read_bytes()
    for name, data, message in (
        ("cut.las", whole[:-400], "cut off|not a complete"),
        ("header.las", whole[:100], "not a complete"),
        ("other.las", b"ply\n" + whole[4:], "not a LAS file"),
    ):
        (tmp_path / name).write_bytes(data)
        with pytest.raises(FileReadError, match=message):
            read_points(tmp_path / name)
    with pytest.raises(FileReadError, match="no column 'colour'"):
        read_points(las("scan.las"), columns=("x", "colour"))


def changed(data, at, form, *numbers):
    return data[:at] + struct.pack(form, *numbers) + data[at + struct.calcsize(form) :]


def test_headers_that_promise_too_much_are_refused_at_once(las, tmp_path):
    """Found by fuzzing: laspy reads millions of empty records, for minutes."""
    whole = las("scan.las").read_bytes()
    later = changed(whole, 24, "<BB", 1, 4)  # as of version 1.4, which knows of EVLR
    for name, data, message in (
        ("vlr.las", changed(whole, 100, "<I", 50_000_000), "50000000 records .VLR."),
        ("evlr.las", changed(later, 235, "<QI", 300, 2**31), "2147483648 records .EVLR."),
        ("points.las", changed(whole, 107, "<I", 2**32 - 1), "cut off.*4294967295 points"),
    ):
        (tmp_path / name).write_bytes(data)
        with pytest.raises(FileReadError, match=message):
            read_points(tmp_path / name)


def test_damaged_packed_points_are_refused(las, tmp_path):
    """Found by fuzzing: lazrs ends the process, or panics with no Exception."""
    pytest.importorskip("lazrs")
    whole = las("scan.laz").read_bytes()
    start = struct.unpack_from("<I", whole, 96)[0]
    place = struct.unpack_from("<q", whole, start)[0]
    record = whole.index(b"laszip encoded") - 2 + 54
    for name, data, message in (
        ("chunks.laz", changed(whole, place + 4, "<I", 2**32 - 1), "table of packed chunks"),
        ("place.laz", changed(whole, start, "<q", -5), "table of packed chunks"),
        ("items.laz", changed(whole, record + 32, "<H", 0), "not a complete LAS file"),
        ("cut.laz", whole[:-30], "table of packed chunks|not a complete LAS file"),
    ):
        (tmp_path / name).write_bytes(data)
        with pytest.raises(FileReadError, match=message):
            read_points(tmp_path / name)
    # The place may be told at the end, by what writes without going back.
    (tmp_path / "streamed.laz").write_bytes(
        changed(whole, start, "<q", -1) + struct.pack("<q", place)
    )
    assert len(read_points(tmp_path / "streamed.laz")) == 200
    # A chunk may be said to hold more points than there are: no room is made for them.
    for points in (2**32 - 2, 3_271_622_655):
        (tmp_path / "large.laz").write_bytes(changed(whole, record + 12, "<I", points))
        assert len(read_points(tmp_path / "large.laz")) == 200


def test_damaged_layers_of_points_are_refused(tmp_path):
    """Found while mending what fuzzing found: lazrs makes room for what a layer says."""
    laspy = pytest.importorskip("laspy")
    pytest.importorskip("lazrs")
    scan = laspy.LasData(laspy.LasHeader(point_format=8, version="1.4"))
    x = np.arange(60_000.0)
    scan.x, scan.y, scan.z = x, x % 7, x % 11
    scan.write(tmp_path / "whole.laz")
    np.testing.assert_array_equal(read_points(tmp_path / "whole.laz")[:, 0], x)
    whole = (tmp_path / "whole.laz").read_bytes()
    start = struct.unpack_from("<I", whole, 96)[0]
    for layer in range(9 + 2):  # of points, and of colours with infrared
        place = start + 8 + 38 + 4 + 4 * layer
        (tmp_path / "cut.laz").write_bytes(changed(whole, place, "<I", 2**32 - 5))
        with pytest.raises(FileReadError, match="table of packed chunks"):
            read_points(tmp_path / "cut.laz")
    # Items that are said to be larger than they are hide the layers.
    record = whole.index(b"laszip encoded") - 2 + 54
    (tmp_path / "items.laz").write_bytes(changed(whole, record + 34 + 6 + 2, "<H", 11016))
    with pytest.raises(FileReadError, match="table of packed chunks"):
        read_points(tmp_path / "items.laz")


@pytest.mark.parametrize("encoding", ["ASCII", "BINARY", "BINARY_COMPRESSED"])
def test_pcd_files_are_read(scanned, tmp_path, encoding):
    pypcd4 = pytest.importorskip("pypcd4")
    points = (scanned - 4_500_000).astype(np.float32)
    path = tmp_path / "scan.pcd"
    cloud = pypcd4.PointCloud.from_xyz_points(points)
    cloud.save(path, encoding=pypcd4.Encoding[encoding])
    np.testing.assert_allclose(read_points(path), points.astype(np.float64), rtol=1e-6)
    if encoding == "BINARY":
        (tmp_path / "cut.pcd").write_bytes(path.read_bytes()[:-100])
        with pytest.raises(FileReadError, match=r"not a complete|cut off"):
            read_points(tmp_path / "cut.pcd")
        (tmp_path / "none.pcd").write_bytes(b"solid thing")
        with pytest.raises(FileReadError, match="not a complete"):
            read_points(tmp_path / "none.pcd")


@pytest.mark.parametrize(("name", "library"), [("a.las", "laspy"), ("a.pcd", "pypcd4")])
def test_readers_name_their_library(tmp_path, without, name, library):
    without(library)
    (tmp_path / name).write_bytes(b"LASF")
    with pytest.raises(MissingLibraryError, match=library):
        read_points(tmp_path / name)


def test_surfaces_of_files_are_whole_or_not_there(shape, tmp_path):
    target = tmp_path / "surface.ply"
    shape.surface().save(target)
    before = target.read_bytes()
    shape.surface().save(target)
    assert target.read_bytes() == before
    assert [path.name for path in tmp_path.iterdir()] == ["surface.ply"]
    assert io.BytesIO(before).readline() == b"ply\n"
