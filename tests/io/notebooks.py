"""Runs the examples of resources/docs/notebooks.md on files of palp, and lets palp read what h5py and NumPy write: other
layouts, and broken twins, each of which must be refused in one line and leave nothing.

Used by CTest: python3 notebooks.py PALP PAGE
"""

import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import h5py
import numpy as np

PALP, PAGE = map(os.path.abspath, sys.argv[1:])


def palp(*words):
    return subprocess.run([PALP, *map(str, words)], capture_output=True, text=True, timeout=60)


def made(*words):
    result = palp(*words)
    assert result.returncode == 0, result.stderr
    return result


def refused(file, *parts):
    before = sorted(p.name for p in pathlib.Path(".").iterdir())
    result = palp("merge", file, "-o", "never.csv")
    assert result.returncode == 2, (file, parts, result)
    assert result.stderr.count("\n") == 1 and result.stderr.startswith("palp merge: "), result.stderr
    for part in (str(file), *parts):
        assert part in result.stderr, (part, result.stderr)
    assert sorted(p.name for p in pathlib.Path(".").iterdir()) == before


def examples():
    """Each block runs in names of its own, which are handed back."""
    blocks = re.findall(r"^```python\n(.*?)^```", pathlib.Path(PAGE).read_text(), flags=re.M | re.S)
    assert len(blocks) == 3
    for block in blocks:
        names = {}
        exec(compile(block, PAGE, "exec"), names)
        yield names


def csv_table():
    lines = [line for line in open("samples.csv") if not line.startswith("#")]
    rows = list(csv.reader(lines))
    return rows[0], np.array(rows[1:], dtype=float)


def check_examples():
    names, table = csv_table()
    column = {name: table[:, i] for i, name in enumerate(names)}
    by_h5py, by_numpy, by_pandas = examples()
    assert by_h5py["seed"] == 3 and by_h5py["unit"] == "ohm" and isinstance(by_h5py["design"], str)
    assert (by_h5py["forces_N"][:, 2] == column["fz_N"]).all()
    assert (by_h5py["row_4_ohm"][:, 7] == column["R_r4_c7_ohm"]).all()
    assert (by_h5py["lift_mm"][:, 2] == column["u_r4_e2_z_mm"]).all()
    assert (by_numpy["resistances_ohm"].reshape(len(table), -1) == table[:, -300:]).all()
    assert list(by_pandas["frame"].columns) == names and (by_pandas["frame"].to_numpy() == table).all()
    assert list(by_pandas["same"].columns) == names


def copy_h5(name, change=None, **how):
    """The file once more by h5py; `change` is made to the new one."""
    with h5py.File("samples.h5") as old, h5py.File(name, "w") as new:
        for key, value in old.attrs.items():
            new.attrs[key] = value
        for key in old:
            if old[key].dtype.kind == "S":
                new.create_dataset(key, data=old[key].asstr()[:].astype(object), dtype=h5py.string_dtype())
            else:
                new.create_dataset(key, data=old[key][:], **how)
        if change:
            change(new)
    return name


def replace(key, data=None, **how):
    def change(new):
        del new[key]
        if data is not None or how:
            new.create_dataset(key, data=data, **how)
    return change


def check_other_layouts():
    """Files that h5py and NumPy wrote in their own way give the same bytes of CSV."""
    copy_h5("contiguous.h5")
    copy_h5("packed.h5", compression="gzip", compression_opts=9, chunks=True, fletcher32=True)
    arrays = dict(np.load("samples.npz"))
    np.savez_compressed("packed.npz", **arrays)
    arrays["area"] = arrays["area"].astype(np.int64)
    np.savez("plain.npz", **arrays)
    for file in ("contiguous.h5", "packed.h5", "packed.npz", "plain.npz"):
        made("merge", file, "-o", "back.csv", "--force")
        assert open("back.csv").read() == open("samples.csv").read(), file


def check_broken_h5():
    with h5py.File("samples.h5") as file:
        forces, area = file["forces_N"][:], file["area"][:]
    refused(copy_h5("a.h5", lambda new: new.attrs.__delitem__("design")), "design")
    refused(copy_h5("b.h5", lambda new: new.attrs.__setitem__("salt", 1)), "unknown key", "salt")
    refused(copy_h5("c.h5", lambda new: new.attrs.__setitem__("seed", [1, 2])), "seed")
    refused(copy_h5("d.h5", lambda new: new.attrs.__setitem__("row_wires", 11)), "columns")
    refused(copy_h5("e.h5", replace("forces_N")), "no dataset forces_N")
    refused(copy_h5("f.h5", replace("forces_N", forces[:-1])), "forces_N", "29 x 3", "30 x 3")
    refused(copy_h5("g.h5", replace("area", area + 0.5)), "area", "whole")
    refused(copy_h5("h.h5", replace("forces_N", shape=(10**9, 3), chunks=(100, 3), dtype="f8")), "forces_N", "chunks")
    refused(copy_h5("i.h5", replace("area", shape=(10**12,), chunks=(100,), dtype="i4")), "area")
    refused(copy_h5("j.h5", replace("area", np.array([b"x"] * 30))), "area", "does not contain whole numbers")
    forces[7, 1] = np.inf
    refused(copy_h5("k.h5", replace("forces_N", forces)), "sample 7", "inf")
    refused(copy_h5("l.h5", replace("columns")), "columns")


def check_broken_npz():
    arrays = dict(np.load("samples.npz"))

    def twin(name, drop=(), **other):
        np.savez(name, **{k: v for k, v in {**arrays, **other}.items() if k not in drop})
        return name
    refused(twin("a.npz", drop=["seed"]), "seed")
    refused(twin("b.npz", drop=["resistances_ohm"]), "resistances_ohm", "is missing")
    refused(twin("c.npz", forces_N=arrays["forces_N"][:-1]), "forces_N", "29 x 3", "30 x 3")
    refused(twin("d.npz", forces_N=np.asfortranarray(arrays["forces_N"])), "forces_N", "Fortran")
    refused(twin("e.npz", forces_N=arrays["forces_N"].astype(">f8")), "forces_N", "big-endian")
    refused(twin("f.npz", forces_N=arrays["forces_N"].astype(complex)), "forces_N", "c16")
    refused(twin("g.npz", area=arrays["area"] + 0.5), "sample")
    refused(twin("h.npz", design="d\u00fc"), "design", "ASCII")
    pathlib.Path("i.npz").write_bytes(b"PK\x05\x06" + bytes(18))
    refused("i.npz", "zip")
    pathlib.Path("j.npz").write_bytes(b"PK\x03\x04nothing")
    refused("j.npz", "zip")


def main():
    request = ["sample", "paper", "--per-area", "5", "--seed", "3", "--mapped", "4x4x2"]
    for name in ("samples.csv", "samples.h5", "samples.npz"):
        made(*request, "-o", name)
    for step in (check_examples, check_other_layouts, check_broken_h5, check_broken_npz):
        step()


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    main()
    os.chdir("/")
