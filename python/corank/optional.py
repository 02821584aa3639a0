"""Packages that some of corank's functions hand their answers to: they are asked for where they are used."""

from __future__ import annotations

import importlib
from typing import Any


def require(module: str) -> Any:
    """The module. Where its package is not installed: an error that says how it is."""
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        package = module.partition(".")[0]
        if error.name != package:
            raise
        raise ModuleNotFoundError(
            f"this needs the Python package {package}: apt-get install python3-{package}", name=package
        ) from None
