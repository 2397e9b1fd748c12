# SPDX-License-Identifier: GPL-3.0-or-later
"""A self-contained HTML page out of headings, tables, figures, verdicts and an animation."""
import base64
import html
import io

import matplotlib.pyplot as plt
from PIL import Image

from .words import typeset

STYLE = """
:root { --ink: #1c2430; --soft: #5a6675; --line: #dde3ea; --card: #ffffff; --ground: #f4f6f8; --accent: #0b6e8f;
        --good: #1b7f4b; --poor: #b26a00; --bad: #b3261e; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink); font: 16px/1.5 system-ui, "Segoe UI", Roboto, sans-serif; }
header { background: #10202e; color: #f2f6f9; padding: 1.6rem 1rem 1.4rem; }
header div, main, footer { max-width: 1180px; margin: 0 auto; }
header h1 { margin: 0 0 .3rem; font-size: 1.7rem; line-height: 1.2; }
header p { margin: 0; color: #b9c7d3; }
header .first { margin: 0 0 .8rem; padding: .5rem .8rem .5rem 1.9rem; border-left: 4px solid #ffb74d; background: #2a3442;
                border-radius: 4px; }
header, figcaption, li, .note { overflow-wrap: anywhere; }
td, th { min-width: 4.5rem; overflow-wrap: normal; word-break: normal; hyphens: none; }
nav { position: sticky; top: 0; z-index: 2; background: var(--card); border-bottom: 1px solid var(--line);
      overflow-x: auto; white-space: nowrap; }
nav ul { max-width: 1180px; margin: 0 auto; padding: .55rem 1rem; list-style: none; display: flex; gap: 1.1rem; }
a { color: var(--accent); text-decoration: none; }
a:hover { text-decoration: underline; }
main { padding: 0 1rem 2rem; }
section { scroll-margin-top: 3rem; padding-top: 1.4rem; }
h2 { margin: 0 0 .7rem; font-size: 1.3rem; }
h3 { margin: 0 0 .4rem; font-size: 1rem; }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 420px), 1fr)); gap: 1rem; }
.card { background: var(--card); border: 1px solid var(--line); border-radius: 8px; padding: 1rem; min-width: 0; }
.wide, .card:last-child:nth-child(odd) { grid-column: 1 / -1; }
figure { margin: 0; }
img { display: block; width: 100%; max-width: 600px; height: auto; margin: 0 auto; }
figcaption, .note { color: var(--soft); font-size: .9rem; margin: .5rem 0 0; }
/* A shade at the side towards which a table goes on */
.scroll { overflow-x: auto;
          background: linear-gradient(to right, var(--card) 50%, transparent) left / 40px 100% no-repeat local,
          linear-gradient(to left, var(--card) 50%, transparent) right / 40px 100% no-repeat local,
          linear-gradient(to right, #10202e40, transparent) left / 14px 100% no-repeat scroll,
          linear-gradient(to left, #10202e40, transparent) right / 14px 100% no-repeat scroll; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .3rem .7rem .3rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
thead th { color: var(--soft); font-weight: 600; }
tr:last-child td, tr:last-child th { border-bottom: 0; }
td.number { text-align: right; white-space: nowrap; }
ul.verdicts { list-style: none; margin: 0; padding: 0; }
ul.verdicts li { display: grid; grid-template-columns: 5.4rem 1fr; gap: .2rem .8rem; padding: .55rem 0;
                 border-bottom: 1px solid var(--line); }
ul.verdicts li > span { min-width: 0; }
ul.verdicts li:last-child { border-bottom: 0; }
.mark { font-weight: 700; }
.holds .mark { color: var(--good); } .look .mark { color: var(--poor); } .fails .mark { color: var(--bad); }
.unknown .mark { color: var(--soft); }
.do { grid-column: 2; color: var(--soft); }
.player { max-width: 620px; margin: 0 auto; }
.player div { display: flex; gap: .7rem; align-items: center; margin-top: .5rem; }
.player input { flex: 1; min-width: 0; accent-color: var(--accent); }
.player button { font: inherit; padding: .2rem .8rem; border: 1px solid var(--line); border-radius: 6px;
                 background: var(--ground); cursor: pointer; min-width: 4.6rem; }
pre { overflow-x: auto; font-size: .85rem; background: var(--ground); padding: .8rem; border-radius: 6px; }
footer { padding: 0 1rem 2rem; color: var(--soft); font-size: .9rem; }
@media (max-width: 480px) { main { padding: 0 .6rem 2rem; } .card { padding: .7rem; } header h1 { font-size: 1.35rem; } }
@media print { nav, .player div { display: none; } .card { break-inside: avoid; } }
"""

SCRIPT = """
for (const player of document.querySelectorAll(".player")) {
  const picture = player.querySelector("img"), range = player.querySelector("input"), button = player.querySelector("button");
  const frames = JSON.parse(player.querySelector("script").textContent);
  let timer = null;
  const show = number => { range.value = number; picture.src = frames[number]; };
  const stop = () => { clearInterval(timer); timer = null; button.textContent = "Play"; };
  const play = () => { timer = setInterval(() => show((+range.value + 1) % frames.length), 120); button.textContent = "Pause"; };
  range.addEventListener("input", () => { stop(); show(+range.value); });
  button.addEventListener("click", () => timer === null ? play() : stop());
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) play();
}
"""

