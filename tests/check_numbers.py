"""One convention for numbers: fails where a source prints or reads a number through the locale of the process, where a
locale is set outside the one place, and where the window makes a number box or an application of Qt's own.

Used by CTest: python3 tests/check_numbers.py ROOT
"""

import pathlib
import re
import sys

FOLDERS = ["model", "nn", "solver", "io", "app"]
TEXT = "withDigits, withDecimals, withExponent and numberIn of model/base/NumberText.h"
# What is looked for in the code, comments and texts of strings apart; what to write instead; where it may stand.
RULES = [
    (r"\b(?:std::)?(?:strto(?:f|d|ld)|sto(?:f|d|ld)|atof|f?v?s?scanf)\s*\(", f"reads a number by the locale: use {TEXT}", set()),
    (r"\bsetlocale\s*\(|\blocale::global\s*\(|\.imbue\s*\(|\buselocale\s*\(|\bQLocale::setDefault\s*\(",
     "sets a locale: only the constructor of palp::Application does",
     {"app/gui/window/Application.cpp", "tests/app/gui/widgets/NumbersTest.cpp"}),
    (r"\bQLocale::system\s*\(", "follows the user's locale: QLocale() is the C locale with a decimal point", set()),
    (r"\bnew\s+Q(?:Double)?SpinBox\b|\bpublic\s+Q(?:Double)?SpinBox\b",
     "drops keys that it does not take: use NumberBox or WholeBox of app/gui/widgets/SpinBoxes.h", set()),
    (r"\bQ(?:Core|Gui)?Application\s+\w+\s*[({]\s*argc", "takes over the user's locale: use palp::Application", set()),
]
PRINTF = re.compile(r"\b(?:std::)?v?[fsd]?n?printf\s*\(")
FLOATING = re.compile(r"%[-+ #0]*(?:\d+|\*)?(?:\.(?:\d+|\*)?)?(?:l|L)?[aefgAEFG]")
STRING = re.compile(r'"(?:[^"\\\n]|\\.)*"')
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.S)
SHOWN = 90  # characters of a line in a message


def without_comments(source):
    """The source with comments as blanks: strings are skipped, so that "http://" begins none."""
    def blank(match):
        word = match.group()
        return word if word[0] == '"' else re.sub(r"[^\n]", " ", word)
    return re.sub(STRING.pattern + "|" + COMMENT.pattern, blank, source, flags=re.S)


def without_strings(code):
    return STRING.sub(lambda match: '"' + " " * (len(match.group()) - 2) + '"', code)


def arguments(code, start):
    """What stands between the bracket that ends at `start` and its partner."""
    depth, bare = 1, without_strings(code[start:start + 4000])
    for k, letter in enumerate(bare):
        depth += {"(": 1, ")": -1}.get(letter, 0)
        if depth == 0:
            return code[start:start + k]
    return code[start:]


def printed_by_locale(code):
    """Places of calls of the printf family that print a floating-point number, or whose format is no literal."""
    for call in PRINTF.finditer(without_strings(code)):
        words = arguments(code, call.end())
        formats = STRING.findall(words)
        if not formats or any(FLOATING.search(text.replace("%%", "")) for text in formats):
            yield call.start()


def problems_of(name, source):
    code = without_comments(source)
    bare = without_strings(code)
    found = [(match.start(), words) for pattern, words, allowed in RULES if name not in allowed
             for match in re.finditer(pattern, bare)]
    found += [(place, f"prints a number by the locale, or by a format that is not a literal: use {TEXT}")
              for place in printed_by_locale(code)]
    for place, words in sorted(found):
        line = code.count("\n", 0, place) + 1
        yield f"{name}:{line}: {words}: {source.splitlines()[line - 1].strip()[:SHOWN]}"


# What the rules must find and must leave, tried at each run.
BAD = ['x = std::strtod(text, nullptr);', 'std::snprintf(b, n, "%-8s %+.3f N", a, x);', 'printf("%5d%%, %g", n, x);', 'printf(format, x);',
       'fprintf(stderr, "a" "%.*e", 3, x);', 'setlocale(LC_ALL, "");', 'auto* box = new QSpinBox;', 'QApplication app(argc, argv);']
GOOD = ['// strtod(text)', 'say("strtod(x)");', 'printf("%d of %zu, 100 %% good", k, n);', 'tr("%1 g").arg(x);', 'printf("%s", text(x).c_str());',
        'class Tried : public NumberBox {};', 'open("http://a.b"); // printf("%g", x)']


def main(root):
    assert all(list(problems_of("x.cpp", code)) for code in BAD), [c for c in BAD if not list(problems_of("x.cpp", c))]
    assert not any(list(problems_of("x.cpp", code)) for code in GOOD), [c for c in GOOD if list(problems_of("x.cpp", c))]
    sources = sorted(p for f in FOLDERS for end in ("*.h", "*.cpp") for p in (root / f).rglob(end))
    sources += sorted((root / "tests/app/gui").rglob("*.cpp"))
    problems = [p for source in sources
                for p in problems_of(source.relative_to(root).as_posix(), source.read_text())]
    print("\n".join(problems) if problems else f"{len(sources)} files print and read numbers with a decimal point")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
