"""The server for assistants, spoken to as a client does: line by line."""

import json
import os
import subprocess
import sys

import pytest

import unsnarl
from command_line import sample


class Client:
    def __init__(self, *arguments):
        self.process = subprocess.Popen([sys.executable, "-m", "unsnarl.mcp", *map(str, arguments)],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.asked = 0
        self.notified = []

    def send(self, message):
        line = message if isinstance(message, bytes) else json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(line + b"\n")
        self.process.stdin.flush()

    def read(self):
        """The next message that is no notification; these are kept."""
        while True:
            message = json.loads(self.process.stdout.readline())
            assert message.pop("jsonrpc") == "2.0"
            if "method" not in message:
                return message
            self.notified.append(message)

    def ask(self, method, **params):
        self.asked += 1
        self.send({"id": self.asked, "method": method, "params": params})
        return self.asked

    def request(self, method, **params):
        number = self.ask(method, **params)
        answer = self.read()
        assert answer["id"] == number
        return answer

    def call(self, tool, **arguments):
        return self.request("tools/call", name=tool, arguments=arguments)["result"]

    def refusal(self, tool, **arguments):
        result = self.call(tool, **arguments)
        assert result["isError"]
        return result["content"][0]["text"]

    def initialize(self, version="2025-06-18"):
        answer = self.request("initialize", protocolVersion=version, capabilities={},
                              clientInfo={"name": "test", "version": "1"})
        self.send({"method": "notifications/initialized"})
        return answer["result"]

    def close(self):
        self.process.stdin.close()
        return self.process.wait(timeout=60)


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "served").mkdir()
    sample(tmp_path / "served" / "tubes.obj", "crossing_tubes", "--resolution", "20")
    return tmp_path / "served"


@pytest.fixture
def client(folder):
    client = Client(folder)
    client.initialize()
    yield client
    assert client.close() == 0


@pytest.mark.parametrize("asked, agreed", [("2024-11-05", "2024-11-05"), ("2025-11-25", "2025-11-25"),
                                           ("1999-01-01", "2025-11-25")])
def test_the_version_is_agreed_upon(folder, asked, agreed):
    client = Client(folder)
    assert client.request("tools/list")["error"]["code"] == -32600
    answer = client.initialize(asked)
    assert answer["protocolVersion"] == agreed
    assert answer["serverInfo"] == {"name": "unsnarl", "version": unsnarl.__version__}
    tools = {tool["name"]: tool for tool in client.request("tools/list")["result"]["tools"]}
    assert set(tools) == {"check", "fix", "view"}
    assert tools["check"]["annotations"]["readOnlyHint"] and not tools["fix"]["annotations"]["readOnlyHint"]
    assert client.close() == 0


def test_check_counts_what_the_library_counts(client, folder):
    result = client.call("check", inputs=["tubes.obj"])
    report = unsnarl.check(folder / "tubes.obj").report
    assert not result["isError"]
    assert result["structuredContent"]["pairs"] == report["pairs"]
    assert json.loads(result["content"][0]["text"].split("\n", 1)[1]) == result["structuredContent"]


def test_fix_writes_what_the_library_writes(client, folder, tmp_path):
    before = (folder / "tubes.obj").read_bytes()
    result = client.call("fix", inputs=["tubes.obj"], output="fixed.obj", fix_component=["0"])
    unsnarl.fix(folder / "tubes.obj", tmp_path / "same.obj", fix_component=[0])
    assert result["structuredContent"]["status"] == "embedded"
    assert result["structuredContent"]["output"] == {"written": True, "path": str(folder / "fixed.obj"), "partial": []}
    assert (folder / "fixed.obj").read_bytes() == (tmp_path / "same.obj").read_bytes()
    assert (folder / "tubes.obj").read_bytes() == before
    assert sorted(os.listdir(folder)) == ["fixed.obj", "tubes.obj"]


def test_scenes_and_pages(client, folder):
    sample(folder / "b.obj", "crossing_tubes", "--resolution", "16")
    result = client.call("fix", inputs=["tubes.obj", str(folder / "b.obj")], output="scene")
    assert result["structuredContent"]["status"] == "embedded"
    assert sorted(os.listdir(folder / "scene")) == ["b.obj", "tubes.obj"]
    for arguments in ({"inputs": ["tubes.obj", "b.obj"], "page": "scene.html"},
                      {"inputs": ["tubes.obj"], "repaired": "scene/tubes.obj", "page": "both.html"}):
        result = client.call("view", **arguments)
        page = folder / arguments["page"]
        assert result["structuredContent"] == {"page": str(page), "bytes": page.stat().st_size}
        assert page.read_bytes().startswith(b"<!doctype html>")


def test_nothing_is_overwritten(client, folder):
    before = (folder / "tubes.obj").read_bytes()
    for output in ("tubes.obj", "./tubes.obj", str(folder / "tubes.obj")):
        assert "exists already" in client.refusal("fix", inputs=["tubes.obj"], output=output)
    assert "exists already" in client.refusal("view", inputs=["tubes.obj"], page="tubes.obj")
    assert (folder / "tubes.obj").read_bytes() == before


