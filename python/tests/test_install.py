"""`pip install .` offline gives a package that imports, types included, and so does the wheel, with all libraries
inside. The library is the one already built."""

import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parents[2]
ABOUT = json.loads((PROJECT / "cmake" / "project.json").read_text())  # version and address


def needs(*modules):
    for module in modules:
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"{module} is not installed")


def run(*command, **options):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_pip_install(tmp_path):
    needs("pip", "setuptools", "wheel")
    # A copy, since pip leaves its traces in the source tree.
    source, target = tmp_path / "source", tmp_path / "target"
    source.mkdir()
    for name in ("pyproject.toml", "setup.py", "CMakeLists.txt", "README.md"):
        shutil.copy(PROJECT / name, source)
    (source / "cmake").mkdir()
    shutil.copy(PROJECT / "cmake" / "project.json", source / "cmake")
    shutil.copytree(PROJECT / "python", source / "python")
    run(sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-index", "--no-deps", "--target", target,
        source)

    assert {"py.typed", "libunsnarl_c.so"} <= {path.name for path in (target / "unsnarl").iterdir()}
    script = "import unsnarl; print(unsnarl.__file__, unsnarl.find_intersections([[0, 0, 0]], []))"
    said = run(sys.executable, "-c", script, cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(target)})
    assert said.split() == [str(target / "unsnarl" / "__init__.py"), "Intersections(none)"]
    for program in ([target / "bin" / "unsnarl"], [sys.executable, "-m", "unsnarl"]):
        said = run(*program, "--version", cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(target)})
        assert said.startswith("unsnarl ")


def test_an_address_is_in_the_metadata_and_in_links(tmp_path):
    needs("setuptools", "wheel")
    for name in ("pyproject.toml", "setup.py", "README.md"):
        shutil.copy(PROJECT / name, tmp_path)
    (tmp_path / "cmake").mkdir()
    (tmp_path / "cmake" / "project.json").write_text('{"version": "1.2.3", "homepage": "https://example.org/unsnarl"}')
    shutil.copytree(PROJECT / "python" / "unsnarl", tmp_path / "python" / "unsnarl")
    run(sys.executable, "-B", "setup.py", "-q", "egg_info", cwd=tmp_path)
    said = (tmp_path / "python" / "unsnarl.egg-info" / "PKG-INFO").read_text()
    assert "\nVersion: 1.2.3\n" in said and "\nProject-URL: Homepage, https://example.org/unsnarl\n" in said
    links = re.findall(r"\]\(([^)]*)\)", said)
    assert "https://example.org/unsnarl/raw/v1.2.3/docs/images/before_after.png" in links
    assert all(link.startswith("https://example.org/unsnarl/") for link in links)


def test_wheel(tmp_path):
    needs("pip", "setuptools", "wheel")
    if shutil.which("patchelf") is None:
        pytest.skip("patchelf is not installed")
    built = run(sys.executable, "-B", PROJECT / "packaging" / "build_wheel", "-o", tmp_path / "wheel", "--build-dir",
                os.environ["UNSNARL_BUILD_DIR"])
    archive, wheel = map(Path, built.split())
    with tarfile.open(archive) as tar:
        inside = {name.partition("/")[2] for name in tar.getnames()}
    assert {"CMakeLists.txt", "apps/unsnarl/main.cpp", "include/unsnarl/unsnarl.h", "tools/help_text.py",
            "src/c_interface/symbols.map", "viewer/CMakeLists.txt", "viewer/page.html"} <= inside
    assert not any(name.endswith(".so") for name in inside)

    assert wheel.name.startswith("unsnarl-") and "-py3-none-manylinux_2_" in wheel.name
    with zipfile.ZipFile(wheel) as content:
        (packed,) = (one for one in content.infolist() if one.filename == "unsnarl/bin/unsnarl")
        assert packed.external_attr >> 16 & 0o111
        assert any("licenses/libpugixml" in name for name in content.namelist())
        (points,) = (name for name in content.namelist() if name.endswith(".dist-info/entry_points.txt"))
        assert b"[pyvista.accessors]" in content.read(points)
        (metadata,) = (name for name in content.namelist() if name.endswith(".dist-info/METADATA"))
        said = content.read(metadata).decode().splitlines()
        assert {f"Version: {ABOUT['version'].replace('.dev', '.dev0')}", "Provides-Extra: pyvista"} <= set(said)
        addresses = [line for line in said if line.startswith("Project-URL:")]
        assert addresses == [f"Project-URL: Homepage, {address}" for address in [ABOUT["homepage"]] if address]
        content.extractall(tmp_path / "target")
    program = tmp_path / "target" / "unsnarl" / "bin" / "unsnarl"
    program.chmod(0o755)  # as pip does for what is marked so in the wheel
    listed = run("ldd", program)
    for name in ("libtbb", "libpugixml", "libzip"):
        (line,) = (line for line in listed.splitlines() if name in line.split()[0])
        assert str(tmp_path / "target") in line
    assert run(program, "--version").startswith("unsnarl ")
    # What is loaded comes from inside, or from glibc and what is with it everywhere.
    script = "import unsnarl; unsnarl.find_intersections([[0, 0, 0]], []); print(open('/proc/self/maps').read())"
    maps = run(sys.executable, "-c", script, cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(tmp_path / "target")})
    loaded = {Path(line.split()[-1]) for line in maps.splitlines() if ".so" in line}
    for name in ("libunsnarl_c", "libtbb", "libpugixml", "libzip"):
        (path,) = (path for path in loaded if path.name.startswith(name))
        assert tmp_path / "target" in path.parents
