"""Errors of files are OSError and its subclasses, with the errno of the system."""

import errno
import os
from contextlib import contextmanager

import pytest

import unsnarl

CROSSING = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 1 1 2\nv 2 1 2\nf 1 2 3\nf 4 5 6\n"

NOBODY = 65534


@pytest.fixture
def mesh(tmp_path):
    path = tmp_path / "in.obj"
    path.write_text(CROSSING)
    return path


@contextmanager
def without_rights():
    """root may do everything."""
    if os.geteuid() != 0:
        yield
        return
    os.seteuid(NOBODY)
    try:
        yield
    finally:
        os.seteuid(0)


READERS = [unsnarl.read, unsnarl.check, unsnarl.view, lambda path: unsnarl.fix(path, "out.obj"),
           lambda path: unsnarl.fix([path, path.with_name("other.obj")], "out")]


@pytest.mark.parametrize("call", READERS)
def test_what_cannot_be_read(mesh, tmp_path, monkeypatch, call):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(FileNotFoundError, match="none.obj") as raised:
        call(tmp_path / "none.obj")
    assert raised.value.errno == errno.ENOENT
    with pytest.raises(NotADirectoryError):
        call(mesh / "inside.obj")
    (tmp_path / "folder.obj").mkdir()
    with pytest.raises(IsADirectoryError, match="folder.obj"):
        call(tmp_path / "folder.obj")
    (tmp_path / "loop.obj").symlink_to("loop.obj")
    with pytest.raises(OSError) as raised:
        call(tmp_path / "loop.obj")
    assert raised.value.errno == errno.ELOOP
    secret = tmp_path / "secret.obj"
    secret.write_text(CROSSING)
    secret.chmod(0)
    tmp_path.chmod(0o755)
    with without_rights(), pytest.raises(PermissionError, match="secret.obj"):
        call(secret)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["folder.obj", "in.obj", "loop.obj", "secret.obj"]


def test_what_makes_no_sense_has_no_errno(tmp_path):
    (tmp_path / "bad.obj").write_text("v 0 0\n")
    with pytest.raises(OSError, match="bad.obj") as raised:
        unsnarl.read(tmp_path / "bad.obj")
    assert raised.value.errno is None


def test_numbers_in_a_file_that_is_missing(tmp_path):
    (tmp_path / "a.gltf").write_text(
        '{"asset": {"version": "2.0"}, "buffers": [{"uri": "none.bin", "byteLength": 36}], "scene": 0, "scenes": '
        '[{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], '
        '"bufferViews": [{"buffer": 0, "byteLength": 36}], "accessors": [{"bufferView": 0, "componentType": 5126, '
        '"count": 3, "type": "VEC3"}]}'
    )
    with pytest.raises(FileNotFoundError, match="none.bin"):
        unsnarl.read(tmp_path / "a.gltf")


def test_an_external_file_that_is_missing(tmp_path):
    array = (
        '<DataArray Intent="NIFTI_INTENT_POINTSET" DataType="NIFTI_TYPE_FLOAT32" Dimensionality="2" Dim0="3" Dim1="3" '
        'Encoding="ExternalFileBinary" Endian="LittleEndian" ExternalFileName="none.dat"/>'
    )
    (tmp_path / "a.gii").write_text(f"<GIFTI>{array}</GIFTI>")
    with pytest.raises(FileNotFoundError, match="none.dat"):
        unsnarl.read(tmp_path / "a.gii")


def test_where_nothing_can_be_written(mesh, tmp_path):
    with pytest.raises(FileNotFoundError, match="missing"):
        unsnarl.fix(mesh, tmp_path / "missing" / "out.obj")
    (tmp_path / "folder.obj").mkdir()
    with pytest.raises(IsADirectoryError, match="folder.obj"):
        unsnarl.fix(mesh, tmp_path / "folder.obj")
    with pytest.raises(NotADirectoryError):
        unsnarl.fix(mesh, mesh / "out.obj")
    locked = tmp_path / "locked"
    locked.mkdir(mode=0o555)
    for folder in (tmp_path, *tmp_path.parents[:2]):
        folder.chmod(0o755)
    with without_rights(), pytest.raises(PermissionError):
        unsnarl.fix(mesh, locked / "out.obj")
    with without_rights(), pytest.raises(PermissionError):
        unsnarl.fix([mesh], locked / "out")
    with pytest.raises(FileExistsError):
        unsnarl.fix([mesh], mesh)


def test_the_program_says_it_too(mesh, tmp_path):
    for number in (1, 2):
        (tmp_path / f"f{number}.obj").write_text(CROSSING)
    with pytest.raises(FileNotFoundError):
        unsnarl.fix_sequence([tmp_path / "f1.obj", tmp_path / "f3.obj"], tmp_path / "out")
    with pytest.raises(NotADirectoryError):
        unsnarl.fix_sequence([tmp_path / "f1.obj", tmp_path / "f2.obj"], mesh / "out")
    with pytest.raises(FileNotFoundError):
        unsnarl.batch(tmp_path / "none", tmp_path / "out")