def test_files_beside_the_output_are_not_overwritten(client, folder, crossing):
    V, F = crossing
    data = V.astype("<f4").tobytes() + F.astype("<u2").tobytes()
    (folder / "in").mkdir()
    (folder / "out").mkdir()
    (folder / "in" / "data.bin").write_bytes(data)
    (folder / "out" / "data.bin").write_bytes(b"of another mesh")
    accessors = [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3", "min": [0, 0, -1],
                  "max": [4, 4, 2]}, {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}]
    (folder / "in" / "a.gltf").write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], "accessors": accessors,
        "buffers": [{"uri": "data.bin", "byteLength": len(data)}],
        "bufferViews": [{"buffer": 0, "byteLength": 72}, {"buffer": 0, "byteOffset": 72, "byteLength": 12}]}))
    assert "exists already" in client.refusal("fix", inputs=["in/a.gltf"], output="out/b.gltf")
    assert (folder / "out" / "data.bin").read_bytes() == b"of another mesh"
    assert os.listdir(folder / "out") == ["data.bin"]
    (folder / "new").mkdir()
    assert client.call("fix", inputs=["in/a.gltf"], output="new/b.gltf")["structuredContent"]["output"]["written"]
    assert sorted(os.listdir(folder / "new")) == ["b.gltf", "data.bin"]


def test_nothing_outside_is_reached(client, folder, tmp_path):
    sample(tmp_path / "secret.obj", "crossing_tubes", "--resolution", "8")
    (folder / "link.obj").symlink_to(tmp_path / "secret.obj")
    (folder / "way").symlink_to(tmp_path)
    names = ["../secret.obj", str(tmp_path / "secret.obj"), "link.obj", "way/secret.obj", "/etc/passwd", "\0", ""]
    for name in names:
        assert client.refusal("check", inputs=[name])
    for name in ["../new.obj", str(tmp_path / "new.obj"), "way/new.obj", "/new.obj"]:
        assert "outside" in client.refusal("fix", inputs=["tubes.obj"], output=name)
        assert "outside" in client.refusal("view", inputs=["tubes.obj"], page=name)
    assert sorted(os.listdir(tmp_path)) == ["secret.obj", "served"]


def test_values_are_no_options(client, folder, tmp_path):
    for name in ("--report=" + str(tmp_path / "r.json"), "-h", "-"):
        assert "no file" in client.refusal("check", inputs=[name])
        assert client.refusal("fix", inputs=["tubes.obj"], output="a.obj", fix_object=[name])
    assert sorted(os.listdir(tmp_path)) == ["served"] and os.listdir(folder) == ["tubes.obj"]


def test_arguments_are_checked(client):
    assert "'inputs' is missing" in client.refusal("check")
    assert "'inputs' is empty" in client.refusal("check", inputs=[])
    assert "must be of type string" in client.refusal("check", inputs=[3])
    assert "must be of type number" in client.refusal("fix", inputs=["tubes.obj"], output="a.obj", min_gap=True)
    assert "must not be negative" in client.refusal("fix", inputs=["tubes.obj"], output="a.obj", min_gap=-1)
    assert "one of all, disjoint" in client.refusal("check", inputs=["tubes.obj"], goal="some")
    assert "no argument of check" in client.refusal("check", inputs=["tubes.obj"], in_place=True)
    assert "no object 'x'" in client.refusal("fix", inputs=["tubes.obj"], output="a.obj", fix_object=["x"])


def test_messages_that_are_none(client):
    client.send(b"{")
    assert client.read() == {"id": None, "error": {"code": -32700, "message": "The line is no JSON"}}
    client.send(b"[]")
    assert client.read()["error"]["code"] == -32600
    client.send({"method": "notifications/unknown"})
    client.send({"id": 7, "result": {}})
    assert client.request("resources/list")["error"]["code"] == -32601
    assert client.request("tools/call", name="rm")["error"]["code"] == -32602
    assert client.request("ping")["result"] == {}


def test_progress_goes_forward(client):
    answer = client.request("tools/call", name="fix", arguments={"inputs": ["tubes.obj"], "output": "a.obj"},
                            _meta={"progressToken": "t"})
    assert answer["result"]["structuredContent"]["status"] == "embedded"
    told = [message["params"] for message in client.notified]
    assert told and all(params["progressToken"] == "t" and params["total"] == 1 for params in told)
    assert all(a["progress"] <= b["progress"] for a, b in zip(told, told[1:]))


@pytest.fixture
def long_work(folder):
    sample(folder / "long.obj", "medusa", "--resolution", "80")
    return {"inputs": ["long.obj"], "output": "a.obj"}


def test_calls_can_be_cancelled(client, folder, long_work):
    number = client.ask("tools/call", name="fix", arguments=long_work, _meta={"progressToken": 1})
    assert client.request("ping")["result"] == {}
    second = client.ask("tools/call", name="check", arguments={"inputs": ["tubes.obj"]})
    client.send({"method": "notifications/cancelled", "params": {"requestId": number}})
    assert client.read()["id"] == second
    assert sorted(os.listdir(folder)) == ["long.obj", "tubes.obj"]


def test_the_end_of_the_client_ends_the_work(folder, long_work):
    client = Client(folder)
    client.initialize()
    client.ask("tools/call", name="fix", arguments=long_work)
    assert client.close() == 0
    assert sorted(os.listdir(folder)) == ["long.obj", "tubes.obj"]


def test_a_limit_of_time(folder, long_work):
    client = Client(folder, "--time-limit", "0.5")
    client.initialize()
    result = client.call("fix", **long_work)
    assert result["structuredContent"]["status"] == "time_limit"
    assert "Nothing was written" in result["content"][0]["text"] and not (folder / "a.obj").exists()
    assert client.close() == 0


def test_a_limit_before_any_result(folder, long_work):
    client = Client(folder, "--time-limit", "0.001")
    client.initialize()
    assert "limit" in client.refusal("check", inputs=["long.obj"])
    assert client.close() == 0


def test_folders_must_be_there(tmp_path):
    done = subprocess.run([sys.executable, "-m", "unsnarl.mcp", tmp_path / "missing"], capture_output=True, text=True)
    assert done.returncode == 2 and "is no folder" in done.stderr
