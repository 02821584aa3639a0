"""Packages that only some of corank's functions need. They are imported when such a function is called."""

from __future__ import annotations

import importlib
import importlib.util
from typing import Any


_VERSIONS = {"numpy": "'numpy<2'"}  # as the wheel asks for: the extension module speaks to NumPy 1


def _missing(package: str) -> ModuleNotFoundError:
    wanted = _VERSIONS.get(package, package)
    return ModuleNotFoundError(
        f"this needs the Python package {package}: apt-get install python3-{package}, or pip install {wanted}", name=package
    )


def require(module: str) -> Any:
    """Returns the module; if its package is not installed, raises an error that says how to install it."""
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        package = module.partition(".")[0]
        if error.name != package:
            raise
        raise _missing(package) from None


class _Numpy:
    """NumPy, imported where one of its names is asked for: searches, proofs and reports need none of it."""

    def __getattr__(self, name: str) -> Any:
        return getattr(require("numpy"), name)


numpy = _Numpy()


def expect(package: str) -> None:
    """Raises the same error, but does not import the package if it is installed."""
    if importlib.util.find_spec(package) is None:
        raise _missing(package)
