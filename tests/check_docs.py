"""The pages for people against the repository: every relative link and its anchor, every path of the repository that
stands in backticks, every `palp COMMAND` and every --option of one must be there; README names every command, and
environment.md every variable that is read; comments of the sources cite nothing outside the repository. No page uses a
retired word (tests/retired_words.py).

Used by CTest: python3 tests/check_docs.py ROOT
"""

import pathlib
import re
import sys
import tempfile

from retired_words import retired_in

SOURCES = ("model", "nn", "solver", "io", "app", "tests")
# Folders that are checked for retired words too, and whether their comments are ("app/cli": False for its strings
# alone): add one when it is clean.
PLAIN_FOLDERS = {"app/cli": True, "app/gui": True, "app/scenes": True, "app/study": True, "io": True, "model": True,
                 "nn": True, "resources/help": True, "solver": True}
# The folders and files at the root that a path in backticks may begin with.
TOP = ("app", "io", "model", "nn", "resources", "solver", "tests", ".ci")
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
QUOTED = re.compile(r"`([^`\n]+)`")
# Pages of design notes that are no part of the repository.
ELSEWHERE = re.compile(r"\b(PHYSICS|DESIGN|GUI|BOARD|CLI|CONVENTIONS|ROOMS|BODY|FIELD|TOUCH)\.md\b|PHYSICS of the paper")


def without_code(text):
    """The page without its indented and fenced code, in which brackets are no links."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    return re.sub(r"^ {4}.*$", "", text, flags=re.M)


def anchors(page):
    """Anchors of a page's headings as GitHub makes them."""
    heads = re.findall(r"^#+ (.*)$", page.read_text(), flags=re.M)
    return {re.sub(r"[^\w\- ]", "", head.strip().lower()).replace(" ", "-") for head in heads}


def link_problems(page):
    for target in LINK.findall(without_code(page.read_text())):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if not file.exists():
            yield f"link to {target}: no such file"
        elif anchor and file.suffix == ".md" and anchor not in anchors(file):
            yield f"link to {target}: no such heading"


def linked_pages(page):
    """The pages that a page links to."""
    links = LINK.findall(without_code(page.read_text()))
    return {(page.parent / link.partition("#")[0]).resolve() for link in links}


def index_of(root, page):
    """The page that has to link a page: index.md of its folder, or the README."""
    index = page.parent / "index.md"
    return index if page != index and index.exists() else root / "README.md"


def exists(root, name):
    """A file or folder, a pattern as solver/*.h, or a header and source named together without an ending."""
    if any(c in name for c in "*?"):
        return any(root.glob(name))
    return (root / name).exists() or any((root / (name + end)).exists() for end in (".h", ".cpp"))


def path_problems(root, page):
    for quoted in QUOTED.findall(page.read_text()):
        word = quoted.split()[0].removeprefix("./").rstrip("/,")
        looks_like_path = "/" in word and word.split("/")[0] in TOP and re.fullmatch(r"[\w./*-]+", word)
        if looks_like_path and not exists(root, word):
            yield f"`{quoted}`: {word} is not in the repository"


def commands_of(root):
    """The commands of palp and the options that the sources declare anywhere."""
    texts = [p.read_text() for p in (root / "app/cli").rglob("*.cpp")]
    commands = {name for text in texts for name in re.findall(r'cli\.command\(\s*"([a-z-]+)"', text)}
    options = {option for text in texts for line in re.findall(r'\b(?:add_)?(?:option|flag)\(\s*"([^"]+)"', text)
               for option in line.split(",")}
    table = (root / "app/study/decoding/TrainOptionTable.cpp").read_text()
    options |= {f"--{name}" for name in re.findall(r'\.name = "([a-z-]+)"', table)}
    return commands, options | {"--help", "--version"}


def command_problems(page, commands, options):
    text = page.read_text()
    lines = QUOTED.findall(text) + re.findall(r"^ {4}(.+)$", text, flags=re.M)
    for line in lines:
        found = re.match(r"(?:\$ )?(?:\./app/run |build/bin/)?palp ([a-z][a-z-]*)(?= |$)(.*)", line)
        if not found:
            continue
        if found.group(1) not in commands:
            yield f"`{line}`: palp has no command {found.group(1)}"
        for option in re.findall(r"(?<=\s)(--[a-z-]+)", found.group(2).split(" # ")[0]):
            if option not in options:
                yield f"`{line}`: palp has no option {option}"


