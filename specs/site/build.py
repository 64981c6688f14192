#!/usr/bin/env python3
"""Renders everything that people read of stormproof as a site that needs no network.

Lays out the Markdown pages as they lie in the repository, so that links between them hold; what
else they link to becomes a page as well (a source file with its text, a folder with its list).
Adds what the program prints of itself: drawings of machines and compositions, the museum, the
reproduction of the paper. In a block `console` the output shown is what the program prints now,
and where a page leaves lines out ("...") so does the site; tests/cli/pages_test.cpp compares them.

usage: build.py --source DIR --program FILE --output DIR [--engine DIR --node FILE] [--only-links]
  --engine, --node  with the page that simulates: its engine, as the target `play` builds it, and what packs it
  --only-links  lay the pages out and look whether their links lead somewhere; no MkDocs, no Doxygen
Exit code: 0, or 1 if a page links to nothing or a program fails.
"""
import argparse
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path
from urllib.parse import urlencode

LINK = re.compile(r"(\[[^\]\n]*\])\(([^)\s]+)\)")
PAGES = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md", "specs/performance.md"]
FOLDERS = ["specs/guide", "specs/findings", "specs/captures"]
LANGUAGES = {".hpp": "cpp", ".cpp": "cpp", ".yaml": "yaml", ".yml": "yaml", ".xml": "xml", ".json": "json",
             ".txt": "text", ".cmake": "cmake", ".sh": "sh", ".py": "python"}
MERMAID = "mermaid@9.4.3"
GUIDE = {"Use it": ["checking", "bounds", "cannot-start", "profiles", "diff", "comparing-discovery", "tuning", "sensitivity", "fuzzing",
                    "sweeping", "play", "reports", "output"],
         "Beside reality": ["doctor", "captures", "conforming", "validating", "coverage", "reproducing", "live"]}


