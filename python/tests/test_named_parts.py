"""Parts by the names that files give them: what Python holds is what the command line holds."""

import json

import numpy as np
import pytest
from command_line import fix, run, sample

import unsnarl


@pytest.fixture(scope="module")
def parts(tmp_path_factory):
    """An anchor and things in it, each an object and a group."""
    path = tmp_path_factory.mktemp("parts") / "parts.obj"
    sample(path, "anchored_balls", "--resolution", "12")
    return path


def test_check_lists_what_can_be_named(parts):
    found = unsnarl.check(parts)
    assert len(found) > 0 and found.report["schema"] == "unsnarl-check"
    names = {(part.kind, part.name) for part in found.parts}
    assert ("object", "anchor") in names and ("group", "anchor") in names
    V, F = unsnarl.read(parts)
    F = F if isinstance(F, np.ndarray) else F[1][:-1]
    assert sum(part.faces for part in found.parts if part.kind == "object") == len(F)
    assert sum(component.faces for component in found.components) == len(F)
    assert all(component.vertices > 0 for component in found.components)
    assert len(found.components) == found.report["components"]["total"]


@pytest.mark.parametrize(
    "options, words",
    [
        ({"fix_group": "anchor"}, ["--fix-group", "anchor"]),
        ({"fix_object": ["anchor"]}, ["--fix-object", "anchor"]),
        ({"fix_component": 0}, ["--fix-component", "0"]),
        ({"fix_component": [0, 1], "fix_boundary": True},
         ["--fix-component", "0", "--fix-component", "1", "--fix-boundary"]),
        ({"only_component": [1, 2]}, ["--only-component", "1", "--only-component", "2"]),
        ({"rigid_object": ["anchor"]}, ["--rigid", "anchor"]),
        ({"rigid_component": [1, 2], "fix_object": "anchor"},
         ["--rigid-component", "1", "--rigid-component", "2", "--fix-object", "anchor"]),
    ],
    ids=str,
)
def test_names_mean_what_they_mean_on_the_command_line(parts, tmp_path, options, words):
    mine, theirs = tmp_path / "mine.obj", tmp_path / "theirs.obj"
    result = unsnarl.fix(parts, mine, keep_partial=True, **options)
    done = run("fix", parts, "-o", theirs, "--keep-partial", "--report", tmp_path / "report.json", "-q", *words,
               expected=result.report["exit_code"])
    assert done == "" and mine.read_bytes() == theirs.read_bytes()
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["options"] == result.report["options"]
    assert report.get("rigid_parts") == result.report.get("rigid_parts")


def test_what_is_held_stays_and_what_is_not_moves(parts, tmp_path):
    before, _ = unsnarl.read(parts)
    held = unsnarl.fix(parts, tmp_path / "a.obj", fix_object="anchor").V
    first = unsnarl.check(parts).parts[0]
    assert first.name == "anchor"
    assert np.array_equal(held[: first.vertices], before[: first.vertices]) and not np.array_equal(held, before)


@pytest.mark.parametrize(
    "options, error, words",
    [
        ({"fix_group": "ankor"}, ValueError, "fix_group: there is no group 'ankor'; there are: 'anchor'"),
        ({"only_object": ["anchor", "x"]}, ValueError, "only_object: there is no object 'x'"),
        ({"fix_material": "m"}, ValueError, "fix_material: there is no material 'm'"),
        ({"rigid_component": 99}, ValueError, "rigid_component: there is no component 99"),
        ({"fix_component": "0"}, TypeError, "numbers of components"),
        ({"fix_object": 3}, TypeError, "names"),
        ({"fix_file": "parts.obj"}, ValueError, "several files"),
        ({"rigid_object": ["anchor"], "rigid_group": "anchor"}, ValueError, "in common"),
        ({"rigid_object": ["anchor"], "fix_object": "anchor"}, ValueError, "is held"),
        ({"rigid_object": ["anchor"], "rigid": [[0]]}, ValueError, "exclude each other"),
        ({"nested": "anchor"}, TypeError, "innermost"),
        ({"nested": ["anchor", "x"]}, ValueError, "nested: there is no object 'x'"),
    ],
    ids=str,
)
def test_names_that_make_no_sense_are_refused(parts, tmp_path, options, error, words):
    with pytest.raises(error, match=words):
        unsnarl.fix(parts, tmp_path / "out.obj", **options)
    assert not list(tmp_path.iterdir())


