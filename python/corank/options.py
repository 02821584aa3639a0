"""Questions and options of searches, as the extension takes them."""

from __future__ import annotations

from typing import Any, Optional

from . import _corank


def make_options(**values: Any) -> _corank.Options:
    """The options of a search. A memory_limit of None is the machine's."""
    options = _corank.Options()
    for name, value in values.items():
        if name == "memory_limit" and value is None:
            continue
        setattr(options, name, value)
    options.validate()
    return options


def ask(core: _corank.Model, set: Optional[str] = None, default: str = "cspace") -> _corank.Question:
    """A question about a set of a mechanism, by default all its configurations, or about a plain system."""
    return _corank.Question(core, set if set is not None or core.plain else default)
