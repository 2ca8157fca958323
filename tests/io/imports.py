"""palp import on the tables of a rig that NumPy and pandas write: the samples are those of the table, networks train on
them without a design, and each broken twin of table or map is refused in one line and leaves nothing.

Used by CTest: python3 imports.py PALP
"""

import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile

import h5py
import numpy as np
import pandas as pd

PALP = os.path.abspath(sys.argv[1])
ROWS, COLUMNS, SAMPLES = 3, 4, 300
MAP = {
    "palp_import": 1,
    "resistances": {"columns": "R{row}_{column}", "row_wires": ROWS, "column_wires": COLUMNS, "unit": "kohm"},
    "forces": {"columns": ["Fx", "Fy", "Fz"], "unit": "mN", "signs": [1, 1, -1]},
    "area": {"column": "pad", "count": 2, "first": 1},
    "time": {"column": "t", "unit": "ms"},
}


def palp(*words):
    return subprocess.run([PALP, *map(str, words)], capture_output=True, text=True, timeout=100)


def made(*words):
    result = palp(*words, "--json")
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


def refused(table, map_file, *parts):
    before = sorted(os.listdir("."))
    for output in ("never.csv", "never.h5"):
        result = palp("import", table, "--map", map_file, "-o", output)
        assert result.returncode == 2, (parts, result)
        assert result.stderr.count("\n") == 1 and result.stderr.startswith("palp import: "), result.stderr
        for part in parts:
            assert part in result.stderr, (part, result.stderr)
    assert sorted(os.listdir(".")) == before


def mapped(name="map.json", **changes):
    """The map with other keys; None takes one away. `resistances__unit` is a key within `resistances`."""
    changed = json.loads(json.dumps(MAP))
    for key, value in changes.items():
        inside = changed
        *outer, last = key.split("__")
        for step in outer:
            inside = inside[step]
        if value is None:
            del inside[last]
        else:
            inside[last] = value
    pathlib.Path(name).write_text(json.dumps(changed))
    return name


def measured(seed):
    """A linear rig: each R answers the force in its own way, and a little to the pad."""
    random = np.random.default_rng(seed)
    pad = random.integers(0, 2, SAMPLES)
    force_N = random.uniform([-1, -1, -6], [1, 1, 0], (SAMPLES, 3))
    answer = np.random.default_rng(1).normal(size=(3, ROWS, COLUMNS))
    ohm = 500 + 5 * np.einsum("nd,drc->nrc", force_N, answer) + pad[:, None, None]
    return pad, force_N, ohm


def frame_of(pad, force_N, ohm):
    frame = pd.DataFrame({"t": 10.0 * np.arange(SAMPLES), "comment": 0, "pad": pad + 1})
    for axis, (name, sign) in enumerate((("Fx", 1), ("Fy", 1), ("Fz", -1))):
        frame[name] = sign * 1000 * force_N[:, axis]
    for r in range(ROWS):
        for c in range(COLUMNS):
            frame[f"R{r}_{c}"] = ohm[:, r, c] / 1000
    return frame


def check_dead_reading():
    pad, force_N, ohm = measured(2)
    ohm[:, 1, 2] = 1e6
    frame_of(pad, force_N, ohm).to_csv("dead.csv", index=False)
    warnings = made("import", "dead.csv", "--map", mapped(), "-o", "dead.h5")["warnings"]
    assert any("R_r1_c2 (1e+06 ohm) has the same value in all 300 samples" in words for words in warnings), warnings