def test_surfaces_of_one_file_are_nested_by_name(tmp_path):
    path = tmp_path / "two.obj"
    V, F, first = [], [], 0
    for name, radius, shift in (("core", 0.9, 0.4), ("shell", 1.0, 0.0)):
        own_V, own_F = octahedron(radius, shift)
        V += [f"v {x} {y} {z}" for x, y, z in own_V]
        F += [f"o {name}", *(f"f {a + 1 + first} {b + 1 + first} {c + 1 + first}" for a, b, c in own_F)]
        first += len(own_V)
    path.write_text("\n".join([*V, *F, ""]))
    result = unsnarl.fix(path, tmp_path / "mine.obj", nested=["core", "shell"], keep_partial=True)
    report = fix(path, tmp_path / "theirs.obj", "--nested", "core,shell", "--keep-partial",
                 expected=result.report["exit_code"])
    assert result.report["nested"] == report["nested"] and report["nested"][0]["inner"] == "core"
    assert (tmp_path / "mine.obj").read_bytes() == (tmp_path / "theirs.obj").read_bytes()


def octahedron(radius, shift):
    V = [(radius + shift, 0, 0), (shift - radius, 0, 0), (shift, radius, 0), (shift, -radius, 0), (shift, 0, radius),
         (shift, 0, -radius)]
    F = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    return V, F


def test_stored_normals_turn_with_the_faces(tmp_path):
    path = tmp_path / "in.ply"
    sample(tmp_path / "tubes.obj", "crossing_tubes", "--resolution", "12")
    V, F = unsnarl.read(tmp_path / "tubes.obj")
    F = F.reshape(-1, 4) if isinstance(F, np.ndarray) else F[0].reshape(-1, 4)
    rows = [f"{x} {y} {z} 0 0 1" for x, y, z in V] + [f"4 {a} {b} {c} {d}" for a, b, c, d in F]
    path.write_text(
        f"ply\nformat ascii 1.0\nelement vertex {len(V)}\n"
        + "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
        + f"element face {len(F)}\nproperty list uchar int vertex_indices\nend_header\n" + "\n".join(rows) + "\n"
    )
    unsnarl.fix(path, tmp_path / "mine.ply", recompute_normals=True)
    unsnarl.fix(path, tmp_path / "plain.ply")
    run("fix", path, "-o", tmp_path / "theirs.ply", "--recompute-normals", "-q")
    assert (tmp_path / "mine.ply").read_bytes() == (tmp_path / "theirs.ply").read_bytes()
    assert (tmp_path / "mine.ply").read_bytes() != (tmp_path / "plain.ply").read_bytes()


def test_parts_that_change_and_overlap_are_told(tmp_path, caplog):
    stool = tmp_path / "stool.obj"
    sample(stool, "stool", "--resolution", "16")
    with caplog.at_level("INFO", logger="unsnarl"):
        result = unsnarl.fix(stool, tmp_path / "out.obj", fix_object=["leg", "leg_2", "leg_3", "leg_4"])
    changed, advice = result.report["changed_components"], result.report["advice"]
    assert changed and changed[0]["message"] in caplog.text and changed[0]["message"] in result._repr_html_()
    assert [part["name"] for part in result.report["overlapping_components"]] == ["rung", "rung_2"]
    assert len(advice) == 1 and advice[0] in caplog.text
    assert unsnarl.check(stool).report["overlapping_components"] == result.report["overlapping_components"]
