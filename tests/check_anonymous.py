"""Names in anonymous namespaces are unique within a library: a build with few files (PALP_FEWER_FILES) compiles several
sources as one, in an order that changes with every new source.

Used by CTest: python3 tests/check_anonymous.py ROOT
"""

import collections
import pathlib
import re
import sys

# Folders of one library each: add one when it is clean. Hdf5Server.cpp is a program of its own.
LIBRARIES = ("model", "io", "app/study", "app/scenes", "app/cli")
TYPE = re.compile(r"^(?:struct|class|enum class|enum) (\w+)(?= *[={:;]|$)", re.M)
CONSTANT = re.compile(r"^(?:inline )?(?:static )?(?:constexpr|const) [^;={(]*?\b(k[A-Z]\w*)\b(?=\[?[^;]*[;={])", re.M)
FUNCTION = re.compile(r"^(?=\S)(?:\[\[\w+\]\] )?(?:constexpr |inline |static )*[\w:<>,*& ]+?[ *&](\w+)\(((?:[^()]|\([^()]*\))*)\)[^;{]*\{",
                      re.M)


def anonymous_parts(text):
    """The texts of the anonymous namespaces of a source, without what is in braces."""
    for part in re.findall(r"^namespace \{\n(.*?)^\} // namespace$", text, flags=re.M | re.S):
        yield re.sub(r"//[^\n]*|^#.*$", "", part, flags=re.M)


def types_of(parameters):
    """The types of a list of parameters, without names and defaults."""
    types = []
    for parameter in re.split(r",(?![^<(]*[>)])", re.sub(r"\s+", " ", parameters)):
        words = parameter.split("=")[0].strip()
        types.append(re.sub(r"(?<=[ *&>])\w+$", "", words).strip() if " " in words else words)
    return ",".join(types)


def names_in(text):
    for part in anonymous_parts(text):
        yield from TYPE.findall(part)
        yield from CONSTANT.findall(part)
        yield from (f"{name}({types_of(parameters)})" for name, parameters in FUNCTION.findall(part))


def main(root):
    problems = []
    for library in LIBRARIES:
        sources = collections.defaultdict(set)
        for file in sorted(set((root / library).rglob("*.cpp")) - {root / "io/samples/Hdf5Server.cpp"}):
            for name in names_in(file.read_text()):
                sources[name].add(str(file.relative_to(root)))
        problems += [f"{name}: in the anonymous namespaces of {', '.join(sorted(files))}"
                     for name, files in sorted(sources.items()) if len(files) > 1]
    print("\n".join(problems) if problems else "names in anonymous namespaces are unique within each library")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
