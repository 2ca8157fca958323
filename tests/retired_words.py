"""Words that pages, help and (by folder) messages and comments no longer use, each with its replacement. A spelling list:
it holds only words that were retired on purpose, so that they do not return.
"""

import re

# Pattern -> replacement. Patterns ignore case and match in prose only: code, links' targets and names are left out.
RETIRED = {
    r"beside": "next to, together with, compared with, at the same time as",
    r"allowed (is|are)": "expected",
    r"(stands?|stood)(?!-)": "is, appears, is stored",
    r"(?<!there\s)(is|are) no(?! (longer|more|better|force|unbiased))": "is not a, has no",
    r"at once": "immediately, together",
    r"(goes?|went|gone|going) on": "continues",
    r"that (is|are|was|were) there": "existing",
    r"by (itself|themselves)": "automatically, alone",
    r"in words": "as text",
    r"the way (back|forward|forth)": "backward sweep, forward sweep, inverse",
    r"from nothing": "from scratch",
    r"without a word": "silently",
    r"(takes?|taken|took|taking) away": "remove",
    r"(be|was|were|is) had back": "restored",
    r"(gives?|gave|given) back": "release, return",
    r"knowing nothing": "predicting the mean",
    r"saying the mean": "predicting the mean",
    r"so many": "N",
    r"more than can be": "too many",
    r"(?<!as\sa\s)whole(?! numbers?\b)": "complete, entire",
    r"(samples?|reports?|frames?|rows?|forces?|bytes|points|elements|steps|iterations|files?|lines?|lists?|readings?|solves?"
    r"|columns?|heights?|sides|weights|numbers) an? (second|minute|hour|area|row|design|frame|sample|reading|load|step"
    r"|wire|touch|position|page|line|element|electrode)(?! of)": "per second, per area, per row",
    r"told|tells": "reports, prescribes",
    r"says|said|saying": "reports, states, prints",
    r"asked": "requested",
    r"feels|felt": "is affected by",
    r"knows": "has, contains",
    r"(wants|wanted again)": "needs",
    r"settled": "converged",
    r"lets? go": "release",
    r"sideways|aside": "tangential",
    r"twins?": "comparison mesh, model view",
    r"warp": "deformation scale",
    r"uneven": "heterogeneous",
    r"rivals?": "baselines",
    r"what is left": "remainder, residual",
    r"force and place|places? of (a|an|the|each) (touch|touches|electrodes?)": "position",
    r"kept design": "reference design",
    r"designs that there were": "earlier designs",
    r"(by|in) a way|current's way": "displacement control, current paths",
    r"as the mode says|as suits it": "default of this mode, automatic",
    r"hold views|drifts on": "freeze display, still drifting",
    r"what is asked|for who draws": "scope, for the circuit designer",
    r"nothing is lost": "(a promise that the code cannot keep)",
}
# A phrase may be broken over two lines.
SPACE = r"(?:[ \t]+|[ \t]*\n[ \t]*)"
PATTERNS = {re.compile(r"(?<![\w-])(?:" + pattern.replace(" ", SPACE) + r")(?!\w)", re.I): better
            for pattern, better in RETIRED.items()}
# A line that must use one of the words has this mark, with the reason next to it.
EXCEPTION = "words: ok"


def blank(found):
    return re.sub(r"[^\n]", " ", found.group())


def markdown_prose(text):
    """The page with code, link targets and tags blanked out, its lines kept."""
    text = re.sub(r"^```.*?^```", blank, text, flags=re.M | re.S)
    text = re.sub(r"(?<=\n\n)(?: {4}.*\n)+", blank, text)
    text = re.sub(r"`[^`\n]*`", blank, text)
    return re.sub(r"\]\([^)\s]*\)", blank, text)


def html_prose(text):
    """The page without head, comments, code and tags, its lines kept; a bar where a paragraph or cell ends."""
    text = re.sub(r"<head>.*?</head>|<!--.*?-->|<(code|pre|tt)\b.*?</\1>", blank, text, flags=re.S)
    text = re.sub(r"</?(a|b|i|em|strong|span|sub|sup)\b[^>]*>", blank, text)
    return re.sub(r"<[^>]*>", lambda tag: "|" + blank(tag)[1:], text)


def source_prose(text, comments=True):
    """String literals of a C++ source, and its comments where they count, its lines kept. Literals without a blank are
    names and keys, and so are includes."""
    text = re.sub(r"^#include.*$", "", text, flags=re.M)
    lines = [""] * (text.count("\n") + 1)
    for part in re.finditer(r'//[^\n]*|"(?:[^"\\\n]|\\.)*"', text):
        prose = part.group().strip('/"')
        if comments if part.group()[0] == "/" else " " in prose:
            lines[text.count("\n", 0, part.start())] += prose + ("" if part.group()[0] == "/" else " ")
    return "\n".join(lines)


def retired_in(path, text, comments=True):
    """(line number, word, replacement) of each retired word in a page or source, in the order of the lines."""
    pages = {".md": markdown_prose, ".html": html_prose, ".svg": html_prose}
    prose = pages[path.suffix](text) if path.suffix in pages else source_prose(text, comments)
    allowed = {number for number, line in enumerate(text.splitlines(), 1) if EXCEPTION in line}
    found = [(prose.count("\n", 0, at.start()) + 1, " ".join(at.group().split()), better)
             for pattern, better in PATTERNS.items() for at in pattern.finditer(prose)]
    return sorted(hit for hit in found if hit[0] not in allowed)
