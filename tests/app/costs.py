"""What each scene of the window and each command costs, as CSV: stages of the chain, pictures, seconds, memory.

A scene may run only the stages that it shows, each once a step, and nothing while it is hidden or left alone; a command
may not fail. Exit status 1 where one did, with the fault in the last column.

python3 tests/app/costs.py PALP [--mapped NxNxN] [--per-area N]    the full measure takes two minutes
Used by CTest on a coarse mesh.
"""

import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

STAGES = ("mesh", "factorise", "solve")
HEADS = ("part", "what", "event", "mesh_runs", "factorise_runs", "solve_runs", "pictures", "drawn_unseen", "seconds",
         "cpu_s", "held_MB", "most_MB", "fault")
LIMIT_S = 240


def run(arguments, folder, **variables):
    """(output, error message or "", seconds, CPU seconds, largest memory in MB) of a program run to its end."""
    start = time.monotonic()
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as errors:
        child = subprocess.Popen(arguments, cwd=folder, env={**os.environ, **variables}, stdout=out, stderr=errors)
        alarm = start + LIMIT_S
        while True:
            pid, status, used = os.wait4(child.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() > alarm:
                child.kill()
            time.sleep(0.005)
        child.returncode = os.waitstatus_to_exitcode(status)  # or it would be waited for again
        out.seek(0)
        errors.seek(0)
        lines = errors.read().decode().strip().splitlines() or [""]
        failed = f"status {child.returncode}: {lines[-1]}" if child.returncode else ""
        return (out.read().decode(), failed, time.monotonic() - start, used.ru_utime + used.ru_stime,
                used.ru_maxrss / 1024)


def fault_of(step):
    """What a step of the window did that it should not have done; "" for nothing."""
    again = step["event"] in ("in turn again", "left alone") or step["event"].startswith("hidden")
    for stage in STAGES:
        most = 1 if step["shows_mesh" if stage == "mesh" else "shows_solution"] and not again else 0
        if step[stage] > most:
            return f"runs of {stage}: got {step[stage]}, expected at most {most}"
    if step["hidden_pictures"]:
        return f"{step['hidden_pictures']} pictures drawn while hidden"
    return "" if step["complete"] else "never complete"


def window(palp, mesh, design, scene):
    """Rows of one run of the window, and the scenes that it has."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "sensor.json").write_text(design)
        chosen = ["--scene", scene] if scene else []
        output, failed, *_ = run([palp.parent / "palp-studio", "--costs", *chosen, *mesh, "sensor.json"], folder,
                                 QT_QPA_PLATFORM="offscreen", XDG_RUNTIME_DIR=folder, XDG_CONFIG_HOME=folder)
    if failed:
        return [("window", scene or "all scenes", "", *[""] * 9, failed)], []
    result = json.loads(output)
    return [("window", step["scene"], step["event"], *(step[stage] for stage in STAGES), step["pictures"],
             step["hidden_pictures"], step["seconds"], step["cpu_s"], step["held_MB"], step["peak_MB"], fault_of(step))
            for step in result["steps"]], result["scenes"]


def commands(mesh, per_area):
    """The commands in an order in which each finds the files that it reads."""
    sample = f"sample sensor.json --per-area {per_area} --seed"
    many = (1000 * per_area + 5) // 6  # of six areas, 100,000 where 100 an area are requested: words: ok
    meshed = lambda words: [*words.split()[:-2], *mesh, *words.split()[-2:]]
    return ["design --check sensor.json".split(),
            meshed("mesh sensor.json -o mesh.vtu"),
            meshed("solve sensor.json --load 0:0,0,-3 -o deformed.vtu"),
            meshed("render sensor.json --load 0:0,0,-3 -o picture.png"),
            meshed(f"{sample} 1 -o train.csv"),
            meshed(f"{sample} 2 --shard 1/2 -o part1.csv"),
            meshed(f"{sample} 2 --shard 2/2 -o part2.csv"),
            "merge part1.csv part2.csv -o test.csv".split(),
            meshed(f"sample sensor.json --surrogate --per-area {many} -o many.csv"),
            "train train.csv --input resistance --rows all --noise 1e-4 -o network.json".split(),
            "predict network.json test.csv --noise 1e-4 -o forces.csv".split(),
            "sweep train.csv --test test.csv".split(),
            "calibrate network.json test.csv -o better.json".split(),
            "listen --simulate --seconds 2".split(),
            meshed("reproduce all -o paper")]


def command(palp, words, folder):
    """The row of a command."""
    pictures = lambda: len(list(pathlib.Path(folder).rglob("*.png")))
    before = pictures()
    output, failed, seconds, cpu, memory = run([palp, *words, "--json"], folder)
    result = output if output.startswith("{\n") else (output.splitlines() or ["{}"])[-1]  # listen: an object per line
    stages = json.loads(result or "{}").get("stages", {})
    runs = [stages.get(stage, {}).get("runs", "") for stage in STAGES]
    return ("command", "palp " + " ".join(words), "", *runs, pictures() - before, "", round(seconds, 3), round(cpu, 3),
            "", round(memory), "" if "needs VTK" in failed else failed)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("palp", type=pathlib.Path)
    parser.add_argument("--mapped")
    parser.add_argument("--per-area", type=int, default=100)
    wish = parser.parse_args()
    palp = wish.palp.resolve()
    mesh = ["--mapped", wish.mapped] if wish.mapped else []
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        run([palp, "design", "-o", "sensor.json"], folder)
        design = (pathlib.Path(folder) / "sensor.json").read_text()
        rows += [command(palp, words, folder) for words in commands(mesh, wish.per_area)]
    if (palp.parent / "palp-studio").exists():
        in_turn, scenes = window(palp, mesh, design, "")
        rows += in_turn
        for scene in scenes:
            rows += window(palp, mesh, design, scene)[0]
        if not any(row[-1] for row in rows) and len(rows) != 15 + 2 * len(scenes) + 9 * len(scenes):
            rows.append(("window", "", "", *[""] * 9, f"{len(rows)} rows"))
    output = csv.writer(sys.stdout, lineterminator="\n")
    output.writerow(HEADS)
    output.writerows(rows)
    return 1 if any(row[-1] for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
