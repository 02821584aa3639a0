"""Progress of a computation: a bar if tqdm is installed, else a line on standard error."""

from __future__ import annotations

import sys
import time
from typing import Any, Callable, Optional, Union

#: A function of the stage ("search" …), the share of it that is done (0 … 1; None: not known) and a text about it.
ProgressFunction = Callable[[str, Optional[float], str], None]
#: None: show progress on a terminal and in a notebook; True: always; False: never; or a function of your own.
ProgressOption = Union[None, bool, ProgressFunction]

_DELAY = 0.5  # seconds before the first picture: what is done sooner needs none


def _in_notebook() -> bool:
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    return shell is not None and shell.__class__.__name__ == "ZMQInteractiveShell"


class _Line:
    def show(self, stage: str, share: Optional[float], text: str) -> None:
        percent = "" if share is None else f" {100 * share:3.0f} %"
        sys.stderr.write("\r\033[K" + ", ".join(word for word in (f"{stage}{percent}", text) if word))
        sys.stderr.flush()

    def close(self) -> None:
        sys.stderr.write("\r\033[K")
        sys.stderr.flush()


class _Cell:
    """A line in a notebook's cell that is empty in the end."""

    def __init__(self) -> None:
        from IPython.display import display

        self._handle = display({"text/plain": ""}, raw=True, display_id=True)

    def show(self, stage: str, share: Optional[float], text: str) -> None:
        percent = "" if share is None else f" {100 * share:3.0f} %"
        self._handle.update({"text/plain": ", ".join(word for word in (f"{stage}{percent}", text) if word)}, raw=True)

    def close(self) -> None:
        self._handle.update({"text/plain": ""}, raw=True)


class _Bar:
    def __init__(self, tqdm: Any) -> None:
        self._bar = tqdm(total=1.0, leave=False, bar_format="{desc} {percentage:3.0f}%|{bar}| {elapsed}{postfix}")

    def show(self, stage: str, share: Optional[float], text: str) -> None:
        self._bar.set_description_str(stage, refresh=False)
        self._bar.set_postfix_str(text, refresh=False)
        self._bar.n = 0.0 if share is None else min(1.0, share)
        self._bar.refresh()

    def close(self) -> None:
        self._bar.close()


def _new_picture() -> Any:
    if _in_notebook():
        try:
            import ipywidgets  # noqa: F401  tqdm's bar in a notebook is made of them
            from tqdm.notebook import tqdm
        except ImportError:
            return _Cell()
        return _Bar(tqdm)
    try:
        from tqdm import tqdm
    except ImportError:
        return _Line()
    return _Bar(tqdm)


class Shown:
    """For the time of a `with`: the function to call with the progress, or None."""

    def __init__(self, option: ProgressOption) -> None:
        if option is None:
            option = sys.stderr.isatty() or _in_notebook()
        self._function: Optional[ProgressFunction] = option if callable(option) else None
        self._visible = bool(option)
        self._picture: Any = None
        self._since = time.monotonic()

    def __enter__(self) -> Optional[Callable[[str, float, str], None]]:
        return self._news if self._visible else None

    def __exit__(self, *_: Any) -> None:
        if self._picture is not None:
            self._picture.close()

    def _news(self, stage: str, share: float, text: str) -> None:
        known = None if share < 0 else share
        if self._function is not None:
            self._function(stage, known, text)
        elif time.monotonic() - self._since >= _DELAY:
            if self._picture is None:
                self._picture = _new_picture()
            self._picture.show(stage, known, text)
