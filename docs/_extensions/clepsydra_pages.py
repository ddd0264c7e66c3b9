"""Pages that are files outside of docs/, and parts of pages that are made from files of the repository, so that they
cannot differ from them."""

import os
import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import yaml
from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList
from sphinx.project import Project

REPOSITORY = Path(__file__).resolve().parents[2]


class GeneratedText(Directive):
    """A directive that stands for Markdown text made from the file or folder that is its argument."""

    required_arguments = 1
    has_content = False

    def text(self, path: Path) -> str:
        """The Markdown text in the place of the directive."""
        raise NotImplementedError

    def run(self) -> list:
        path = REPOSITORY / self.arguments[0]
        if not path.exists():
            raise self.error(f"no such file or folder: {path}")
        self.state.document.settings.env.note_dependency(str(path))
        container = nodes.container()
        self.state.nested_parse(StringList(self.text(path).splitlines(), source=str(path)), 0, container)
        return container.children


class EffectTable(GeneratedText):
    """The effects of a library (identification/effects/*.yaml) as a table."""

    def text(self, path: Path) -> str:
        library = yaml.safe_load(path.read_text(encoding="utf-8"))
        rows = ["| effect | meaning | what it sets | how to measure it by itself |", "|---|---|---|---|"]
        for effect in library["effects"]:
            changes = effect.get("set") or effect["chain"]
            text = ", ".join(
                f"`{name}` {'to' if effect.get('switch') and 'set' in effect else '='} `{value}`"
                for name, value in changes.items()
            )
            if not effect.get("switch"):
                text += f", $a$ from {effect.get('amplitude', [0, 1])[0]} to {effect.get('amplitude', [0, 1])[1]}"
            where = "".join(f"; {tag}: {listed(values)}" for tag, values in effect.get("actsIn", {}).items())
            rows.append(
                f"| `{effect['name']}` | {effect.get('meaning', '')}{where} | {text} | {effect.get('hint', '')} |"
            )
        return "\n".join(rows)


class Headers(GeneratedText):
    """The classes and functions that Doxygen has read in the headers of a folder (not of the folders in it).

    Each folder is a project of its own for Breathe, which searches all of a project for each class.
    """

    def text(self, path: Path) -> str:
        project = project_of(self.arguments[0])
        xml = self.state.document.settings.env.config.breathe_projects.get(project)
        if xml is None:
            raise self.error(f"Doxygen has not read the headers of {self.arguments[0]}")
        files = files_read_by_doxygen(Path(xml))
        headers = [str(header.relative_to(REPOSITORY)) for header in sorted(path.glob("*.h"))]
        return "\n\n".join(f":::{{rubric}} `{name}`\n:::\n\n{directives_of(files[name], project)}" for name in headers)


def project_of(folder: str) -> str:
    return folder.replace("/", ".")


def directives_of(members: list[tuple[str, str]], project: str) -> str:
    return "\n\n".join(
        f":::{{{directive}}} {member}\n:project: {project}\n"
        + (":sections: briefdescription detaileddescription\n" if directive == "doxygenfile" else "")
        + ":::"
        for directive, member in members
    )


def files_read_by_doxygen(xml: Path) -> dict[str, list[tuple[str, str]]]:
    """Path of a header -> directives of Breathe, with their arguments, for what it declares."""

    def text_of(element: ElementTree.Element, tag: str) -> str:
        return "".join(element.find(tag).itertext()).strip() if element.find(tag) is not None else ""  # type: ignore

    def place_of(element: ElementTree.Element) -> str:
        location = element.find("location")
        assert location is not None
        return location.get("declfile") or location.get("file") or ""

    compounds = []
    for compound in ElementTree.parse(xml / "index.xml").getroot().iter("compound"):
        if compound.get("kind") in ("file", "class", "struct", "namespace"):
            definition = ElementTree.parse(xml / f"{compound.get('refid')}.xml").getroot().find("compounddef")
            assert definition is not None
            compounds.append(definition)
    found: dict[str, list[tuple[str, str]]] = {}
    for compound in compounds:
        if compound.get("kind") == "file":
            documented = text_of(compound, "briefdescription") + text_of(compound, "detaileddescription")
            found[place_of(compound)] = [("doxygenfile", place_of(compound))] if documented else []
    classes = {
        text_of(compound, "compoundname") for compound in compounds if compound.get("kind") in ("class", "struct")
    }
    for compound in compounds:
        kind, name = compound.get("kind"), text_of(compound, "compoundname")
        # what lies within a class is shown with it; specialisations with their template
        if kind in ("class", "struct") and name.rpartition("::")[0] not in classes and "<" not in name:
            found[place_of(compound)].append((f"doxygen{kind}", name))
        if kind == "namespace" and "@" not in name:
            for member in compound.iter("memberdef"):
                arguments = text_of(member, "argsstring") if member.get("kind") == "function" else ""
                # Doxygen takes an object with texts as arguments for a function
                if member.get("kind") in ("function", "enum", "typedef") and '"' not in arguments:
                    directive = f"doxygen{member.get('kind')}"
                    found[place_of(member)].append((directive, f"{name}::{text_of(member, 'name')}{arguments}"))
    return found


