"""A server that lets assistants check, repair and show meshes: ``python -m unsnarl.mcp FOLDER...``.

It speaks the Model Context Protocol over standard input and output, JSON-RPC 2.0, one message a line. Files in the
folders named are read, and new ones written there; nothing else is reached, nothing is overwritten, no network is used.
"""

from __future__ import annotations

import argparse
import json
import sys
import threading
from collections.abc import Sequence
from typing import Any, BinaryIO, Optional

from ._library import version
from ._mcp_folders import Folders, Refused
from ._mcp_tools import TOOLS, Limits, Work, checked

#: Versions of the protocol, the latest first.
VERSIONS = ("2025-11-25", "2025-06-18", "2025-03-26", "2024-11-05")

# Codes of JSON-RPC.
_PARSE_ERROR, _INVALID_REQUEST, _METHOD_NOT_FOUND, _INVALID_PARAMS, _INTERNAL_ERROR = -32700, -32600, -32601, -32602, -32603

_INSTRUCTIONS = (
    "Repairs surface meshes that pass through themselves: the same vertices, faces and attributes, moved as little as "
    "possible. Call check first: it lists parts that fix can hold. Files are named relative to a served folder."
)


class _Error(Exception):
    def __init__(self, code: int, message: str) -> None:
        super().__init__(message)
        self.code = code


class Server:
    """Answers the messages of one client. Calls of tools run one at a time, each in a thread of its own."""

    def __init__(self, folders: Folders, limits: Limits, out: BinaryIO) -> None:
        self._folders, self._limits, self._out = folders, limits, out
        self._writing, self._turn, self._changing = threading.Lock(), threading.Lock(), threading.Lock()
        self._running: dict[Any, tuple[Work, threading.Thread]] = {}
        self._is_initialized = False

    def serve(self, lines: BinaryIO) -> None:
        """Until there are no more lines; then cancels what is running."""
        for line in lines:
            if line.strip():
                self._take(line)
        for work, thread in list(self._running.values()):
            work.cancel()
            thread.join()

    def _take(self, line: bytes) -> None:
        try:
            message = json.loads(line)
        except ValueError:
            return self._fail(None, _Error(_PARSE_ERROR, "The line is no JSON"))
        if not isinstance(message, dict) or message.get("jsonrpc") != "2.0":
            return self._fail(None, _Error(_INVALID_REQUEST, "A message must be one object of JSON-RPC 2.0"))
        if "method" not in message:
            return None  # an answer: the server asks nothing
        method, params = message["method"], message.get("params") or {}
        if "id" not in message:
            return self._notified(method, params)
        try:
            if not isinstance(params, dict):
                raise _Error(_INVALID_PARAMS, "params must be an object")
            if method == "tools/call":
                return self._start(message["id"], params)
            self._write({"id": message["id"], "result": self._answer(method, params)})
        except _Error as error:
            self._fail(message["id"], error)

    def _notified(self, method: str, params: Any) -> None:
        if method == "notifications/cancelled" and isinstance(params, dict):
            running = self._running.get(_key(params.get("requestId")))
            if running:
                running[0].cancel()

    def _answer(self, method: str, params: dict[str, Any]) -> dict[str, Any]:
        if method == "initialize":
            self._is_initialized = True
            asked = params.get("protocolVersion")
            return {
                "protocolVersion": asked if asked in VERSIONS else VERSIONS[0],
                "capabilities": {"tools": {"listChanged": False}},
                "serverInfo": {"name": "unsnarl", "version": version},
                "instructions": _INSTRUCTIONS,
            }
        if method == "ping":
            return {}
        if not self._is_initialized:
            raise _Error(_INVALID_REQUEST, "The first request must be initialize")
        if method == "tools/list":
            return {"tools": [tool.declaration for tool in TOOLS.values()]}
        raise _Error(_METHOD_NOT_FOUND, f"There is no method {method}")

    def _start(self, request: Any, params: dict[str, Any]) -> None:
        if not self._is_initialized:
            raise _Error(_INVALID_REQUEST, "The first request must be initialize")
        tool = TOOLS.get(str(params.get("name")))
        if tool is None:
            raise _Error(_INVALID_PARAMS, f"There is no tool {params.get('name')!r}; there are {', '.join(TOOLS)}")
        if _key(request) in self._running:
            raise _Error(_INVALID_REQUEST, "A request with this id is running")
        meta = params.get("_meta")
        token = meta.get("progressToken") if isinstance(meta, dict) else None
        work = Work(self._limits, lambda fraction, text: self._tell(token, fraction, text))
        thread = threading.Thread(target=self._call, args=(request, tool, params.get("arguments", {}), work))
        with self._changing:
            self._running[_key(request)] = work, thread
        thread.start()

    def _call(self, request: Any, tool: Any, given: Any, work: Work) -> None:
        try:
            with self._turn:
                answer = tool.call(self._folders, checked(tool, given), work)
            text = answer.text + "\n" + json.dumps(answer.content, ensure_ascii=False)  # clients of 2025-03-26 read it
            result = {"content": [{"type": "text", "text": text}], "structuredContent": answer.content, "isError": False}
        except (Refused, OSError) as error:
            result = {"content": [{"type": "text", "text": str(error)}], "isError": True}
        except Exception as error:
            return self._fail(request, _Error(_INTERNAL_ERROR, f"{type(error).__name__}: {error}"))
        finally:
            with self._changing:
                del self._running[_key(request)]
        if not work.is_cancelled:  # nobody waits for the answer to a request that was cancelled
            self._write({"id": request, "result": result})

    def _tell(self, token: Any, fraction: float, text: str) -> None:
        if token is not None:
            self._write({"method": "notifications/progress",
                         "params": {"progressToken": token, "progress": fraction, "total": 1, "message": text}})

    def _fail(self, request: Any, error: _Error) -> None:
        self._write({"id": request, "error": {"code": error.code, "message": str(error)}})

    def _write(self, message: dict[str, Any]) -> None:
        line = json.dumps({"jsonrpc": "2.0", **message}, ensure_ascii=False) + "\n"
        with self._writing:
            try:
                self._out.write(line.encode("utf-8", "backslashreplace"))
                self._out.flush()
            except BrokenPipeError:
                pass  # the client has gone; the end of its lines is seen next


def _key(request: Any) -> str:
    """An id is a number or a text; 1 and "1" are two."""
    return json.dumps(request)


def _positive(text: str) -> float:
    value = float(text)
    if not 0 < value < float("inf"):
        raise ValueError
    return value


def main(arguments: Optional[Sequence[str]] = None) -> None:
    parser = argparse.ArgumentParser(
        prog="python -m unsnarl.mcp",
        description="Serves the tools check, fix and view to an assistant, by the Model Context Protocol over standard "
                    "input and output.",
    )
    parser.add_argument("folders", nargs="+", metavar="FOLDER", help="files in it and below may be read, and new ones written")
    parser.add_argument("--time-limit", type=_positive, default=600.0, metavar="SECONDS", help="of each call (default: 600)")
    parser.add_argument("--memory-limit", type=_positive, default=0.0, metavar="MB", help="of each call (default: none)")
    options = parser.parse_args(arguments)
    try:
        folders = Folders(options.folders)
    except Refused as error:
        parser.error(str(error))
    Server(folders, Limits(options.time_limit, options.memory_limit), sys.stdout.buffer).serve(sys.stdin.buffer)


if __name__ == "__main__":
    main()
