# SPDX-License-Identifier: MIT
"""report.html: one file with the pictures in it, that needs no network."""

from __future__ import annotations

import base64
from html import escape

from .figure import Figure
from .tables import Rows

STYLE = """
:root { --text: #1c2126; --soft: #5d666f; --line: #dde1e6; --paper: #ffffff; --tint: #f5f7f9; --accent: #0072B2; --warn: #fff4e0; }
@media (prefers-color-scheme: dark) {
  :root { --text: #e4e8ec; --soft: #9aa4ae; --line: #363d45; --paper: #15191d; --tint: #1e2429; --accent: #56B4E9; --warn: #3a2f18; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 76rem; padding: 1.5rem 1.5rem 4rem; background: var(--paper); color: var(--text);
  font: 16px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
h1 { font-size: 1.7rem; margin: 0 0 .2rem; } h2 { font-size: 1.25rem; margin: 2.5rem 0 .6rem; border-bottom: 1px solid var(--line); }
h3 { font-size: 1rem; margin: 1.4rem 0 .4rem; }
p, figcaption { color: var(--soft); margin: .3rem 0; font-size: .92rem; } a { color: var(--accent); }
nav { margin: .6rem 0 1rem; } nav a { margin-right: 1.1rem; text-decoration: none; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .28rem .9rem .28rem .5rem; border-bottom: 1px solid var(--line); vertical-align: top; }
thead th { border-bottom: 2px solid var(--line); white-space: nowrap; } tbody th { font-weight: 500; color: var(--soft); }
table.headline { font-size: 1rem; background: var(--tint); } table.headline td { font-weight: 600; padding-right: 1.8rem; }
figure { margin: 1.4rem 0 2rem; } figure img { height: auto; border: 1px solid var(--line); background: #fff; }
figure h3 { margin: 0 0 .4rem; }
.notes { background: var(--warn); padding: .6rem 1rem; border-radius: 4px; margin: 1rem 0; } .notes li, .notes p { color: var(--text); }
details { margin: .5rem 0; } summary { cursor: pointer; color: var(--accent); }
pre { background: var(--tint); padding: .8rem 1rem; overflow-x: auto; font-size: .8rem; line-height: 1.35; }
"""


def table(rows: Rows, kind: str = "") -> str:
    """The first row is the header, the first cell of each row names it."""
    if not rows:
        return ""
    head = "".join(f"<th>{escape(cell)}</th>" for cell in rows[0])
    body = "".join("<tr><th>" + escape(row[0]) + "</th>" + "".join(f"<td>{escape(cell)}</td>" for cell in row[1:]) + "</tr>\n" for row in rows[1:])
    return f'<div class="scroll"><table class="{kind}"><thead><tr>{head}</tr></thead>\n<tbody>{body}</tbody></table></div>\n'


def figure(item: Figure, files: str) -> str:
    """The picture itself, and links to its PNG and CSV beside the report."""
    data = base64.b64encode(item.png).decode("ascii")
    width = f"width: min(100%, {item.inches * 6.6:.1f}rem)"
    links = f'<a href="{escape(files)}/{item.name}.png">PNG</a> · <a href="{escape(files)}/{item.name}.csv">CSV</a>'
    return (f'<figure id="{item.name}"><h3>{escape(item.title)}</h3><img alt="{escape(item.title)}" style="{width}" src="data:image/png;base64,{data}">'
            f"<figcaption>{escape(item.caption)} {links}</figcaption></figure>\n")


def notes(title: str, lines: list[str]) -> str:
    if not lines:
        return ""
    return f'<div class="notes"><p>{escape(title)}</p><ul>' + "".join(f"<li>{escape(line)}</li>" for line in lines) + "</ul></div>\n"


def details(title: str, text: str) -> str:
    return f"<details><summary>{escape(title)}</summary><pre>{escape(text)}</pre></details>\n"


def section(name: str, title: str, *parts: str) -> tuple[str, str, str]:
    """Sections without content are left out."""
    return name, title, "".join(parts)


def page(title: str, subtitle: str, sections: list[tuple[str, str, str]]) -> str:
    shown = [item for item in sections if item[2]]
    links = "".join(f'<a href="#{name}">{escape(heading)}</a>' for name, heading, _ in shown)
    body = "".join(f'<section id="{name}"><h2>{escape(heading)}</h2>\n{content}</section>\n' for name, heading, content in shown)
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
            f"<title>{escape(title)}</title><style>{STYLE}</style></head>\n"
            f"<body><h1>{escape(title)}</h1><p>{escape(subtitle)}</p><nav>{links}</nav>\n{body}</body></html>\n")