MARKS = {"holds": "✓ holds", "look": "! look", "fails": "✗ fails", "unknown": "– not told"}


def text(words):
    """Plain text with its numbers typeset, escaped."""
    return html.escape(typeset(words))


def encode(figure, dpi=140, colours=256):
    """A matplotlib figure as a data URL of a PNG with a palette of so many colours."""
    drawn, buffer = io.BytesIO(), io.BytesIO()
    figure.savefig(drawn, dpi=dpi, format="png")
    Image.open(drawn).convert("RGB").quantize(colours, dither=Image.Dither.NONE).save(buffer, format="png", optimize=True)
    return "data:image/png;base64," + base64.b64encode(buffer.getvalue()).decode()


def picture(figure, caption, *, title=None):
    """A card with a figure. The caption, plain text, also tells those who cannot see it what it shows."""
    alt = text(f"{title}: {caption}" if title else caption)
    encoded = encode(figure)
    plt.close(figure)
    return ('<figure class="card">' + (f"<h3>{text(title)}</h3>" if title else "")
            + f'<img alt="{alt}" src="{encoded}"><figcaption>{text(caption)}</figcaption></figure>')


def table(head, rows, *, title=None, note=None, wide=False):
    """A card with a table; cells that are numbers (int, float or (value, format)) stand to the right."""
    def cell(value):
        if isinstance(value, tuple):
            return f'<td class="number">{text(format(*value))}</td>'
        if isinstance(value, (int, float)):
            return f'<td class="number">{text(format(value, ".4g"))}</td>'
        return f"<td>{text(value)}</td>"

    body = "".join("<tr>" + "".join(cell(value) for value in row) + "</tr>" for row in rows)
    top = "<thead><tr>" + "".join(f"<th>{text(word)}</th>" for word in head) + "</tr></thead>" if head else ""
    return (f'<div class="card{" wide" if wide else ""}">' + (f"<h3>{text(title)}</h3>" if title else "")
            + f'<div class="scroll"><table>{top}<tbody>{body}</tbody></table></div>'
            + (f'<p class="note">{text(note)}</p>' if note else "") + "</div>")


def verdicts(checks):
    """A card with one line per check (millfoam.report.checks.Check)."""
    lines = []
    for check in checks:
        words = check.advice + (f" A longer run does not change this: {check.meaning}." if check.lasting else "")
        advice = f'<span class="do">{text(words)}</span>' if words else ""
        lines.append(f'<li class="{check.state}"><span class="mark">{MARKS[check.state]}</span>'
                     f"<span><b>{text(check.name)}</b>: {text(check.found)}</span>{advice}</li>")
    return '<div class="card wide"><ul class="verdicts">' + "".join(lines) + "</ul></div>"


def player(figures, caption, *, title=None):
    """A card that shows figures one after the other, with a slider."""
    frames = [encode(figure, dpi=110, colours=96) for figure in figures]
    listed = "[" + ",".join(f'"{frame}"' for frame in frames) + "]"
    return ('<figure class="card">' + (f"<h3>{text(title)}</h3>" if title else "")
            + f'<div class="player"><img alt="{text(caption)}" src="{frames[0]}"><div><button type="button">Play</button>'
            f'<input type="range" aria-label="frame" min="0" max="{len(frames) - 1}" value="0"></div>'
            f'<script type="application/json">{listed}</script></div><figcaption>{text(caption)}</figcaption></figure>')


def paragraph(words):
    return f'<p class="note">{text(words)}</p>'


def folded(title, content):
    """Preformatted text that opens on a click."""
    return f'<details class="card wide"><summary>{text(title)}</summary><pre>{html.escape(content)}</pre></details>'


def page(title, subtitle, sections, foot, first=()):
    """The whole document. sections: (id, heading, [cards]); those without cards are left out. first: sentences that
    stand above the title."""
    shown = [(name, heading, cards) for name, heading, cards in sections if cards]
    links = "".join(f'<li><a href="#{name}">{text(heading)}</a></li>' for name, heading, _ in shown)
    body = "".join(f'<section id="{name}"><h2>{text(heading)}</h2><div class="cards">{"".join(cards)}</div></section>'
                   for name, heading, cards in shown)
    above = "".join(f"<li>{text(line)}</li>" for line in first)
    above = f'<ul class="first">{above}</ul>' if first else ""
    return ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width, initial-scale=1"><link rel="icon" href="data:,">'
            f"<title>{text(title)}</title><style>{STYLE}</style></head><body>"
            f"<header><div>{above}<h1>{text(title)}</h1><p>{text(subtitle)}</p></div></header><nav><ul>{links}</ul></nav>"
            f"<main>{body}</main><footer>{text(foot)}</footer><script>{SCRIPT}</script></body></html>\n")
