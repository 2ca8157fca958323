"""The layers and doors of Palp: fails on an include that a folder may not have, on an include of what is private to
another folder, on a package's header in more than one source, on a folder with too many sources at its root, and on a
call that hides a failure.

Used by CTest: python3 tests/check_layers.py ROOT
"""

import collections
import pathlib
import re
import sys

FOLDERS = ["model", "nn", "solver", "io", "app/study", "app/scenes", "app/cli", "app/gui"]
# Which of our own folders each may include.
OWN = {
    "model": {"model"},
    "nn": {"nn", "model/base"},
    "solver": {"solver", "model"},
    "io": {"io", "model", "nn"},
    "app/study": {"app/study", "model", "nn", "solver", "io"},
    "app/scenes": {"app/scenes", "app/study", "model", "nn", "solver", "io"},
    "app/cli": {"app/cli", "app/study", "app/scenes", "model", "nn", "solver", "io"},
    "app/gui": {"app/gui", "app/study", "app/scenes", "model", "nn", "solver", "io"},
}
# The headers that other folders may include (tests/ mirrors the tree and may include all of them).
DOORS = {
    "model": r"model/(base/)?\w+\.h",
    "solver": r"solver/\w+\.h",
    "nn": r"nn/((inversion|baselines|measured)/)?\w+\.h",
    "io": r"io/(board/)?\w+\.h",
}
BASE = r"model/base/\w+\.h"  # stands below everything: it may include itself alone
MOST_SOURCES = 30  # in one folder, its sub-folders apart
# Packages by their headers, and the folders that may include them.
PACKAGES = {
    r"Eigen/.*": set(FOLDERS),
    r"unsupported/Eigen/LevenbergMarquardt": {"app/study"},
    r"tetgen\.h": {"solver"},
    r"(suitesparse/)?cholmod\.h": {"solver"},
    r"hidapi(/hidapi)?\.h": {"io"},
    r"libudev\.h": {"io"},
    r"hdf5\.h|matio\.h|zlib\.h|libdeflate\.h|minizip/.*": {"io"},
    r"lo/lo\.h|zmq\.h|arpa/inet\.h|net(inet|db|/if)?(/in)?\.h|ifaddrs\.h": {"io"},
    r"gif_lib\.h": {"app/scenes"},
    r"nlohmann/.*": {"io", "app/study", "app/scenes", "app/cli", "app/gui"},
    r"CLI/.*": {"app/cli"},
    r"nlopt\.(h|hpp)": {"nn", "app/study"},
    r"(cblas|lapacke?|openblas.*)\.h": {"nn", "solver"},
    r"vtk.*\.h|GL/.*|EGL/.*": {"app/scenes", "app/gui"},
    r"Q[A-Z].*|Qt.*": {"app/gui"},
    r"sys/mman\.h": {"solver", "io"},  # huge pages
    r"sanitizer/tsan_interface\.h": {"app/gui"},
    r"sys/.*|unistd\.h|dlfcn\.h|link\.h|fcntl\.h|spawn\.h|poll\.h|pthread\.h|malloc\.h|linux/.*|termios\.h": {"io", "app/study", "app/scenes", "app/cli", "app/gui"},
}
ONE_SOURCE_ONLY = [r"tetgen\.h", r"hidapi(/hidapi)?\.h", r"(suitesparse/)?cholmod\.h", r"hdf5\.h", r"matio\.h", r"lo/lo\.h", r"zmq\.h", r"zlib\.h",
                   r"minizip/.*"]