def check_numbers():
    pad, force_N, ohm = measured(2)
    frame_of(pad, force_N, ohm).to_csv("table.csv", index=False)
    result = made("import", "table.csv", "--map", mapped(), "-o", "samples.npz")
    assert result["samples"] == SAMPLES and result["unused_columns"] == 1
    samples = np.load("samples.npz")
    assert (samples["area"] == pad).all() and str(samples["design"]) == result["design"]
    np.testing.assert_allclose(samples["forces_N"], force_N, rtol=1e-14)
    np.testing.assert_allclose(samples["resistances_ohm"], ohm, rtol=1e-14)
    np.testing.assert_allclose(samples["time_s"], 0.01 * np.arange(SAMPLES), rtol=1e-14)
    assert samples["time_s"].shape == (SAMPLES,) and "places_mm" not in samples

    made("import", "table.csv", "--map", mapped(), "-o", "samples.h5")
    made("import", "table.csv", "--map", mapped(), "-o", "samples.csv")
    made("merge", "samples.h5", "-o", "back.csv")
    assert open("back.csv").read() == open("samples.csv").read()

    # The same as arrays; codes of a converter; a place in place of the area; another separator.
    np.savez("table.npz", F=force_N, R=(ohm - 100) / 0.25, xy=np.column_stack([10 + 10 * pad, 5 + 0 * pad]) / 10)
    arrays = {"time": None, "area": None, "forces": {"columns": ["F[0]", "F[1]", "F[2]"], "unit": "N"},
              "place": {"columns": ["xy[0]", "xy[1]"], "unit": "cm", "block_mm": [30, 30], "areas": [2, 1]},
              "resistances": {"columns": "R[{row},{column}]", "row_wires": ROWS, "column_wires": COLUMNS,
                              "unit": "code", "ohm_per_code": 0.25, "zero_ohm": 100}}
    made("import", "table.npz", "--map", mapped("arrays.json", **arrays), "-o", "arrays.npz")
    again = np.load("arrays.npz")
    assert (again["area"] == pad).all() and "time_s" not in again
    np.testing.assert_allclose(again["places_mm"], np.column_stack([10 + 10 * pad, 5 + 0 * pad]), rtol=1e-14)
    np.testing.assert_allclose(again["resistances_ohm"], ohm, rtol=1e-13)
    frame_of(pad, force_N, ohm).to_csv("german.csv", index=False, sep=";", lineterminator="\r\n")
    made("import", "german.csv", "--map", mapped("german.json", separator=";"), "-o", "german.npz")
    assert (np.load("german.npz")["forces_N"] == samples["forces_N"]).all()


def check_use():
    """Train, sweep and predict without a design, on another table of the same rig."""
    frame_of(*measured(3)).to_csv("test-table.csv", index=False)
    made("import", "test-table.csv", "--map", mapped(), "-o", "test.h5")
    options = ["--input", "resistance", "--rows", "all"]
    made("train", "samples.h5", *options, "--noise", "1e-4", "-o", "network.json")
    result = made("predict", "network.json", "test.h5")
    assert not result["warnings"], result["warnings"]
    assert max(result["error"]["mean_absolute_N"]) < 0.05, result["error"]
    rows = made("sweep", "samples.h5", "--test", "test.h5", *options, "--spreads", "3,10")["rows"]
    assert len(rows) == 2
    kept = made("train", "samples.h5", "--split", "time:0.7", "-o", "kept.json")["kept_back"]
    assert kept["samples"] == 90 and max(kept["error"]["mean_absolute_N"]) < 0.05, kept
    rows = made("sweep", "samples.h5", "--split", "time:0.7", "--spreads", "1,3")["rows"]
    assert [row["spread"] for row in rows] == [1, 3] and max(rows[1]["error"]["mean_absolute_N"]) < 0.05, rows
    result = palp("train", "samples.h5", "--input", "displacement", "-o", "never.json")
    assert result.returncode == 2 and result.stderr.count("\n") == 1, result