# Pages of the site that are files of the repository outside of docs/.
FILES = {
    "changelog": "CHANGELOG.md",
    "developers/contributing": "CONTRIBUTING.md",
    "validation/blindTests": "cases/studies/blindHopper/README.md",
    "validation/paperHopper": "cases/paper/README.md",
} | {
    f"tutorials/{page.parent.name}": str(page.relative_to(REPOSITORY))
    for page in sorted(REPOSITORY.glob("cases/tutorials/*/README.md"))
}

# Where the site has what a file outside of docs/ stands for.
PAGES = {file: page for page, file in FILES.items()} | {
    "README.md": "index",
    "cases/README.md": "tutorials/index",
    "cases/validation/README.md": "validation/index",
    "cmake/README.md": "howTo/install",
    "coupling/README.md": "reference/index",
    "identification/README.md": "howTo/ownMeasurement",
    "meshes/README.md": "howTo/meshes",
}


class ProjectWithFiles(Project):
    """The pages of docs/ and those of FILES, which stand in docs/ for whatever refers to them."""

    def discover(self, *patterns: Any, **named: Any) -> set[str]:
        self.docnames = super().discover(*patterns, **named) | set(FILES)
        return self.docnames

    def doc2path(self, docname: str, basedir: bool = True) -> str:
        if basedir and docname in FILES:
            # Sphinx requires that the path of a page begins with that of docs/
            return os.path.join(self.srcdir, os.path.relpath(REPOSITORY / FILES[docname], self.srcdir))
        return super().doc2path(docname, basedir)


def add_files(app: Any) -> None:
    app.project = app.env.project = ProjectWithFiles(app.srcdir, app.config.source_suffix)


def prepare_text(app: Any, docname: str, source: list) -> None:
    """Links of a page as they are in the site. In a page of docs/, a line `% repository page: FILE, table of NAME` is
    replaced by what stands in that file between `<!-- table of NAME ...-->` and `<!-- end of the table -->`."""

    def table_of(match: Any) -> str:
        path = REPOSITORY / match["file"]
        app.env.dependencies[docname].add(str(path))
        text = path.read_text(encoding="utf-8")
        table = re.search(rf"<!-- {match['table']}.*?-->\n(.*?)<!-- end of the table -->", text, re.DOTALL)
        return with_links_from(table[1] if table else "", match["file"], docname)

    def link_to_file(match: Any) -> str:
        path = os.path.normpath(os.path.join("docs", os.path.dirname(docname), match["target"]))
        return f"]({relative(PAGES[path], docname)}" if path in PAGES else match[0]

    if docname in FILES:
        source[0] = with_links_from(source[0], FILES[docname], docname)
        return
    text = re.sub(r"\]\((?P<target>[^)#\s]+\.md)", link_to_file, source[0])
    source[0] = re.sub(
        r"^% repository page: (?P<file>\S+), (?P<table>table of .+)$", table_of, text, flags=re.MULTILINE
    )


def relative(page: str, docname: str) -> str:
    return os.path.relpath(page, os.path.dirname(docname) or ".") + ".md"


def with_links_from(text: str, file: str, docname: str) -> str:
    """A file's text with its links as from a page: to pages of the site or, where there is none, the path alone."""

    def link(match: Any) -> str:
        picture, label, target, anchor = match.groups()
        if "://" in target or not target:
            return match[0]
        path = os.path.normpath(os.path.join(os.path.dirname(file), target))
        page = re.sub(r"^docs/|\.md$", "", path) if path.startswith("docs/") else PAGES.get(path)
        if page and not picture:
            # of another README the site has the text under headings of its own
            kept = anchor if path.startswith("docs/") or page in FILES else ""
            return f"[{label}]({relative(page, docname)}{kept or ''})"
        if picture:
            return f"![{label}]({os.path.relpath(path, os.path.join('docs', os.path.dirname(docname)))})"
        return f"{label} (`{path}`)"

    return re.sub(r"(!?)\[([^\]]*)\]\(([^)#\s]*)(#[^)\s]*)?\)", link, text)


def listed(values: Any) -> str:
    return ", ".join(values) if isinstance(values, list) else str(values)


def setup(app: Any) -> dict[str, Any]:
    """Called by Sphinx."""
    app.add_directive("effects", EffectTable)
    app.add_directive("headers", Headers)
    app.connect("builder-inited", add_files)
    app.connect("source-read", prepare_text)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
