"""Pages to look at meshes: of arrays, files, results, lists of them."""

import html
import importlib
import json
import logging
import re
import sys
from types import SimpleNamespace

import numpy as np
import pytest

import unsnarl


CROSSING = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 1 1 2\nv 2 1 2\nf 1 2 3\nf 4 5 6\n"
#: The start of a PNG, which is all that is read of it here.
PNG = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\4\0\0\0\4"


def scene_of(page):
    """What the page knows as JSON."""
    return json.loads(re.search(rb'<script type="application/json" id="scene">(.*?)</script>', page.html)[1])


def shows_both(page):
    return b'id="positions_after"' in page.html


def test_arrays_alone_and_with_the_result(crossing):
    alone = unsnarl.view(*crossing)
    assert alone.html.startswith(b"<!doctype html>") and not shows_both(alone)
    assert scene_of(alone)["input"] == "mesh" and scene_of(alone)["report"] is None and alone.output is None
    result = unsnarl.repair(*crossing)
    for page in (
        result.view(),
        unsnarl.view(result),
        unsnarl.view(*crossing, after=result),
    ):
        assert shows_both(page) and scene_of(page)["report"]["status"] == "embedded"
    moved = unsnarl.view(*crossing, result.V)
    assert shows_both(moved) and scene_of(moved)["report"] is None


def test_what_counts_is_what_counted_in_the_repair(sheets):
    V, F = sheets
    joined = unsnarl.repair(V, F, goal="disjoint", weld="all")
    assert unsnarl.view(joined).html == unsnarl.view(V, F, joined, goal="disjoint", weld="all").html
    with pytest.raises(ValueError, match="goal is 'some'"):
        unsnarl.view(joined, goal="some")


def test_files_with_their_images(tmp_path, caplog):
    (tmp_path / "in.obj").write_text(f"mtllib in.mtl\n{CROSSING}usemtl a\nf 1 2 4\nusemtl b\nf 1 3 5\n")
    (tmp_path / "in.mtl").write_text("newmtl a\nmap_Kd a.png\nnewmtl b\nmap_Kd gone.png\n")
    (tmp_path / "a.png").write_bytes(PNG)
    with caplog.at_level(logging.INFO, logger="unsnarl"):
        page = unsnarl.view(tmp_path / "in.obj", output=tmp_path / "page.html")
    assert any("gone.png is left out" in record.message for record in caplog.records)
    assert page.output == tmp_path / "page.html" and page.output.read_bytes() == page.html
    assert scene_of(page)["input"] == "in.obj" and b'id="image_0"' in page.html
    result = unsnarl.fix(tmp_path / "in.obj", tmp_path / "out.obj", keep_partial=True)
    for both in (
        unsnarl.view(str(tmp_path / "in.obj"), str(tmp_path / "out.obj")),
        unsnarl.view(tmp_path / "in.obj", after=tmp_path / "out.obj"),
        result.view(),
    ):
        assert shows_both(both) and b'id="image_0"' in both.html
        assert scene_of(both)["input"] == "in.obj" and scene_of(both)["output"] == "out.obj"
    assert shows_both(unsnarl.view(tmp_path / "in.obj", after=result.V))
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.png", "in.mtl", "in.obj", "out.obj", "page.html"]


def test_several_meshes(crossing, tmp_path):
    V, F = crossing
    meshes = [(V, F), (V + [0.5, 0.2, 0.1], F)]
    result = unsnarl.repair(meshes)
    for page in (unsnarl.view(meshes), unsnarl.view(result), unsnarl.view(meshes, after=result.V)):
        assert [file["faces"] for file in scene_of(page)["files"]] == [2, 2]
    paths = [tmp_path / "a.obj", tmp_path / "b.obj"]
    for path in paths:
        path.write_text(CROSSING)
    assert [file["vertices"] for file in scene_of(unsnarl.view(paths))["files"]] == [6, 6]


class Trimesh:
    """With attributes as trimesh's."""

    def __init__(self, vertices, faces):
        self.vertices, self.faces = vertices, faces


def test_meshes_of_other_packages(crossing):
    mesh = Trimesh(*crossing)
    result = unsnarl.repair(mesh)
    assert shows_both(unsnarl.view(mesh, after=result.mesh)) and shows_both(unsnarl.view(mesh, after=result))


def test_the_namespace_in_pyvista(crossing, monkeypatch):
    accessors = []
    module = SimpleNamespace(PolyData=Trimesh, register_dataset_accessor=lambda *_: lambda a: accessors.append(a) or a)
    monkeypatch.setitem(sys.modules, "pyvista", module)
    monkeypatch.delitem(sys.modules, "unsnarl._pyvista", raising=False)
    importlib.import_module("unsnarl._pyvista")
    mesh = Trimesh(*crossing)
    assert shows_both(accessors[0](mesh).view(unsnarl.repair(mesh).mesh, height=300))


def test_notebooks_show_it_in_a_frame(crossing, monkeypatch):
    page = unsnarl.view(*crossing, height=333)
    frame = page._repr_html_()
    assert frame.startswith("<iframe ") and 'height="333"' in frame and 'sandbox="allow-scripts' in frame
    document = re.search(r'srcdoc="([^"]*)"', frame)[1]
    assert "<" not in document and html.unescape(document).encode() == page.html
    monkeypatch.setattr("unsnarl._view._MOST_SHOWN", 1000)
    assert "iframe" not in page._repr_html_() and ".write(PATH)" in page._repr_html_()


def test_it_opens_in_a_browser(crossing, tmp_path, monkeypatch):
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    unsnarl.view(*crossing).show()
    (written,) = tmp_path.iterdir()
    assert opened == [written.as_uri()] and written.read_bytes().startswith(b"<!doctype html>")
    unsnarl.view(*crossing, output=tmp_path / "own.html").show()
    assert opened[1] == (tmp_path / "own.html").as_uri()


def test_refusals(crossing, tmp_path):
    V, F = crossing
    (tmp_path / "in.obj").write_text(CROSSING)
    (tmp_path / "other.obj").write_text(CROSSING + "f 1 2 4\n")
    with pytest.raises(ValueError, match=r"end its name in \.html"):
        unsnarl.view(V, F, output=tmp_path / "page.png")
    with pytest.raises(OSError):
        unsnarl.view(V, F, output=tmp_path / "nowhere" / "page.html")
    with pytest.raises(OSError, match="absent.obj"):
        unsnarl.view(tmp_path / "absent.obj")
    with pytest.raises(ValueError, match="its faces are not those of"):
        unsnarl.view(tmp_path / "in.obj", tmp_path / "other.obj")
    with pytest.raises(ValueError, match="moved has 5 vertices, the surface 6"):
        unsnarl.view(V, F, after=V[:5])
    with pytest.raises(ValueError, match="give it alone"):
        unsnarl.view(unsnarl.repair(V, F), after=V)
    with pytest.raises(TypeError, match="is the name of a file"):
        unsnarl.view(tmp_path / "in.obj", F)
    with pytest.raises(ValueError, match="face 1 uses vertex 6"):
        unsnarl.view(V, F + 1)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["in.obj", "other.obj"]
    assert np.array_equal(V[0], [0, 0, 0])