class Site:
    def __init__(self, source: Path, program: Path, docs: Path, has_play: bool):
        self.source, self.program, self.docs, self.has_play = source, program, docs, has_play
        self.staged: set[str] = set()
        self.missing: list[str] = []

    def run(self, *arguments: str) -> str:
        """What the program prints; it may judge (exit codes 0, 1, 3, 4), but not fail."""
        done = subprocess.run([self.program, *arguments], cwd=self.source, capture_output=True, text=True)
        if done.returncode not in (0, 1, 3, 4):
            sys.exit(f"stormproof {' '.join(arguments)}: exit code {done.returncode}\n{done.stderr}")
        return done.stdout

    def write(self, name: str, text: str) -> None:
        target = self.docs / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")

    def page(self, name: str) -> None:
        """Stages the Markdown page, and whatever it links to."""
        if name in self.staged:
            return
        self.staged.add(name)
        text = self.with_links((self.source / name).read_text(encoding="utf-8"), Path(name))
        self.write(name, self.with_play(text) if self.has_play and name.startswith("specs/findings/") else text)

    def with_play(self, text: str) -> str:
        """A finding, with links under its title to what its commands simulate and to the exhibits that they show."""
        links = {}
        for line in re.findall(r"(?:^    |`)(?:\./)?stormproof ((?:[^`\n]*\\\n)*[^`\n]*)", text, re.M):
            words = shlex.split(re.sub(r" --trace \S+", "", line), comments=True)
            if words[0] == "museum":
                links.setdefault(f"museum {words[1]}", urlencode({"exhibit": words[1]}))
            elif words[0] == "simulate" and all(option == "--set" for option in words[2::2]):
                links.setdefault(re.sub(r"([][])", r"\\\1", " ".join(words)), urlencode({"yaml": self.scenario(words)}))
        if not links:
            return text
        heading, _, rest = text.partition("\n")
        shown = [f"[{words}](../../play.html#{address})" for words, address in links.items()]
        return f"{heading}\n\nTo play with: {' · '.join(shown)}\n{rest}"

    def scenario(self, simulate: list[str]) -> str:
        """What the command simulates, as the head of its trace has it."""
        with tempfile.TemporaryDirectory() as folder:
            trace = Path(folder) / "trace"
            os.mkfifo(trace)
            run = subprocess.Popen([self.program, *simulate, "--trace", trace], cwd=self.source, stdout=subprocess.DEVNULL)
            with trace.open(encoding="utf-8") as lines:
                head = json.loads(lines.readline())
                run.kill()
            run.wait()
        lines = []
        for key, value in head["scenario"].items():
            inner = value.items() if isinstance(value, dict) else []
            lines.append(f"{key}:" if inner else f"{key}: {json.dumps(value)}")
            lines += [f"  {name}: {json.dumps(one)}" for name, one in inner]
        return "\n".join(lines) + "\n"

    def with_links(self, text: str, page: Path) -> str:
        def link(match: re.Match) -> str:
            target, _, anchor = match[2].partition("#")
            if not target or "://" in target or target.startswith("mailto:"):
                return match[0]
            there = Path(os.path.normpath(page.parent / target))
            staged = self.target(there)
            if staged is None:
                self.missing.append(f"{page}: {match[2]}")
                return match[0]
            where = os.path.relpath(staged, page.parent or ".")
            return f"{match[1]}({where}{'#' + anchor if anchor and staged.endswith('.md') else ''})"

        fenced, lines = False, []
        for line in text.split("\n"):
            fenced ^= line.startswith("```")
            lines.append(line if fenced or line.startswith("    ") else LINK.sub(link, line))
        return "\n".join(lines)

    def target(self, there: Path) -> str | None:
        """The staged page of a path of the repository, staged now if it was not."""
        path = self.source / there
        if path.is_dir():
            name = f"{there}/files.md"
            if name not in self.staged:
                self.staged.add(name)
                rows = [self.row(entry) for entry in sorted(path.iterdir()) if not entry.name.startswith(".")]
                self.write(name, f"# {there}\n\n" + "\n".join(rows) + "\n")
            return name
        if not path.is_file():
            return None
        if path.suffix == ".md":
            self.page(str(there))
            return str(there)
        if path.suffix in (".svg", ".png", ".html"):
            (self.docs / there).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, self.docs / there)
            return str(there)
        name = f"{there}.md"
        if name not in self.staged:
            self.staged.add(name)
            is_scenario = self.has_play and there.parent == Path("specs/scenarios")
            play = f"[Simulate it in a page](../../play.html#scenario={there.stem})\n\n" if is_scenario else ""
            self.write(name, f"# {there}\n\n{play}````{LANGUAGES.get(path.suffix, 'text')}\n"
                             f"{path.read_text(encoding='utf-8')}\n````\n")
        return name

    def row(self, entry: Path) -> str:
        """One of a folder: pages are linked, of sources the first comment says what they are."""
        if entry.suffix == ".md":
            self.page(str(entry.relative_to(self.source)))
            return f"* [{entry.name}]({entry.name})"
        if entry.suffix not in LANGUAGES:
            return f"* {entry.name}"
        first = entry.read_text(encoding="utf-8").lstrip().split("\n", 1)[0]
        is_comment = first.startswith(("//", "#")) and not first.startswith(("#!", "#pragma", "#include"))
        about = first.lstrip("/# ").strip() if is_comment else ""
        return f"* {entry.name}" + (f": {about}" if about else "")

    def drawings(self) -> None:
        text = "# Machines\n\nEach is drawn from the table that runs.\n"
        for name in self.run("list", "machines", "--names").split():
            self.write(f"drawings/{name}.svg", self.run("draw", name, "--format", "svg"))
            text += f"\n## {name}\n\n![{name}]({name}.svg)\n"
        self.write("drawings/machines.md", text)
        text = "# What connects the machines\n\nAll effects of each implementation's rules.\n"
        for profile in ("paper", "fastdds-2.6.11", "fastdds-server-2.6.11", "cyclonedds-0.10"):
            self.write(f"drawings/{profile}.svg", self.run("draw", "composition", "--dds", profile, "--format", "svg"))
            text += (f"\n## {profile}\n\n[the drawing alone]({profile}.svg)\n\n<div class=\"drawing\">"
                     f"<img alt=\"composition of {profile}\" src=\"{profile}.svg\"></div>\n\n??? note \"as text\"\n\n    ```\n")
            text += "".join(f"    {line}\n" for line in self.run("draw", "composition", "--dds", profile).splitlines())
            text += "    ```\n"
        self.write("drawings/compositions.md", text)

    def play(self, engine: Path, node: Path) -> None:
        """The page that simulates, and its storm on the start page."""
        subprocess.run([node, self.source / "specs/site/play/pack.mjs", "--source", self.source, "--engine", engine,
                        "--output", self.docs, "--guide", "./"], check=True)
        start = (self.docs / "README.md").read_text(encoding="utf-8")
        head, title, rest = start.partition("# stormproof\n")
        self.write("README.md", f'{head}{title}\n<div id="storm"></div>\n<script src="storm.js"></script>\n{rest}')

    def catalogues(self) -> None:
        self.write("properties.md", self.run("properties", "--format", "markdown"))
        text = "# Verbs\n\nWhat `stormproof help VERB` says.\n"
        for verb in re.findall(r"^  ([a-z][a-z-]*) ", self.run("--help"), re.M):
            text += f"\n## {verb}\n\n```text\n{self.run('help', verb)}```\n"
        self.write("verbs.md", text)


def title(page: Path) -> str:
    return page.read_text(encoding="utf-8").split("\n", 1)[0].lstrip("# ").replace("`", "").strip()


def mermaid(docs: Path) -> None:
    """The library that draws state diagrams, from npm; without it they stay text."""
    (docs / "mermaid.min.js").write_text("")
    try:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["npm", "pack", "--silent", MERMAID], cwd=folder, check=True, capture_output=True, timeout=120)
            with tarfile.open(next(Path(folder).glob("*.tgz"))) as package:
                text = package.extractfile("package/dist/mermaid.min.js").read()
            (docs / "mermaid.min.js").write_bytes(text)
    except (OSError, subprocess.SubprocessError) as why:
        print(f"site: state diagrams stay text, {MERMAID} cannot be had from npm: {why}", file=sys.stderr)