# Calls that go on where they have failed, or throw when all is done; what to use instead; who may make them.
CALLS = [
    (r"\.(?:llt|ldlt)\(\)|\bL(?:L|DL)T<[^;]*> \w+[({](?!const )",
     "goes on where the matrix is not positive definite: use positiveFactor, semidefiniteFactor or solvePositive",
     {"model/base/PositiveSolve.h", "nn/linear/RidgeFit.cpp"}),  # the latter checks its result
    (r"\.dump\((?![^;]*error_handler)|->dump\((?![^;]*error_handler)",
     "throws where a text is not UTF-8, as a file's name may be: use jsonText",
     {"app/study/cluster/ClusterJob.cpp", "io/StrictJson.h"}),  # which asks whether it is; of what was parsed
    (r"\bQSaveFile\b|\bofstream\b|\bfopen\(|\bO_CREAT\b|\bWriteOnly\b",
     "may leave half a file in place of a whole one: use writeFile, AtomicFile or FilesTogether of io",
     {"io/AtomicFile.cpp", "app/study/live/recordings/RecordingTable.cpp",  # into an AtomicFile
      "io/SamplePartWriter.cpp", "io/samples/SampleWriter.h",  # .part
      "io/send/LineOutlet.cpp", "app/gui/window/LogFile.cpp",  # line by line
      "app/study/ChildProcess.cpp",  # of a scratch folder
      "app/study/reports/ProcessMemory.cpp",  # /proc
      "app/gui/widgets/Png.cpp", "app/gui/views/StripChartMouse.cpp"}),  # bytes in memory
]
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)


def folder_of(path):
    return next(f for f in sorted(FOLDERS, key=len, reverse=True) if path.startswith(f + "/"))


def main(root):
    problems = []
    holders = {pattern: set() for pattern in ONE_SOURCE_ONLY}
    sources = [p for f in FOLDERS for end in ("*.h", "*.cpp") for p in (root / f).rglob(end)]
    tests = {p for end in ("*.h", "*.cpp") for p in (root / "tests").rglob(end)}
    for source in sorted(set(sources)):
        name = source.relative_to(root).as_posix()
        folder = folder_of(name)
        content = source.read_text()
        for pattern, words, allowed in CALLS:
            for call in re.finditer(pattern, content) if name not in allowed else ():
                problems.append(f"{name}:{content.count(chr(10), 0, call.start()) + 1}: {call.group()} {words}")
        for kind, header in INCLUDE.findall(content):
            for pattern in ONE_SOURCE_ONLY:
                if re.fullmatch(pattern, header):
                    holders[pattern].add(name)
            if kind == '"':
                owner = header.split("/")[0]
                if "/" not in header or not any(header.startswith(f + "/") for f in OWN[folder]):
                    problems.append(f"{name}: may not include \"{header}\"")
                elif re.fullmatch(BASE, name) and not re.fullmatch(BASE, header):
                    problems.append(f"{name}: may not include \"{header}\", which is not of model/base")
                elif owner != folder and owner in DOORS and not re.fullmatch(DOORS[owner], header):
                    problems.append(f"{name}: may not include \"{header}\", which is private to {owner}/")
                elif not (root / header).exists():
                    problems.append(f"{name}: includes \"{header}\", which is not there")
                continue
            if "/" not in header and "." not in header and not header.startswith("Q"):
                continue  # the standard library
            allowed = [folders for pattern, folders in PACKAGES.items() if re.fullmatch(pattern, header)]
            if not any(folder in folders for folders in allowed):
                problems.append(f"{name}: may not include <{header}>")
    for pattern, names in holders.items():
        if len(names) > 1 or any(n.endswith(".h") for n in names):
            problems.append(f"{pattern} is included in {', '.join(sorted(names))}; allowed is one .cpp")
    for where, count in collections.Counter(s.parent for s in sorted(set(sources) | tests)).items():
        if count > MOST_SOURCES:
            problems.append(f"{where.relative_to(root).as_posix()}: {count} sources; allowed are {MOST_SOURCES}: "
                            "which sub-folder would name what is inside?")
    for gui in (root / "app").rglob("*.h"):
        name = gui.relative_to(root).as_posix()
        if "Q_OBJECT" in gui.read_text() and not name.startswith("app/gui/"):
            problems.append(f"{name}: Q_OBJECT outside app/gui")
    print("\n".join(problems) if problems else f"{len(sources)} files keep the layers")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
