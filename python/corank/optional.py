"""Packages that some of corank's functions hand their answers to: they are asked for where they are used."""

from __future__ import annotations

import importlib
import importlib.util
from typing import Any


def _missing(package: str) -> ModuleNotFoundError:
    return ModuleNotFoundError(
        f"this needs the Python package {package}: apt-get install python3-{package}, or pip install {package}", name=package
    )


def require(module: str) -> Any:
    """The module. Where its package is not installed: an error that says how it is."""
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
    """The same error; a package that is there is not imported yet."""
    if importlib.util.find_spec(package) is None:
        raise _missing(package)
