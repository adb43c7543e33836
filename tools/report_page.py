# SPDX-License-Identifier: GPL-2.0-or-later
"""The parts of report.html: tables, pictures, style and script, all within the page."""
import base64
import io
import math
from html import escape

import numpy as np

from plot_common import readable

# The page may load nothing, not even if the text of a scene or a log contains markup.
POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"

STYLE = """
:root { --ink: #1b2733; --soft: #5d6b78; --line: #d8dee4; --accent: #0072b2; --bad: #b33c00; }
body { font: 15px/1.45 "DejaVu Sans", "Segoe UI", Roboto, sans-serif; color: var(--ink);
       max-width: 66rem; margin: 0 auto; padding: 1.2rem; background: #fff; }
h1 { font-size: 1.5rem; margin: 0; } h2 { font-size: 1.1rem; margin: 1.6rem 0 .4rem;
     border-bottom: 1px solid var(--line); break-after: avoid; }
p, ul { margin: .4rem 0; } .soft { color: var(--soft); } .bad { color: var(--bad); }
.answer { font-size: 1.1rem; border-left: 4px solid var(--accent); padding: .3rem .8rem;
          margin: .8rem 0; background: #f3f8fb; }
.scroll { overflow-x: auto; margin-bottom: .7rem; } .plot img { max-height: 30rem; }
 table { border-collapse: collapse; font-size: .85rem; }
th, td { padding: .22rem .6rem; text-align: right; border-bottom: 1px solid var(--line);
         vertical-align: top; font-variant-numeric: tabular-nums; }
th { cursor: pointer; background: #f5f7f9; vertical-align: bottom; } th small { font-weight: normal;
     color: var(--soft); display: block; } td { white-space: nowrap; }
.text { text-align: left; } td.text { white-space: normal; } td.text span { white-space: nowrap; }
td.long { min-width: 11rem; }
th[aria-sort=ascending]::after { content: " ▴"; } th[aria-sort=descending]::after { content: " ▾"; }
figure { margin: .4rem 0; break-inside: avoid; } figcaption { font-size: .8rem; color: var(--soft); }
img { max-width: 100%; height: auto; } .pictures { display: grid; gap: .6rem;
      grid-template-columns: repeat(auto-fit, minmax(min(26rem, 100%), 1fr)); }
.columns { columns: 19rem; font-size: .8rem; } .columns div { break-inside: avoid; }
.columns dl { margin: 0 0 .6rem; } dt { float: left; clear: left; color: var(--soft);
      margin-right: .5rem; } dd { margin: 0; overflow-wrap: anywhere; text-align: right; }
code, pre { font-family: "DejaVu Sans Mono", monospace; font-size: .82rem; background: #f5f7f9;
      padding: .1rem .3rem; } pre { padding: .5rem; overflow-x: auto; }
@media (max-width: 40rem) { body { padding: .8rem; } td.text:not(.long) { white-space: nowrap; }
  .plot { overflow-x: auto; } .plot img { min-width: 38rem; } }
@media print { @page { size: A4; margin: 11mm; } body { font-size: 8.5pt; padding: 0; max-width: none; }
  h2 { margin: .6rem 0 .2rem; } details { display: none; } th, td { padding: .1rem .35rem; }
  .pictures { grid-template-columns: repeat(3, 1fr); gap: .2rem .6rem; } .plot img { max-height: 5cm; }
  .answer { font-size: 9.5pt; margin: .3rem 0; } figure, p, .scroll { margin: .15rem 0; }
  figcaption { font-size: 6.5pt; }
  td.long { min-width: 0; } .columns { columns: 4; font-size: 6pt; column-gap: .8rem; } ul { font-size: 7.5pt; } table { font-size: 7.5pt; } .scroll { overflow: visible; }
}
"""

SCRIPT = """
document.querySelectorAll("th").forEach(head => head.addEventListener("click", () => {
  const body = head.closest("table").tBodies[0], column = head.cellIndex;
  const up = head.getAttribute("aria-sort") !== "ascending";
  const key = row => row.cells[column].dataset.value;
  const compare = (a, b) => isNaN(a) || isNaN(b) ? a.localeCompare(b) : a - b;
  head.parentNode.querySelectorAll("th").forEach(other => other.removeAttribute("aria-sort"));
  head.setAttribute("aria-sort", up ? "ascending" : "descending");
  [...body.rows].sort((a, b) => (up ? 1 : -1) * compare(key(a), key(b)))
    .forEach(row => body.append(row));
}));
"""

