"""What notebooks show: tables of verdicts, equations, pages inside a cell."""

from __future__ import annotations

import html
import os
from typing import TYPE_CHECKING, Any, List, Optional, Union

from .point import _short

if TYPE_CHECKING:
    from .mechanism import Mechanism
    from .result import Result

_MOST_POINTS = 20


class Page:
    """A self-contained HTML page. A notebook shows it inside the cell, with its 3-D view.

    Attributes:
        html: the text of the page.
        path: where it was written; None if it was not written.
        height: the height of the frame in a notebook, in pixels.
    """

    def __init__(self, text: str, path: Optional[str] = None) -> None:
        self.html = text
        self.path = path
        self.height = 600

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the page to a file."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.html)

    def _repr_html_(self) -> str:
        return (
            f'<iframe srcdoc="{html.escape(self.html, quote=True)}" style="width:100%;border:0" height="{self.height}">'
            "</iframe>"
        )

    def __repr__(self) -> str:
        return f"<page of {len(self.html)} characters{', ' + self.path if self.path else ''}>"


def _table(rows: List[List[Any]], head: List[str]) -> str:
    def line(cells: List[Any], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag}>{html.escape(str(c))}</{tag}>" for c in cells) + "</tr>"

    return "<table>" + line(head, "th") + "".join(line(row, "td") for row in rows) + "</table>"


def result_html(result: "Result") -> str:
    """The table of verdicts, and the first points of a set of points."""
    state = "complete" if result.complete else "incomplete"
    if result.stopped:
        state += f", stopped by {result.stopped}"
    head = (
        f"<p><b>{html.escape(result.model)}</b>, {html.escape(result.set)}: dimension {result.dimension}, "
        f"&sigma; = {result.sigma.length:g} in lengths, {result.sigma.angle:g} in sines and "
        f"cosines; {html.escape(state)}</p>"
    )
    rows = [[word, n] for word, n in result.counts.items()] + [["all", len(result)]]
    some = result.summary["parts_of_sheets"]
    if some:
        rows.append(["with a part of a sheet", some])
    text = head + _table(rows, ["verdict", "boxes"])
    points = result.points
    if points:
        names = result.coordinates
        listed = [[p.verdict, ", ".join(p.types), *(_short(p[n]) for n in names)] for p in points[:_MOST_POINTS]]
        text += _table(listed, ["point", "types", *names])
        if len(points) > _MOST_POINTS:
            text += f"<p>and {len(points) - _MOST_POINTS} more</p>"
    return text


def mechanism_html(mechanism: "Mechanism") -> str:
    """Its coordinates, and its equations in LaTeX."""
    rows = [
        [c.name, c.kind, "" if c.lower is None else f"[{c.lower}, {c.upper}]", mechanism._role(c.name)]
        for c in mechanism.coordinates
    ]
    equations = " \\\\ ".join(mechanism._core.equations_in_latex)
    robot = f": {html.escape(mechanism.robot)}" if mechanism.robot else ""
    return (
        f"<p><b>{html.escape(mechanism.name)}</b>{robot}</p>"
        + _table(rows, ["coordinate", "kind", "range", "role"])
        + f"\n\n$$\\begin{{gathered}} {html.escape(equations, quote=False)} \\end{{gathered}}$$"
    )
