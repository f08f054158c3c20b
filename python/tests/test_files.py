"""Files in, files out; what results show of themselves."""

import logging
import os
import subprocess

import numpy as np
import pytest

import unsnarl

CROSSING = """# kept
v 0 0 0
v 4 0 0
v 0 4 0
v 0 0 4
v 1.2 1.2 1.1
v 2.6 2.5 2
v 2.5 2.6 2.2
v 2.4 2.4 2.7
f 1 3 2
f 1 2 4
f 2 3 4
f 1 4 3
f 5 7 6
f 5 6 8
f 6 7 8
f 5 8 7
"""


@pytest.fixture
def mesh(tmp_path):
    path = tmp_path / "in.obj"
    path.write_text(CROSSING)
    return path


def test_a_file_is_repaired_as_the_program_does(mesh, tmp_path):
    result = unsnarl.fix(mesh, tmp_path / "out.obj")
    assert result.status == "embedded" and result.output == tmp_path / "out.obj"
    assert result.report["input"]["path"] == str(mesh) and result.report["output"]["written"]
    subprocess.run([os.environ["UNSNARL_PROGRAM"], "fix", mesh, "-o", tmp_path / "by_program.obj", "-q"], check=True)
    assert (tmp_path / "out.obj").read_bytes() == (tmp_path / "by_program.obj").read_bytes()
    assert mesh.read_text() == CROSSING
    V, F = unsnarl.read(tmp_path / "out.obj")
    assert V.shape == (8, 3) and F.shape == (8, 3) and np.array_equal(V, result.V)
    assert len(unsnarl.check(mesh)) > 0 and len(unsnarl.check(str(tmp_path / "out.obj"))) == 0


def test_in_place_and_held_vertices(mesh):
    before, _ = unsnarl.read(mesh)
    result = unsnarl.fix(mesh, fixed=[0, 1, 2, 3], in_place=True)
    assert result.output == mesh and len(unsnarl.check(mesh)) == 0
    assert mesh.read_text().splitlines()[:5] == CROSSING.splitlines()[:5]
    assert not np.array_equal(before, result.V)


def test_numbers_in_other_files_are_neither_lost_nor_overwritten(mesh, tmp_path):
    V, F = unsnarl.read(mesh)
    array = (
        '<DataArray Intent="NIFTI_INTENT_{}" DataType="NIFTI_TYPE_{}" Dimensionality="2" Dim0="8" Dim1="3" '
        'Encoding="ExternalFileBinary" Endian="LittleEndian" ExternalFileName="{}"/>'
    )
    source, folder = tmp_path / "a.gii", tmp_path / "other"
    folder.mkdir()
    arrays = array.format("POINTSET", "FLOAT32", "p.dat") + array.format("TRIANGLE", "INT32", "f.dat")
    source.write_text(f"<GIFTI>{arrays}</GIFTI>")
    (tmp_path / "p.dat").write_bytes(V.astype("<f4").tobytes())
    (tmp_path / "f.dat").write_bytes(F.astype("<i4").tobytes())
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()}
    for out in (tmp_path / "b.gii", folder / "a.gii"):
        result = unsnarl.fix(source, out)
        assert result.status == "embedded" and np.array_equal(unsnarl.read(out)[0], result.V)
        assert out.with_name(out.name + ".data").exists() and out.with_name(out.name + ".2.data").exists()
        assert before == {name: (tmp_path / name).read_bytes() for name in before}
    (folder / "c.gii.2.data").mkdir()
    with pytest.raises(OSError, match="c.gii.2.data"):
        unsnarl.fix(source, folder / "c.gii")
    assert not (folder / "c.gii").exists() and not (folder / "c.gii.data").exists()
    (folder / "d.gii.data").mkdir()
    (folder / "d.gii.2.data").write_text("the old one")
    with pytest.raises(OSError, match="d.gii.data"):
        unsnarl.fix(source, folder / "d.gii")
    assert (folder / "d.gii.2.data").read_text() == "the old one" and not (folder / "d.gii").exists()
    assert not [path for path in folder.iterdir() if path.name.startswith(".")]
    unsnarl.fix(source, in_place=True)
    assert source.read_bytes() == before["a.gii"] and len(unsnarl.check(source)) == 0


@pytest.mark.parametrize("name, error", [("out.ply", ValueError), ("missing/out.obj", OSError), ("", OSError)])
def test_a_place_that_cannot_be_written_to_is_found_before_the_repair(mesh, tmp_path, name, error):
    asked = []
    with pytest.raises(error):
        unsnarl.fix(mesh, tmp_path / name, progress=lambda *state: asked.append(state))
    assert not asked and [path.name for path in tmp_path.iterdir()] == ["in.obj"]


def test_what_is_unfinished_is_written_where_asked_for(mesh, tmp_path):
    out = tmp_path / "out.obj"
    assert unsnarl.fix(mesh, out, max_displacement=1e-9).output is None and not out.exists()
    kept = unsnarl.fix(mesh, out, max_displacement=1e-9, keep_partial=True)
    assert kept.output == out and out.exists() and kept.status != "embedded"


