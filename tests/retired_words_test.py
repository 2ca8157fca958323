"""tests/retired_words.py: finds a planted word in prose, and nothing in code or in links.

Used by CTest: python3 retired_words_test.py (ROOT, as the other checks take it, is not needed)
"""

import pathlib
import sys
import unittest

from retired_words import PATTERNS, retired_in


def words(name, text, comments=True):
    return [(line, word) for line, word, _ in retired_in(pathlib.Path(name), text, comments)]


class RetiredWords(unittest.TestCase):
    def test_are_found_in_prose(self):
        self.assertEqual(words("a.md", "# A\n\nIt stands beside the mesh.\nIt is no\nmesh.\n"),
                         [(3, "beside"), (3, "stands"), (4, "is no")])
        self.assertEqual(words("a.html", "<h1>A</h1>\n<p>It goes\n  on, two samples a second.</p>"),
                         [(2, "goes on"), (3, "samples a second")])

    def test_are_found_in_comments_and_strings(self):
        source = '#include "beside.h"\nint beside; // it goes\n// on\nlog("beside", "It was told at "\n    "once, then.");\n'
        self.assertEqual(words("a.h", source), [(2, "goes on"), (4, "at once"), (4, "told")])
        self.assertEqual(words("a.h", source, comments=False), [(4, "at once"), (4, "told")])

    def test_are_not_found_in_code_names_and_plain_english(self):
        plain = """The array `beside`, a link [here](beside.md).

    palp beside

```sh
echo at once
```
There is no force. Three whole numbers. A stand-alone program. The mesh is a row of elements.
"""
        self.assertEqual(words("a.md", plain), [])
        self.assertEqual(words("a.html", "<!-- beside --><a href='beside.html'>next</a>"), [])
        self.assertEqual(words("a.html", "<h2>Samples</h2>\n<p>A sample <code>stands</code></p>"), [])

    def test_are_allowed_in_a_marked_line(self):
        self.assertEqual(words("a.md", "beside <!-- words: ok, a quotation -->\n"), [])

    def test_have_a_replacement_each(self):
        self.assertTrue(all(PATTERNS.values()))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
