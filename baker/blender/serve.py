"""A web server for this computer alone: the viewer's page and the baked folders that it shows."""

from __future__ import annotations

from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from urllib.parse import unquote, urlsplit

PAGE = Path(__file__).parent / "page"

VIEWER = "fur-view.js"
"""The element `<fur-view>` with the library, put into the extension when it is packed."""

TYPES = {
    ".html": "text/html; charset=utf-8", ".css": "text/css", ".js": "text/javascript", ".gltf": "model/gltf+json",
    ".bin": "application/octet-stream", ".png": "image/png", ".jpg": "image/jpeg", ".json": "application/json",
}  # fmt: skip
"""Endings that are served; Python's own table is the system's, which may call scripts plain text."""

POLICY = "default-src 'self'; connect-src 'self' blob: data:; img-src 'self' blob: data:"


class Server:
    """Serves while Blender runs. A folder is at `/NUMBER/`, in the order in which they were shown."""

    def __init__(self, page: Path = PAGE) -> None:
        """Start. Raises OSError where no port is free."""
        self.folders: list[Path] = []
        server = self

        class Handler(BaseHTTPRequestHandler):
            def do_GET(self) -> None:
                path = server.file(page, self.path) if self._here() else None
                if path is None:
                    self.send_error(HTTPStatus.NOT_FOUND)
                    return
                data = path.read_bytes()
                self.send_response(HTTPStatus.OK)
                self.send_header("Content-Type", TYPES[path.suffix.lower()])
                self.send_header("Content-Length", str(len(data)))
                self.send_header("Content-Security-Policy", POLICY)
                # A folder that is baked again has the same address.
                self.send_header("Cache-Control", "no-store")
                self.end_headers()
                self.wfile.write(data)

            def _here(self) -> bool:
                """True where this computer's own name was asked: a page elsewhere could have another name for it."""
                return self.headers.get("Host", "").partition(":")[0] in {"127.0.0.1", "localhost"}

            def log_message(self, *_arguments: object) -> None:
                """Nothing: Blender's console is the artist's."""

        self._server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self._server.daemon_threads = True
        self.address = f"http://127.0.0.1:{self._server.server_port}/"
        Thread(target=self._server.serve_forever, daemon=True).start()

    def show(self, folder: Path) -> str:
        """Address of the page that shows a baked folder."""
        folder = folder.resolve()
        if folder not in self.folders:
            self.folders.append(folder)
        return f"{self.address}?model={self.folders.index(folder)}"

    def file(self, page: Path, address: str) -> Path | None:
        """The file at an address: one that lies in the page's folder or in one that is shown, by its own name."""
        first, _, rest = unquote(urlsplit(address).path).lstrip("/").partition("/")
        folder, name = (page, first or "index.html") if not rest else (self._numbered(first), rest)
        if folder is None or Path(name).suffix.lower() not in TYPES:
            return None
        return next((path for path in folder.iterdir() if path.name == name and path.is_file()), None)

    def _numbered(self, text: str) -> Path | None:
        known = text.isascii() and text.isdigit() and int(text) < len(self.folders)
        return self.folders[int(text)] if known and self.folders[int(text)].is_dir() else None

    def close(self) -> None:
        self._server.shutdown()
        self._server.server_close()
