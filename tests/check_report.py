#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A whole seal from end to end, and its report.html as a browser shows it.

    check_report.py PROGRAM FOLDER

Runs a small seal, changes it without new patches, and checks the pages: all expected parts are
there, and nothing is loaded. Status 77 (a skipped test), after all that, where there is no Chromium
to click and print with.
"""
import csv
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

SCENE = """subsection Units
  set Length   = m
  set Pressure = Pa
  set Time     = s
end
subsection Surface
  set Size                     = 1e-4
  set Roll-off wavelength      = 2.5e-5
  set Short cut-off wavelength = 6.25e-6
  set RMS value                = 0.1
end
subsection Contact
  set Grid points       = 64
  set Effective modulus = 1e7
end
subsection Fluid
  set Viscosity       = 1e-3
  set Inlet pressure  = 1e4
  set Target accuracy = 0.1
end
subsection Load programme
  set Pressures = 3e4, 6e4, 1.2e5
end
subsection Realisations
  set Seeds = 1, 2, 3
end
subsection Seal
  set Enabled          = true
  set Circumference    = 1e-2
  set Contact width    = 4e-4
  set Pressure profile = hertz
  set Wanted leak rate = 0.1
end
subsection Output
  set Leak rate units = ml/h
  set Report          = true
end
"""
EXPECTED = ("whole seal: 4 × 100 patches", "Limits of the model", "Gap and flow", "Scene", "Time",
            "To repeat it", "Roll-off wavelength", "fluid-pressure")
# Clicks twice on the first heading of the table of realisations and reports its first column.
CLICK = """<script>
const head = [...document.querySelectorAll("th")].find(h => h.textContent === "realisation" ||
                                                            h.textContent.startsWith("realisation"));
const column = () => [...head.closest("table").tBodies[0].rows].map(r => r.cells[0].textContent);
head.click(); const up = column(); head.click(); const down = column();
document.title = "SORTED " + up.join(",") + " THEN " + down.join(",");
</script></body>"""


def fail(message):
    sys.exit(f"FAILED: {message}")


def run(*command):
    result = subprocess.run(command, text=True, capture_output=True, check=False, timeout=300)
    if result.returncode:
        fail(f"{' '.join(map(str, command))}\n{result.stdout}\n{result.stderr}")
    return result.stdout


def rows(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Links(HTMLParser):
    """Everything that a page refers to, and the tags that are still open at its end."""
    VOID = {"meta", "img", "br", "wbr", "link"}

    def __init__(self):
        super().__init__()
        self.targets, self.open = [], []

    def handle_starttag(self, tag, attrs):
        self.targets += [value for name, value in attrs if name in ("src", "href")]
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            fail(f"</{tag}> closes nothing")


def check_page(path):
    """Check that a page is well-formed and refers to nothing but itself; return its text."""
    text = path.read_text(encoding="utf-8")
    links = Links()
    links.feed(text)
    if links.open:
        fail(f"{path}: {links.open} are not closed")
    outside = [target[:80] for target in links.targets if not target.startswith("data:")]
    if outside or "url(" in text or "@import" in text:
        fail(f"{path} refers to {outside or 'something in its style'}")
    return text


def check_seal(program, scene, folder):
    """Check the leak rate of the seal against its patches, and again with a wider contact."""
    said = run(program, scene, "--output", folder)
    if "comes from" not in said:
        fail(f"nothing is said of what dominates: {said}")
    before = rows(folder / "seal.csv")
    loads = [float(row["pressure"]) for row in before]  # means whose profile the patches cover
    if len(loads) != 3 or loads[1] != 6e4 or not 3e4 < loads[0] < 6e4 < loads[2] < 1.2e5:
        fail(f"seal.csv has {before}")
    before = before[1:2]
    patches = []
    for k in range(1, 4):
        at_load = rows(folder / f"realisation-{k}" / "leakage.csv")[1]
        patches.append(float(at_load["leak_rate_ml_per_h"]) * 1e-2 / 4e-4)
    median = float(before[0]["leak_rate_median"])
    if not min(patches) < median < max(patches) or before[0]["unit"] != "ml/h":
        fail(f"{median} {before[0]['unit']} from {patches}")
    log_of_patch = folder / "realisation-1" / "log.txt"
    untouched = log_of_patch.stat().st_mtime_ns
    if "Seal/" in log_of_patch.read_text(encoding="utf-8"):
        fail("a patch is advised on the seal, which is on and excludes nothing")
    run(program, scene, "--output", folder, "--resume", "--set", "Seal/Contact width=8e-4")
    ratio = float(rows(folder / "seal.csv")[1]["leak_rate_median"]) / median
    if not 0.4 < ratio < 0.6:
        fail(f"twice the width leaks {ratio} times as much")
    if log_of_patch.stat().st_mtime_ns != untouched:
        fail("patches were computed again for another seal")
    run(program, scene, "--output", folder, "--resume")


def check_in_browser(browser, page, folder):
    """Check that tables sort, the console has no complaints, and few pages are printed."""
    options = [browser, "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
               f"--user-data-dir={folder / 'profile'}"]
    clicked = folder / "clicked.html"
    clicked.write_text(page.read_text(encoding="utf-8").replace("</body>", CLICK),
                       encoding="utf-8")
    shown = run(*options, "--dump-dom", clicked.as_uri())
    title = re.search("<title>(.*?)</title>", shown).group(1)
    if title != "SORTED 1,2,3 THEN 3,2,1":
        fail(f"the table sorts as '{title}'")
    result = subprocess.run([*options, "--enable-logging=stderr", "--v=0", "--dump-dom",
                             page.as_uri()], text=True, capture_output=True, check=False,
                            timeout=120)
    complaints = [line for line in result.stderr.splitlines() if "CONSOLE" in line]
    if complaints:
        fail("\n".join(complaints))
    pdf = folder / "report.pdf"
    run(*options, "--no-pdf-header-footer", f"--print-to-pdf={pdf}", page.as_uri())
    n_pages = len(re.findall(rb"/Type\s*/Page\b", pdf.read_bytes()))
    if not 1 <= n_pages <= 3:
        fail(f"it prints on {n_pages} pages")
    print(f"{browser}: sorts, and prints on {n_pages} pages")


def main():
    program, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    scene, results = folder / "seal.prm", folder / "results"
    scene.write_text(SCENE, encoding="utf-8")
    check_seal(program, scene, results)
    text = check_page(results / "report.html")
    missing = [words for words in EXPECTED if words not in text]
    if missing or text.count("<img") < 4:  # one of the seal, one of each patch
        fail(f"report.html lacks {missing}, and has {text.count('<img')} pictures")
    check_page(results / "realisation-2" / "report.html")
    browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser",
                                                   "google-chrome"))), None)
    if browser is None:
        print("No Chromium here: that the page sorts and prints was not tested.")
        return 77
    check_in_browser(browser, results / "report.html", folder)
    shutil.rmtree(folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
