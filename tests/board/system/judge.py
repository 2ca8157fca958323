"""Judges the console of the system test: judge.py CONSOLE REPORTS."""

import json
import re
import sys

results = {}
for line in open(sys.argv[1], errors="replace"):
    if match := re.search(r"RESULT (\w+) status=(\d+) (\{.*\})", line):
        results[match[1]] = (int(match[2]), json.loads(match[3]))
reports = int(sys.argv[2])
problems = []


def check(scenario, what, holds):
    status, totals = results.get(scenario, (None, None))
    if totals is None:
        problems.append(f"{scenario}: no result")
    elif not holds(totals):
        problems.append(f"{scenario}: {what}: {json.dumps(totals)}")


for name in ("rate1000", "rate8000"):
    check(name, "every report, none lost, bad, twice or in another order", lambda t: t["reports"] >= reports - 60
          and t["lost_reports"] == t["bad_reports"] == t["duplicate_reports"] == t["restarts"] == 0
          and t["incomplete_frames"] <= 1)  # the first frame may be joined in its middle
check("malformed", "bad reports are counted", lambda t: t["bad_reports"] > 10 and t["restarts"] == 0)
check("overrun", "what the kernel's queue dropped is counted", lambda t: t["lost_reports"] > 500 and t["bad_reports"] == 0)
check("replug", "the board is found again", lambda t: t["connections"] == 2 and t["lost_reports"] == 0)
print("\n".join(problems) if problems else f"{len(results)} scenarios passed")
sys.exit(1 if problems or len(results) != 5 else 0)