def check_places():
    """Networks of force and place learn from measured touches alone."""
    random = np.random.default_rng(4)
    force_N = random.uniform([-1, -1, -6], [1, 1, -1], (SAMPLES, 3))
    place_mm = random.uniform(2, 18, (SAMPLES, 2))
    x, y = np.meshgrid(np.linspace(2, 18, COLUMNS), np.linspace(2, 18, ROWS))
    near = np.exp(-((place_mm[:, 0, None, None] - x) ** 2 + (place_mm[:, 1, None, None] - y) ** 2) / 100)
    answer = np.random.default_rng(1).normal(size=(2, ROWS, COLUMNS))
    ohm = 500 + near * (10 * force_N[:, 2, None, None] + np.einsum("nd,drc->nrc", force_N[:, :2], answer))
    half = SAMPLES // 2
    for name, part in (("touched", slice(0, half)), ("tried", slice(half, None))):
        np.savez(name + "-table.npz", F=force_N[part], R=ohm[part], xy=place_mm[part], t=np.arange(half))
        mapped("touched.json", area=None, forces={"columns": ["F[0]", "F[1]", "F[2]"], "unit": "N"},
               time={"column": "t", "unit": "s"},
               place={"columns": ["xy[0]", "xy[1]"], "unit": "mm", "block_mm": [20, 20], "areas": [1, 1]},
               resistances={"columns": "R[{row},{column}]", "row_wires": ROWS, "column_wires": COLUMNS, "unit": "ohm"})
        for ending in ("csv", "h5", "npz"):
            made("import", name + "-table.npz", "--map", "touched.json", "-o", f"{name}.{ending}")
    head = next(line for line in open("touched.csv") if not line.startswith("#"))
    assert head.startswith("area,time_s,x_mm,y_mm,fx_N,"), head
    options = ["--input", "resistance", "--rows", "all", "--target", "force+place", "--noise", "1e-5"]
    for decoder, most_mm in (("rbf", 2), ("touch", 1)):
        networks = []
        for ending in ("csv", "h5", "npz"):
            made("train", f"touched.{ending}", *options, "--decoder", decoder, "-o", f"{decoder}-{ending}.json")
            networks.append(json.load(open(f"{decoder}-{ending}.json")))
            networks[-1]["fit"].pop("seconds")
        assert networks[0] == networks[1] == networks[2]
        result = made("predict", f"{decoder}-h5.json", "tried.h5")
        assert not result["warnings"], result["warnings"]
        assert max(result["place_error"]["rms_mm"]) < most_mm, (decoder, result["place_error"])
        off = np.array(result["place_mm"]) - place_mm[half:]
        np.testing.assert_allclose(np.sqrt((off**2).mean(axis=0)), result["place_error"]["rms_mm"], rtol=1e-6)
    result = palp("train", "samples.h5", *options, "-o", "never.json")
    assert result.returncode == 2 and "palp import" in result.stderr and result.stderr.count("\n") == 1, result


def twin(name, change):
    lines = open("table.csv").read().splitlines()
    change(lines)
    pathlib.Path(name).write_text("\n".join(lines) + "\n")
    return name


def set_field(line, column, value):
    def change(lines):
        fields = lines[line].split(",")
        fields[lines[0].split(",").index(column)] = value
        lines[line] = ",".join(fields)
    return change


def cut_line(line):
    def change(lines):
        lines[line] = lines[line].rsplit(",", 1)[0]
    return change


def check_broken_tables():
    good = mapped()
    refused(twin("a.csv", set_field(7, "Fx", "nan")), good, "a.csv, line 8", "Fx", "nan", "finite")
    refused(twin("b.csv", set_field(7, "R1_2", "1e400")), good, "line 8", "R1_2", "1e400")
    refused(twin("c.csv", set_field(7, "R1_2", "-0.5")), good, "line 8", "R1_2", "above 0")
    refused(twin("d.csv", set_field(7, "pad", "3")), good, "line 8", "area: got 2", "0 to 1")
    refused(twin("e.csv", set_field(7, "pad", "1.5")), good, "line 8", "area: got 0.5")
    refused(twin("f.csv", set_field(7, "t", "0")), good, "line 8", "time: got 0 s")
    refused("table.csv", mapped("runs.json", run="pad", area=None, time=None), "table.csv, line ", "sort the rows by run")
    refused(twin("g.csv", cut_line(200)), good, "line 201", "17 fields", "18")
    refused(twin("h.csv", lambda lines: lines.__delitem__(slice(1, None))), good, "no rows")
    refused(twin("i.csv", set_field(0, "Fy", "Fx")), good, '"Fx"', "twice")
    refused(twin("j.csv", set_field(0, "Fy", "Fq")), good, '"Fy"', "not in j.csv")
    refused("nowhere.csv", good, "nowhere.csv")
    refused(".", good, "folder")
    with open("sparse.csv", "w") as sparse:
        sparse.truncate(10 << 30)
    refused("sparse.csv", good, "sparse.csv, line 1", "zero byte")
    with open("sparse-tail.csv", "w") as sparse:
        sparse.write(open("table.csv").read())
        sparse.truncate(10 << 30)
    refused("sparse-tail.csv", good, "sparse-tail.csv, line 302", "zero byte")
    os.remove("sparse.csv")
    os.remove("sparse-tail.csv")
    np.savez("short.npz", F=np.zeros((5, 3)), R=np.ones((4, 12)))
    refused("short.npz", mapped("short.json", area=None, time=None,
                                forces={"columns": ["F[0]", "F[1]", "F[2]"], "unit": "N"},
                                resistances__columns=[f"R[{i}]" for i in range(12)]), "array R", "4 rows")
    np.savez("nan.npz", **{name: np.full(5, np.nan) for name in open("table.csv").readline().strip().split(",")})
    refused("nan.npz", good, "row 0", "expected a finite number")


