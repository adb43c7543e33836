# SPDX-License-Identifier: GPL-2.0-or-later
"""How Sphinx makes the manual of README.md and doc/*.md: cmake --build build --target manual.

The pages are Markdown that reads well as it is. What HTML has beyond that (navigation, anchors
of parameters and columns, pages of scenes) is made by sphinx_manual.py.
"""
import os
import pathlib
import sys
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE))

project = "strait"
author = "the authors of strait"
release = os.environ.get("STRAIT_VERSION", "")

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx_manual"]
root_doc = "doc/index"
include_patterns = ["README.md", "doc/*.md", "doc/*.rst"]
exclude_patterns = ["build*", "output*", ".git", "source", "include", "tests", "examples"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4  # the anchors that GitHub gives headings

html_theme = "furo"
html_title = f"strait {release}".strip()
# Formulas need a font made for them, which phones lack; it comes with fonts-dejavu-extra.
html_static_path = ["static"] + [str(font) for font in pathlib.Path("/usr/share/fonts").glob(
    "truetype/dejavu/DejaVuMathTeXGyre.ttf")]
html_css_files = ["manual.css"]
html_math_renderer = "mathml"
html_copy_source = html_show_sourcelink = html_show_copyright = False
html_theme_options = {"top_of_page_button": None}
highlight_language = "none"

# The package as it was built or, without its compiled part, with the types of that part.
package = pathlib.Path(os.environ.get("STRAIT_PYTHON_PACKAGE", "."))
if list(package.glob("strait/_core*.so")):
    sys.path.insert(0, str(package))
else:
    sys.path.insert(0, str(HERE.parent / "python"))
    loader = SourceFileLoader("strait._core", str(HERE.parent / "python/strait/_core.pyi"))
    types_alone = module_from_spec(spec_from_loader(loader.name, loader))
    loader.exec_module(types_alone)
    types_alone.__version__ = release
    sys.modules[loader.name] = types_alone
default_role = "py:obj"
autodoc_default_options = {"members": True, "undoc-members": True}
autodoc_member_order = "bysource"
autodoc_typehints = "none"
