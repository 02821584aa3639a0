"""The exceptions of corank. For bad input it is a ValueError that says where the fault is; for Ctrl-C it is a
KeyboardInterrupt that holds what was proven by then."""

from __future__ import annotations

import re
from typing import Any, Optional

# What the library's texts name as on a command line, and what it is called here; the first that fits is taken. Options
# behind "corank solve" are meant as such.
_SAID_HERE = [
    (r"--over NAME=FROM:TO twice", "over={NAME: (FROM, TO), NAME: (FROM, TO)}"),
    (r"no --fix\b", "no fixed"),
    (r"--map (\w+)=\[0,1\],(\w+)=\[0,1\]", r'region={"\1": (0, 1), "\2": (0, 1)}'),
    (r"--map (\w+)=\[0,1\],…", r'region={"\1": (0, 1), …}'),
    (r"--map (\w+),(\w+)", r'region=("\1", "\2")'),
    (r"--at for one centre", "clearance() for one centre"),
    (r"--at (\w+)=([\d.]+)", r'at={"\1": \2}'),
    (r"--in (\w+),(\w+)", r'within=("\1", "\2")'),
    (r"--outputs NAME,NAME", 'outputs=("NAME", "NAME")'),
    (r"--outputs:", "outputs:"),
    (r"--orientation R\b", 'orientation="R"'),
    (r"--orientation-range (\d+)deg", r"orientation_range=corank.degrees(\1)"),
    (r"--orientation-of (\w+)", r'orientation_of="\1"'),
    (r"--tolerance (\S+)", r"tolerance=\1"),
    (r"--corank (\d+)", r"corank=\1"),
    (r"--kernel (\w+)", r'kernel="\1"'),
    (r"\(all coordinates: --json\)", "(all coordinates: sample)"),
    (r"(?<=more: )--json\b", "summary"),
    (r"corank derive FILE --format model prints these equations as", "Mechanism.text has these equations as"),
    (r"-D (?=\w+:)", ""),
    (r"\b(start|end)-mode\b", r"\1_mode"),
]
_SAID = [(re.compile(r"(?<![\w-])" + option if option.startswith("-") else option), said) for option, said in _SAID_HERE]


def in_python(text: str) -> str:
    """A text of corank's library with the names of Python's arguments in place of the command line's options."""
    for option, said in _SAID:
        text = option.sub(said, text)
    return text


class ModelError(ValueError):
    """A model is wrong, or it does not fit the question.

    Attributes:
        file: the name of the file; for a model that was built in Python, "model" or the text itself.
        line, column: counted from 1; None if unknown.
    """

    def __init__(self, message: str, file: str = "", line: int = 0, column: int = 0) -> None:
        super().__init__(in_python(message))
        self.file = in_python(file + ":")[:-1]
        self.line: Optional[int] = line or None
        self.column: Optional[int] = column or None

    def __reduce__(self) -> Any:
        return type(self), (self.args[0], self.file, self.line or 0, self.column or 0)


class ResultFileError(OSError):
    """A file cannot be written or read, or is not a result file.

    Attributes:
        line: the line of a text file, counted from 1; None for other files.
    """

    def __init__(self, message: str, line: int = 0) -> None:
        super().__init__(in_python(message))
        self.line: Optional[int] = line or None

    def __reduce__(self) -> Any:
        return type(self), (self.args[0], self.line or 0)


class OptionError(ValueError):
    """An option has a value that it cannot have.

    Attributes:
        option: its name, such as "sigma".
        reason: what is wrong with the value.
    """

    def __init__(self, option: str, reason: str) -> None:
        super().__init__(f"{option}: {reason}")
        self.option = option
        self.reason = reason

    def __reduce__(self) -> Any:
        return type(self), (self.option, self.reason)


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a computation early.

    What was proven by then holds: ``result`` is a valid result, whose ``stopped`` and pending boxes say what is missing.
    At a prompt and in a notebook it is ``sys.last_value.result``.

    Attributes:
        result: what the function would have returned, as far as it is known.
    """

    def __init__(self, result: Any) -> None:
        super().__init__(f"ended early; the attribute 'result' of this exception holds what was proven by then: {result!r}")
        self.result = result

    def __reduce__(self) -> Any:
        return type(self), (self.result,)


def deliver(result: Any, raised: Optional[BaseException]) -> Any:
    """The result; or raises what ended its computation early, which brings it."""
    if raised is None:
        return result
    if isinstance(raised, KeyboardInterrupt):
        raise Interrupted(result) from None
    raise raised