def variable_problems(root):
    """Environment variables of ours that a program, a test or a script reads, against their page."""
    page = (root / "resources/docs/environment.md").read_text()
    read = re.compile(r'(?:getenv|qEnvironmentVariable\w*)\("(PALP_[A-Z_]+)"|\$\{(PALP_[A-Z_]+):-|= "(PALP_[A-Z_]+)"')
    files = [p for folder in SOURCES for p in (root / folder).rglob("*") if p.is_file() and p.suffix in (".cpp", ".h", ".sh", "", ".py")]
    found = {next(filter(None, groups)) for p in files for groups in read.findall(p.read_text(errors="replace"))}
    for name in sorted(found):
        if f"`{name}`" not in page:
            yield f"resources/docs/environment.md: {name} is read, but not described"
    for name in sorted(set(re.findall(r"^\| `(PALP_[A-Z_]+)`", page, flags=re.M)) - found):
        yield f"resources/docs/environment.md: {name} is described, but nothing reads it"


def machines_folder(root):
    """Matches the folder that the repository lies in, where that names a machine: nothing of ours may know it."""
    folder = root.parent
    named = len(folder.parts) > 1 and folder != pathlib.Path(tempfile.gettempdir())
    return re.compile(rf"(?<![\w/]){re.escape(str(folder))}/" if named else r"(?!)")


def comment_problems(root):
    machine = machines_folder(root)
    for folder in SOURCES:
        for end in ("*.h", "*.cpp", "*.py", "*.txt", "*.sh"):
            for source in (root / folder).rglob(end):
                if source.name == "check_docs.py":
                    continue
                for number, line in enumerate(source.read_text().splitlines(), 1):
                    if ELSEWHERE.search(line) or machine.search(line):
                        yield f"{source.relative_to(root)}:{number}: cites what is outside the repository"
                    for cited in re.findall(r"resources/docs/[\w./-]*\w", line):
                        if not (root / cited).exists():
                            yield f"{source.relative_to(root)}:{number}: cites {cited}, which is not there"


def word_problems(root, pages):
    """Retired words in the pages, the texts of reports and PLAIN_FOLDERS."""
    figures = sorted((root / "resources/docs").rglob("*.svg"))
    files = [(page, True) for page in [*pages, *figures, *sorted((root / ".github").rglob("*.md")),
                                  *sorted((root / "resources/reports").rglob("*.md"))]]
    files += [(file, comments) for folder, comments in PLAIN_FOLDERS.items()
              for file in sorted((root / folder).rglob("*")) if file.suffix in (".h", ".cpp", ".html")]
    for file, comments in files:
        for line, word, better in retired_in(file, file.read_text(), comments):
            yield f"{file.relative_to(root)}:{line}: retired word '{word}': use {better}"


def main(root):
    pages = [root / "README.md", *sorted((root / "resources/docs").rglob("*.md")),
             *sorted((root / "resources/board").glob("*.md"))]
    commands, options = commands_of(root)
    problems = []
    if len(pages) < 3 or not commands:
        problems.append("no pages or no commands were found: is this the root of the repository?")
    for page in pages:
        where = page.relative_to(root)
        for found in (link_problems(page), path_problems(root, page), command_problems(page, commands, options)):
            problems += [f"{where}: {problem}" for problem in found]
        if page != index_of(root, page) and page not in linked_pages(index_of(root, page)):
            problems.append(f"{where}: {index_of(root, page).relative_to(root)} does not link it")
    problems += [f"README.md: palp {name} is not named" for name in sorted(commands)
                 if f"`palp {name}`" not in pages[0].read_text()]
    problems += [*variable_problems(root), *comment_problems(root), *word_problems(root, pages)]
    print("\n".join(problems) if problems else f"{len(pages)} pages agree with the repository")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