def two_overlaps(path, deep=0.4):
    """One that a motion of 0.05 resolves, and one so deep."""
    points, faces = [], []
    for i, depth in enumerate([0.02, deep]):
        tip = (4 - depth * 3**0.5) / 3
        points += [[x + 9 * i, y, z] for x, y, z in [(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4), (tip, tip, tip)]]
        points += [[x + 9 * i, y, z] for x, y, z in [(2.6, 2.5, 2), (2.5, 2.6, 2.2), (2.4, 2.4, 2.7)]]
        corners = [(1, 3, 2), (1, 2, 4), (2, 3, 4), (1, 4, 3), (5, 7, 6), (5, 6, 8), (6, 7, 8), (5, 8, 7)]
        faces += [[c + 8 * i for c in face] for face in corners]
    lines = [f"v {x:.6g} {y:.6g} {z:.6g}" for x, y, z in points] + [f"f {a} {b} {c}" for a, b, c in faces]
    path.write_text("\n".join(lines) + "\n")
    return path


def test_what_an_incomplete_repair_reached_is_kept_beside_the_output(tmp_path):
    source = two_overlaps(tmp_path / "in.obj")
    limit = 0.05 / unsnarl.repair(*unsnarl.read(source)).report["diagonal"]
    result = unsnarl.fix(source, tmp_path / "out.obj", max_displacement=limit)
    assert result.status == "displacement_exceeded" and result.output is None
    assert result.partial == tmp_path / "out.partial.obj"
    assert result.report["output"] == {"written": False, "path": None, "partial": [str(result.partial)]}
    assert 0 < len(unsnarl.check(result.partial)) < len(unsnarl.check(source))
    again = unsnarl.fix(result.partial, tmp_path / "out.obj", max_displacement=limit, no_partial=True)
    assert again.output is None and again.partial is None
    assert sorted(p.name for p in tmp_path.iterdir()) == ["in.obj", "out.partial.obj"]


def test_an_edit_saved_meanwhile_is_not_overwritten(mesh, tmp_path):
    edited = []

    def edit(*state):
        if not edited:
            with open(mesh, "a") as file:
                file.write("# edited\n")
            edited.append(mesh.read_text())

    with pytest.raises(OSError, match="in.partial.obj"):
        unsnarl.fix(mesh, in_place=True, progress=edit)
    assert mesh.read_text() == edited[0] and len(unsnarl.check(tmp_path / "in.partial.obj")) == 0


def test_refusals(mesh, tmp_path):
    with pytest.raises(OSError, match="nowhere.obj"):
        unsnarl.fix(tmp_path / "nowhere.obj", tmp_path / "out.obj")
    with pytest.raises(ValueError, match="in_place=True"):
        unsnarl.fix(mesh, mesh)
    with pytest.raises(ValueError, match="in_place=True"):
        unsnarl.fix(mesh)
    with pytest.raises(TypeError, match="max_displacment"):
        unsnarl.fix(mesh, tmp_path / "out.obj", max_displacment=1)
    with pytest.raises(ValueError, match="keeps the format"):
        unsnarl.fix(mesh, tmp_path / "out.stl")
    with pytest.raises(TypeError, match="unsnarl.fix"):
        unsnarl.repair(str(mesh))
    assert sorted(p.name for p in tmp_path.iterdir()) == ["in.obj"]


def test_results_show_themselves(crossing, mesh, tmp_path):
    for result in (unsnarl.repair(*crossing), unsnarl.fix(mesh, tmp_path / "out.obj")):
        assert result.picture(256).startswith(b"\x89PNG")
        page = result._repr_html_()
        assert "embedded" in page and "data:image/png;base64," in page and "before, 0 after" in page
    with pytest.raises(ValueError, match="128"):
        result.picture(5)


def test_the_logger_is_told(crossing, caplog):
    with caplog.at_level(logging.INFO, logger="unsnarl"):
        unsnarl.repair(*crossing)
        unsnarl.repair(*crossing, max_displacement=1e-12)
    assert [record.levelname for record in caplog.records] == ["INFO", "WARNING"]
    assert "1 intersecting pairs before, 0 after" in caplog.records[0].message


def test_settings_of_the_paper(crossing):
    result = unsnarl.repair(*crossing, goal="disjoint", paper={"arap": 0.5, "bandwidth": "global", "iterations": 100})
    assert result.report["options"]["paper"]
    with pytest.raises(ValueError, match="no setting 'weight'"):
        unsnarl.repair(*crossing, paper={"weight": 1})
    with pytest.raises(ValueError, match="paper_bandwidth is 'wide'; choose one of 'global'"):
        unsnarl.repair(*crossing, paper={"bandwidth": "wide"})


def test_routes():
    plan = {
        "agents": [
            {"name": "a", "radius": 0.5, "start": np.array([-4.0, 0, 0]), "goal": [4, 0, 0]},
            {"name": "b", "radius": 0.5, "start": [0, -4, 0], "goal": [0, 4, 0]},
        ]
    }
    found = unsnarl.plan_routes(plan)
    assert found.status == "embedded" and found.report["hold"] and found.report["clearance"] >= 1
    assert np.array_equal(found.routes[0][0], [-4, 0, 0]) and np.array_equal(found.routes[1][-1], [0, 4, 0])
    again = unsnarl.check_routes(plan, found.routes)
    assert again["hold"] and not again["faults"] and again["clearance"] == found.report["clearance"]
    straight = unsnarl.check_routes(plan, [np.array([[-4.0, 0, 0], [4, 0, 0]]), np.array([[0, -4.0, 0], [0, 4, 0]])])
    assert not straight["hold"] and "'a' and 'b'" in str(straight["faults"])
    with pytest.raises(ValueError, match=r"agents\[0\]"):
        unsnarl.plan_routes({"agents": [{"radius": -1, "start": [0, 0, 0], "goal": [1, 0, 0]}]})
    with pytest.raises(TypeError, match="give a dict"):
        unsnarl.plan_routes("plan.json")