def navigation(source: Path, extras: list[tuple[str, str]]) -> str:
    """What follows the part of `nav` that mkdocs.yml has."""
    guide = {page.stem for page in (source / "specs/guide").glob("*.md")}
    first = set(re.findall(r"specs/guide/([a-z-]+)\.md", (source / "specs/site/mkdocs.yml").read_text()))
    listed = {name for names in GUIDE.values() for name in names}
    lines = []
    for section, names in GUIDE.items():
        lines.append(f"  - {section}:")
        more = sorted(guide - first - listed) if section == "Use it" else []
        lines += [f"      - {title(source / 'specs/guide' / (name + '.md'))!r}: specs/guide/{name}.md"
                  for name in [*names, *more] if name in guide]
    lines.append("  - Findings:")
    lines += [f"      - {title(page)!r}: specs/findings/{page.name}" for page in sorted((source / "specs/findings").glob("*.md"))]
    lines.append("  - Reference:")
    lines += [f"      - {name}: {where}" for name, where in extras]
    return "\n".join(lines) + "\n"


def doxygen(source: Path, output: Path) -> None:
    settings = {"PROJECT_NAME": "stormproof", "INPUT": f"{source}/fsm {source}/model", "RECURSIVE": "YES",
                "FILE_PATTERNS": "*.hpp", "OUTPUT_DIRECTORY": output, "HTML_OUTPUT": "api", "GENERATE_LATEX": "NO",
                "EXTRACT_ALL": "YES", "QUIET": "YES", "WARNINGS": "NO", "JAVADOC_AUTOBRIEF": "YES", "HAVE_DOT": "NO",
                "STRIP_FROM_PATH": source, "SEARCHENGINE": "YES", "BUILTIN_STL_SUPPORT": "YES"}
    text = "\n".join(f"{key} = {value}" for key, value in settings.items())
    subprocess.run(["doxygen", "-"], input=text, text=True, check=True, stderr=subprocess.DEVNULL)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    for name in ("source", "program", "output"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    parser.add_argument("--engine", type=Path)
    parser.add_argument("--node", type=Path)
    parser.add_argument("--only-links", action="store_true")
    given = parser.parse_args()
    absent = [] if given.only_links else [name for name in ("mkdocs", "doxygen") if not shutil.which(name)]
    if absent:
        sys.exit(f"site: {' and '.join(absent)} {'is' if len(absent) == 1 else 'are'} not installed; "
                 "on Debian: apt-get install mkdocs mkdocs-material doxygen")
    source, output = given.source.resolve(), given.output.resolve()
    work = output.with_name(output.name + ".work")
    shutil.rmtree(work, ignore_errors=True)
    docs = work / "docs"
    docs.mkdir(parents=True)

    site = Site(source, given.program.resolve(), docs, given.engine is not None)
    for page in PAGES:
        site.page(page)
    for folder in FOLDERS:
        for page in sorted((source / folder).glob("*.md")):
            site.page(str(page.relative_to(source)))
    if site.missing:
        print("links to nothing:\n  " + "\n  ".join(site.missing), file=sys.stderr)
        return 1
    if given.only_links:
        return 0
    site.drawings()
    site.catalogues()
    for name in ("site.css", "diagrams.js"):
        shutil.copyfile(source / "specs/site" / name, docs / name)
    mermaid(docs)
    if given.engine:
        site.play(given.engine.resolve(), given.node)
    site.write("paper.html", site.run("reproduce", "paper", "--format", "html"))
    museum = site.run("museum", "--format", "html")
    if given.engine:
        links = " ".join(f'<a href="play.html#exhibit={one.stem}">{one.stem}</a>' for one in sorted((source / "specs/museum").glob("*.yaml")))
        museum = museum.replace("</h1>", f"</h1>\n<p>To play with: {links}</p>", 1)
    site.write("museum.html", museum)
    extras = [("The museum", "museum.html"), ("The paper, reproduced", "paper.html"), ("Verbs", "verbs.md"), ("Properties", "properties.md"),
              ("Performance", "specs/performance.md"), ("Architecture", "ARCHITECTURE.md"),
              ("Contributing", "CONTRIBUTING.md"), ("Changes", "CHANGELOG.md")]
    if given.engine:
        extras.insert(0, ("A storm to play with", "play.html"))
    if shutil.which("doxygen"):
        doxygen(source, docs)
        extras.append(("API of fsm and model", "api/index.html"))

    settings = (source / "specs/site/mkdocs.yml").read_text(encoding="utf-8")
    (work / "mkdocs.yml").write_text(settings + navigation(source, extras), encoding="utf-8")
    subprocess.run(["mkdocs", "build", "--quiet", "--strict", "--config-file", work / "mkdocs.yml",
                    "--site-dir", output], check=True)
    print(f"site: {output}/index.html; with search: python3 -m http.server --directory {output}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
