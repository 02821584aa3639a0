"""The studio: a page on which a mechanism is changed while its sets are computed anew."""

from __future__ import annotations

import html
import json
import os
import subprocess
import sys
import webbrowser
from typing import TYPE_CHECKING, Any, Optional

if TYPE_CHECKING:
    from .mechanism import Mechanism

_SERVE = """import json, sys
sys.path.insert(0, sys.argv[1])
from corank import _corank
try:
    _corank.serve_studio(on_address=lambda address: print(address, flush=True), **json.load(sys.stdin))
except _corank.ServerError as error:
    print(f"corank: {error}", file=sys.stderr)
    sys.exit(1)
"""


class Studio:
    """The studio of a mechanism, in a process of its own. A notebook shows its page inside the cell.

    It ends with close(), at the end of a with statement, or with the process that has made it.

    Attributes:
        address: of the page, with its token; on this machine only.
        height: the height of the frame in a notebook, in pixels.
    """

    def __init__(self, name: str, text: str, port: int = 0, threads: int = 0) -> None:
        folder = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
        self.height = 900
        self._process = subprocess.Popen(  # it outlives this function
            [sys.executable, "-c", _SERVE, folder], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        assert self._process.stdin and self._process.stdout
        with self._process.stdin as asked:
            json.dump({"file": f"{name}.cuik", "text": text, "port": port, "threads": threads}, asked)
        self.address = self._process.stdout.readline().strip()
        if not self.address:
            self._process.wait()
            raise OSError(f"the studio cannot listen on port {port} of 127.0.0.1")

    @property
    def running(self) -> bool:
        """Is its process there?"""
        return self._process.poll() is None

    def close(self) -> None:
        """Ends the studio and what it computes."""
        if self.running:
            self._process.terminate()
            self._process.wait()
        if self._process.stdout:
            self._process.stdout.close()

    def __enter__(self) -> "Studio":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __del__(self) -> None:
        if hasattr(self, "_process"):
            self.close()

    def _repr_html_(self) -> str:
        address = html.escape(self.address, quote=True)
        return (
            f'<iframe src="{address}" style="width:100%;border:0" height="{self.height}" allow="clipboard-write"></iframe>'
        )

    def __repr__(self) -> str:
        return f"<studio at {self.address}>" if self.running else "<studio that has ended>"


def studio(self: "Mechanism", *, port: int = 0, threads: int = 0, browser: Optional[bool] = None) -> Studio:
    """Opens the studio: a page on which the mechanism is changed while its sets are computed anew.

    Args:
        port: of 127.0.0.1; 0: any that is free.
        threads: of a search; 0: one for each core.
        browser: open the page in the browser? None: except in a notebook, which shows it in the cell.

    Raises:
        OSError: if the port is taken.
    """
    made = Studio(self.name, self.text, port, threads)
    if browser if browser is not None else "ipykernel" not in sys.modules:
        webbrowser.open(made.address)
    return made
