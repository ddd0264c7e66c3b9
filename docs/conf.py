"""Sphinx builds the documentation site from the Markdown pages of this folder; see scripts/documentation."""

import os
import shutil
import sys
from pathlib import Path
from typing import Any

REPOSITORY = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(Path(__file__).resolve().parent / "_extensions"))

project = "Clepsydra"
author = "The Clepsydra authors"
project_copyright = author

extensions = ["myst_parser", "breathe", "sphinx.ext.mathjax", "clepsydra_pages"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["_extensions"]
nitpicky = True

# Indented blocks are what a reader types into a shell.
highlight_language = "sh"

myst_enable_extensions = ["amsmath", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 4
# `$` begins a formula only where no blank follows: "$ closures ..." is a prompt.
myst_dmath_allow_space = False

# scripts/documentation runs Doxygen first and says where its XML is: a folder for each folder of headers.
doxygen = Path(os.environ.get("CLEPSYDRA_DOXYGEN", str(REPOSITORY / "build/documentation/doxygen")))
breathe_projects = {folder.name: str(folder / "xml") for folder in sorted(doxygen.iterdir())}
breathe_default_members = ("members",)
breathe_show_include = False
cpp_id_attributes = ["alignas"]
# Types of OpenFOAM, Eigen and the standard library have no page here, nor have private types of our own.
nitpick_ignore_regex = [("cpp:.*", ".*")]

# What comments refer to may lie in headers that have no page; links between pages are "ref.myst".
suppress_warnings = ["ref.ref"]

html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["wide.css"]
html_title = "Clepsydra"
html_show_sourcelink = False
html_copy_source = False

# Debian's MathJax is copied into the site, so that it is read without a network: see copy_mathjax().
MATHJAX = Path("/usr/share/javascript/mathjax")
MATHJAX_PARTS = ["MathJax.js", "config/TeX-AMS_SVG.js", "extensions", "jax/element", "jax/input/TeX", "jax/output/SVG"]
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG"
mathjax2_config = {
    "messageStyle": "none",
    # MyST tells MathJax to leave the text of pages alone, but for these elements.
    "tex2jax": {"processClass": "tex2jax_process|mathjax_process|math"},
}
myst_update_mathjax = False


def copy_mathjax(app: Any, failure: Any) -> None:
    """Copies what MathJax needs to show formulas as SVG."""
    if failure or app.builder.name != "html":
        return
    for part in MATHJAX_PARTS:
        source, target = MATHJAX / part, Path(app.outdir) / "_static" / "mathjax" / part
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, target, dirs_exist_ok=True)
        else:
            shutil.copyfile(source, target)


def setup(app: Any) -> None:
    """Called by Sphinx."""
    app.connect("build-finished", copy_mathjax)