def mat5(name, values):
    """A variable of a MAT file of version 5, as MATLAB's `save -v6` writes it."""
    values = np.atleast_2d(np.asarray(values, float))

    def element(kind, content):
        return struct.pack("<II", kind, len(content)) + content + bytes(-len(content) % 8)
    content = (element(6, struct.pack("<II", 6, 0)) + element(5, struct.pack("<ii", *values.shape)) +
               element(1, name.encode()) + element(9, values.tobytes("F")))
    return struct.pack("<II", 14, len(content)) + content


def check_files_of_others():
    """The same numbers as MAT 5, MAT 7.3, HDF5 in a group and NPZ with an array of another length."""
    random = np.random.default_rng(6)
    arrays = {"t": 0.1 * np.arange(50), "ch": random.uniform(1, 2, (50, 3)), "F": random.uniform(-5, 0, (50, 3))}
    with open("five.mat", "wb") as file:
        file.write(b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack("<H", 0x0100) + b"IM")
        for name, values in arrays.items():
            file.write(mat5(name, values))
    with h5py.File("seven.mat", "w", userblock_size=512) as file: # MATLAB's first index is HDF5's last
        for name, values in arrays.items():
            file[name] = np.atleast_2d(values if values.ndim == 2 else values[None, :]).T
    with open("seven.mat", "r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file".ljust(124) + struct.pack("<H", 0x0200) + b"IM")
    with h5py.File("group.h5", "w") as file:
        for name, values in arrays.items():
            file["run/" + name] = values
    np.savez("others.npz", **arrays, other=np.zeros(7))
    results = []
    for table, before in (("five.mat", ""), ("seven.mat", ""), ("others.npz", ""), ("group.h5", "run/")):
        pathlib.Path("others.json").write_text(json.dumps({
            "palp_import": 1, "signals": {"columns": [f"{before}ch[{i}]" for i in range(3)]},
            "forces": {"columns": [f"{before}F[{i}]" for i in range(3)], "unit": "N"},
            "time": {"column": before + "t", "unit": "s"}}))
        made("import", table, "--map", "others.json", "-o", "others-" + table + ".csv")
        results.append([line for line in open("others-" + table + ".csv") if not line.startswith("#")])
    assert all(result == results[0] for result in results) and len(results[0]) == 51
    for table in ("five.mat", "seven.mat"):
        pathlib.Path("cut.mat").write_bytes(pathlib.Path(table).read_bytes()[:1500])
        refused("cut.mat", "others.json", "cut.mat")


def check_broken_maps():
    for changes, parts in (
            ({"resistances__unit": None}, ("resistances", "unit")),
            ({"forces__unit": None}, ("forces", "unit")),
            ({"time__unit": None}, ("time", "unit")),
            ({"forces__unit": "pound"}, ("forces.unit", "pound", "mN")),
            ({"resistances__unit": "code"}, ("ohm_per_code",)),
            ({"resistances__columns": "R{row}"}, ("resistances.columns", "{column}")),
            ({"resistances__columns": ["R0_0"]}, ("12 names",)),
            ({"resistances__row_wires": 0}, ("resistances.row_wires", "0", "1 to 255")),
            ({"resistances__column_wires": 5}, ('"R0_4"', "not in table.csv")),
            ({"forces__columns": ["Fx", "Fy"]}, ("3 names",)),
            ({"forces__signs": [1, 1, 0]}, ("forces.signs",)),
            ({"salt": 1}, ("salt",)),
            ({"palp_import": 2}, ("palp_import", "2")),
            ({"place": {"columns": ["t", "t"], "unit": "mm", "block_mm": [1, 1], "areas": [1, 1]}}, ("not both",)),
            ({"separator": "x"}, ("separator",))):
        refused("table.csv", mapped("twin.json", **changes), "twin.json", *parts)
    pathlib.Path("twin.json").write_text("{")
    refused("table.csv", "twin.json", "twin.json")
    result = palp("import", "table.csv", "--map", mapped(), "--design", "paper", "-o", "never.csv")
    assert result.returncode == 2 and "3 row-wires; the design has 10" in result.stderr, result


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for step in (check_numbers, check_dead_reading, check_use, check_places, check_files_of_others, check_broken_tables,
                 check_broken_maps):
        step()
    os.chdir("/")