class Column:
    """A column of a table: heading, unit, and for each row the text shown and the sort key."""

    def __init__(self, name, unit, values, errors=None):
        self.name, values = name, np.asarray(values)
        self.is_text = values.dtype.kind not in "fiu"
        factor, self.unit = (1, unit) if self.is_text else readable(unit, values)
        self.keys = [str(value) for value in values]
        self.shown = self.keys if self.is_text else [number(value / factor) for value in values]
        if errors is not None:
            self.shown = [text + (f" ± {percent(error)}" if np.isfinite(error) and value != 0 else "")
                          for text, value, error in zip(self.shown, values, errors)]

    def cell(self, row):
        """The HTML of the cell in a row."""
        text, kind = escape(self.shown[row]), " class=text" if self.is_text else ""
        if len(text) > 40:
            kind = ' class="text long"'
        if len(text) < 12:
            text = text.replace(" ", "&nbsp;")
        if self.is_text and " " not in text:  # lines break between the words of a status
            text = " ".join(f"<span>{word}</span>" for word in text.split("+"))
        return f'<td{kind} data-value="{escape(self.keys[row])}">{text}</td>'


def quantity(value, unit, digits=4):
    """A number with the unit that reads best, if the scene states units."""
    factor, unit = readable(unit, np.array([value]))
    return f"{value / factor:.{digits}g}" + (f" {unit}" if unit else "")


def number(value):
    """A number to four digits; a dash if it is not finite."""
    return "–" if not math.isfinite(value) else f"{value:.4g}"


def percent(error):
    """A relative error to two digits, in percent, without an exponent, or as a multiple."""
    if error < .995:
        return f"{100 * error:.2g} %"
    return f"{100 * error:.0f} %" if error < 10 else f"{error:.2g} times"


def table(columns, title=""):
    """A table that sorts itself when a heading is clicked."""
    units = [escape(column.unit) if column.unit != "1" else "" for column in columns]
    heads = "".join(
        f"<th scope=col{' class=text' if column.is_text else ''}>{escape(column.name)}" +
        (f"<small>{unit or '&nbsp;'}</small>" if any(units) else "") + "</th>"
        for column, unit in zip(columns, units))
    rows = "".join("<tr>" + "".join(column.cell(row) for column in columns) + "</tr>\n"
                   for row in range(len(columns[0].shown)))
    title = f"<p class=soft>{escape(title)}</p>\n" if title else ""
    return (f"{title}<div class=scroll><table><thead><tr>{heads}</tr></thead>\n"
            f"<tbody>\n{rows}</tbody></table></div>\n")


def picture(path, caption, kind="plot", width=None):
    """A picture within the page; if a width is given, shrunk to that many pixels and compressed."""
    content, mime = path.read_bytes(), "png"
    if width:
        from PIL import Image  # comes with matplotlib
        image = Image.open(path).convert("RGB")
        image.thumbnail((width, width))
        file = io.BytesIO()
        image.save(file, "JPEG", quality=85)
        content, mime = file.getvalue(), "jpeg"
    code = base64.b64encode(content).decode("ascii")
    return (f'<figure class={kind}><img alt="{escape(caption)}" '
            f'src="data:image/{mime};base64,{code}">'
            f"<figcaption>{escape(caption)}</figcaption></figure>\n")


def download(name, text):
    """A link that saves a text as a file."""
    code = base64.b64encode(text.encode("utf-8")).decode("ascii")
    return f'<a download="{escape(name)}" href="data:text/plain;base64,{code}">{escape(name)}</a>'


def folded(title, content):
    """Content that is shown on demand, and not printed."""
    return f"<details><summary>{escape(title)}</summary>\n{content}</details>\n"


def page(title, sections):
    """The whole page from (heading, content) pairs; pairs without content are left out."""
    body = "".join((f"<section><h2>{escape(heading)}</h2>\n" if heading else "<section>") +
                   f"{content}</section>\n" for heading, content in sections if content)
    return ("<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8>\n"
            f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n'
            '<meta name=viewport content="width=device-width, initial-scale=1">\n'
            f"<title>{escape(title)}</title>\n<style>{STYLE}</style></head>\n<body>\n"
            f"{body}<script>{SCRIPT}</script>\n</body></html>\n")
