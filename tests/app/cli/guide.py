"""Walks resources/docs/guide.md as a new user would: each ```sh block is run by bash in one empty folder, in order, and each
line of the ```text block after it must stand in what the block printed: the same words, numbers within 2 %. A line may be
the beginning of a printed one.

Used by CTest: python3 guide.py PALP PAGE
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

PALP, PAGE = map(os.path.abspath, sys.argv[1:])
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
MOST_OFF = 0.02  # other processors and libraries round otherwise, and networks amplify it


def same(shown, printed):
    """The words of both alike, their numbers near each other."""
    if [w.strip() for w in NUMBER.split(shown)] != [w.strip() for w in NUMBER.split(printed)]:
        return False
    pairs = zip(map(float, NUMBER.findall(shown)), map(float, NUMBER.findall(printed)))
    return all(abs(a - b) <= MOST_OFF * abs(a) + 1e-12 for a, b in pairs)


def begins(shown, printed):
    """Some beginning of the printed line is what is shown."""
    return any(same(shown, printed[:end]) for end in range(len(shown) // 2, len(printed) + 1))


def printed_by(commands):
    result = subprocess.run(["bash", "-euo", "pipefail", "-c", commands], capture_output=True, text=True, timeout=280)
    assert result.returncode == 0, f"{commands}\nended with {result.returncode}:\n{result.stdout}{result.stderr}"
    sentences = re.sub(r"(?<=\.) (?=[A-Z])", "\n", result.stdout)
    return result.stdout.splitlines() + sentences.splitlines()


def main():
    os.environ["PATH"] = os.path.dirname(PALP) + ":" + os.environ["PATH"]
    blocks = re.findall(r"^```(sh|text)\n(.*?)^```", pathlib.Path(PAGE).read_text(), flags=re.M | re.S)
    assert len(blocks) >= 12, "the guide has lost its blocks"
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        lines = []
        for kind, text in blocks:
            if kind == "sh":
                lines = printed_by(text)
                continue
            for shown in text.splitlines():
                assert any(begins(shown, line) for line in lines), \
                    f"the guide shows\n  {shown}\nprinted was\n  " + "\n  ".join(lines)
        made = {p.name for p in pathlib.Path(".").iterdir()}
        assert {"sensor.json", "touch.png", "noise", "train.csv", "network.json", "forces.csv", "calibrated.json"} <= made
        os.chdir("/")
    assert not begins("right areas: 90 %", "right areas: 100 %")  # the comparison can fail
    print("guide: ok")


main()
