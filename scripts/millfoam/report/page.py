# SPDX-License-Identifier: GPL-3.0-or-later
"""A self-contained HTML page of headings, tables, figures, verdicts and an animation; html/ holds its parts."""
import base64
import html
import io
import re
from collections.abc import Iterable, Sequence
from functools import cache
from importlib.resources import files
from string import Template
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.figure import Figure
from PIL import Image

from ..plots.drawing import drawn
from .verdict import Check
from .words import typeset

Section = tuple[str, str, list[str]]  # id, heading, cards
MARKS = {"holds": "✓ holds", "look": "! look", "fails": "✗ fails", "unknown": "– not known"}


def part(name: str) -> str:
    """Text of a file in html/."""
    return (files(__package__) / "html" / name).read_text(encoding="utf-8")


@cache
def template(name: str) -> Template:
    """Template of html/NAME.html, in which a line that begins with blanks continues the one above."""
    return Template(re.sub(r"\n +", "", part(f"{name}.html")).removesuffix("\n"))


def fill(name: str, /, **values: Any) -> str:
    """html/NAME.html with these values: HTML, not escaped here."""
    return template(name).substitute(values)


def text(words: str) -> str:
    """Plain text with its numbers typeset, escaped."""
    return html.escape(typeset(words))


def encode(figure: Figure, dpi: int = 140, colours: int = 256) -> str:
    """A matplotlib figure, which is closed, as a data URL of a PNG with a palette of `colours` colours."""
    image = drawn(figure, dpi).convert("RGB").quantize(colours, dither=Image.Dither.NONE)
    plt.close(figure)
    buffer = io.BytesIO()
    image.save(buffer, format="png", optimize=True)
    return "data:image/png;base64," + base64.b64encode(buffer.getvalue()).decode()


def card_title(title: str | None) -> str:
    """The heading of a card, nothing without a title."""
    return f"<h3>{text(title)}</h3>" if title else ""


def picture(figure: Figure, caption: str, *, title: str | None = None) -> str:
    """A card with a figure. The caption, plain text, is also its description for screen readers."""
    alt = f"{text(title)}: {text(caption)}" if title else text(caption)
    encoded = encode(figure)
    plt.close(figure)
    return fill("picture", title=card_title(title), words=alt, image=encoded, caption=text(caption))


def table(head: Sequence[str] | None, rows: Iterable[Sequence[Any]], *, title: str | None = None,
          note: str | None = None, wide: bool = False) -> str:
    """A card with a table; cells that are numbers (int, float or (value, format)) are aligned right."""
    def cell(value: Any) -> str:
        if isinstance(value, tuple):
            return f'<td class="number">{text(format(*value))}</td>'
        if isinstance(value, (int, float)):
            return f'<td class="number">{text(format(value, ".4g"))}</td>'
        return f"<td>{text(value)}</td>"

    body = "".join("<tr>" + "".join(cell(value) for value in row) + "</tr>" for row in rows)
    top = "<thead><tr>" + "".join(f"<th>{text(word)}</th>" for word in head) + "</tr></thead>" if head else ""
    return fill("table", classes="card wide" if wide else "card", title=card_title(title), head=top, rows=body,
                note=paragraph(note) if note else "")


def verdicts(checks: Iterable[Check]) -> str:
    """A card with one line per check (millfoam.report.checks.Check)."""
    lines = []
    for check in checks:
        words = check.advice + (f" A longer run does not change this: {check.meaning}." if check.lasting else "")
        advice = f'<span class="do">{text(words)}</span>' if words else ""
        lines.append(fill("verdict", state=check.state, mark=MARKS[check.state], name=text(check.name),
                          found=text(check.found), advice=advice))
    return fill("verdicts", verdicts="".join(lines))


def player(figures: Iterable[Figure], caption: str, *, title: str | None = None) -> str:
    """A card that shows figures one after the other, with a slider."""
    frames = [encode(figure, dpi=110, colours=96) for figure in figures]
    listed = "[" + ",".join(f'"{frame}"' for frame in frames) + "]"
    return fill("player", title=card_title(title), caption=text(caption), first=frames[0], last=len(frames) - 1,
                frames=listed)


def paragraph(words: str) -> str:
    """A paragraph of plain text."""
    return f'<p class="note">{text(words)}</p>'


def folded(title: str, content: str) -> str:
    """Preformatted text that opens on a click."""
    return fill("folded", title=text(title), content=html.escape(content))


def page(title: str, subtitle: str, sections: Iterable[Section], foot: str, first: Sequence[str] = ()) -> str:
    """The whole document. sections: (id, heading, [cards]); those without cards are left out. first: sentences above
    the title."""
    shown = [(name, heading, cards) for name, heading, cards in sections if cards]
    links = "".join(f'<li><a href="#{name}">{text(heading)}</a></li>' for name, heading, _ in shown)
    filled = (fill("section", name=name, heading=text(heading), cards="".join(cards)) for name, heading, cards in shown)
    above = "".join(f"<li>{text(line)}</li>" for line in first)
    return fill("page", title=text(title), subtitle=text(subtitle), foot=text(foot), links=links,
                first=f'<ul class="first">{above}</ul>' if first else "", sections="".join(filled),
                style=part("style.css"), script=part("player.js")) + "\n"
