"""palp listen --send with real receivers: the examples of resources/docs/live-forces.md (UDP, ZeroMQ, FIFO), liblo's
oscdump, a pipe, and receivers that do not read; LSL with a stand-in of its library, which Debian does not have. Waits
for what was received, never for a time.

Used by CTest: python3 live_forces.py PALP PAGE FOLDER_OF_THE_STAND_IN
"""

import csv
import io
import json
import math
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

PALP, PAGE, LSL = map(os.path.abspath, sys.argv[1:])
WAIT_s = 100  # for what surely comes


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def listen(*words, **how):
    return subprocess.Popen([PALP, "listen", "--simulate", "--rate", "4000", *map(str, words)], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True, **how)


def check_frame(frame):
    assert float(frame["host_unix_s"]) > 1.7e9 and float(frame["device_s"]) >= 0, frame
    assert int(frame["valid"]) == 1, frame
    for name in ("fx_N", "fy_N", "fz_N", "sd_fx_N", "sd_fy_N", "sd_fz_N"):
        assert math.isfinite(float(frame[name])), frame


def run_example(block, port, send):
    """One block of the page with another port; palp sends until it has its frames."""
    with socket.socket() as reserved:
        reserved.bind(("127.0.0.1", 0))
        other = reserved.getsockname()[1] if send.startswith("zmq") else free_port()
    block = block.replace(str(port), str(other))
    names = {}
    worker = threading.Thread(target=lambda: exec(compile(block, PAGE, "exec"), names), daemon=True)
    worker.start()
    process = listen("--json", "--send", send.replace(str(port), str(other)))
    drain = threading.Thread(target=lambda: output.extend(process.stdout), daemon=True)
    output = []
    drain.start()
    worker.join(WAIT_s)
    assert not worker.is_alive(), send
    process.send_signal(signal.SIGINT)
    process.wait(WAIT_s)
    drain.join(WAIT_s)
    told = {line["frame"]: line for line in map(json.loads, output) if "frame" in line}
    assert len(names["frames"]) == 100
    both = [(frame, told[int(frame["frame"])]) for frame in names["frames"] if int(frame["frame"]) in told]
    assert both # the last ones may be sent and not yet printed
    for frame, printed in both:
        check_frame(frame)
        assert [float(frame[f"f{axis}_N"]) for axis in "xyz"] == printed["forces_N"], frame
    counts = json.loads(output[-1])["sent_to"][0]
    assert counts["receiver"].startswith(send[:4]) and counts["sent"] >= 100, counts


def check_examples():
    blocks = re.findall(r"^```python\n(.*?)^```", pathlib.Path(PAGE).read_text(), flags=re.M | re.S)
    assert len(blocks) == 3
    os.mkfifo("forces.fifo")
    stdout, sys.stdout = sys.stdout, io.StringIO()
    try:
        run_example(blocks[0], 9870, "udp:127.0.0.1:9870")
        run_example(blocks[1], 9871, "zmq:127.0.0.1:9871")
        run_example(blocks[2], 9999, "csv:forces.fifo")
    finally:
        sys.stdout = stdout


def check_osc():
    port = free_port()
    dump = subprocess.Popen(["stdbuf", "-oL", "oscdump", str(port)], stdout=subprocess.PIPE, text=True)
    process = listen("--json", "--send", f"osc:localhost:{port}", "--frames", 10**6)
    reader = threading.Thread(target=process.stdout.read, daemon=True)
    reader.start()
    lines = [dump.stdout.readline().split() for _ in range(20)]
    dump.kill()
    process.send_signal(signal.SIGINT)
    process.wait(WAIT_s)
    for forces, times in zip(lines[0::2], lines[1::2]):
        assert forces[1:3] == ["/palp/forces_N", "iiifffffff"] and len(forces) == 3 + 10 and forces[4] == "1", forces
        assert all(math.isfinite(float(word)) for word in forces[6:]), forces
        assert times[1:3] == ["/palp/time_s", "idd"] and times[3] == forces[3] and float(times[5]) > 1.7e9, times
        assert abs(float(times[4]) - float(forces[6])) < 1e-3, (forces, times)


def check_pipe_and_file():
    """Both hold the same lines; one may hold a few more, that were sent while palp ended."""
    process = listen("--send", "csv:-", "--send", "csv:file.csv", "--frames", 50)
    output, errors = process.communicate(timeout=WAIT_s)
    assert process.returncode == 0, errors
    lines, others = output.splitlines(), open("file.csv").read().splitlines()
    assert f"csv:-: {len(lines) - 1} frames passed to the system" in errors and f"csv:file.csv: {len(others) - 1} frames" in errors, errors
    both = min(len(lines), len(others))
    assert both > 2 and lines[:both] == others[:both]
    for frame in csv.DictReader(lines):
        check_frame(frame)


def replay_with_holes(*words, every=4, **how):
    """A recording of which every fourth (or other) frame lacks more than half of its reports, so that it gives no force."""
    process = listen("--record", "whole.palprec", "--force", "--frames", 40)
    assert process.wait(WAIT_s) == 0, process.stderr.read()
    whole = open("whole.palprec", "rb").read()
    place = 12 + int.from_bytes(whole[8:12], "little")
    kept = [whole[:place]]
    while place < len(whole):
        end = place + 12 + int.from_bytes(whole[place + 2:place + 4], "little")
        report = whole[place + 12:end]
        if whole[place] != 0 or report[8] % every != every - 1 or report[10] > 6: # frame and row-wire
            kept.append(whole[place:end])
        place = end
    open("holes.palprec", "wb").write(b"".join(kept))
    network = pathlib.Path(PAGE).parent.parent / "board" / "paper-network.json"
    return subprocess.Popen([PALP, "listen", "--replay", "holes.palprec", "--network", network, *map(str, words)],
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **how)


def check_without_force():
    """Frames without a force have no forces in any form; where no frame has one, the exit status says so."""
    process = replay_with_holes("--send", "csv:bad.csv", "--json")
    output, errors = process.communicate(timeout=WAIT_s)
    assert process.returncode == 0, errors
    valid = [line["valid"] for line in map(json.loads, output.splitlines()) if "valid" in line]
    both = list(zip(csv.DictReader(open("bad.csv")), valid))
    assert any(valid) and not all(valid), valid
    for frame, good in both:
        assert (frame["valid"] == "1") == good and (frame["fx_N"] != "") == good, frame
    process = replay_with_holes(every=1)
    output, errors = process.communicate(timeout=WAIT_s)
    assert process.returncode == 1 and "no frame gave a force: " in errors, errors


def lsl_lines():
    lines = [line.split() for line in open("lsl-receiver.txt")]
    os.remove("lsl-receiver.txt")
    return lines


def check_lsl():
    """Without a receiver nothing is sent; with one, the stream has the names, units and numbers of the CSV lines."""
    environment = {**os.environ, "LD_LIBRARY_PATH": LSL}
    process = listen("--send", "lsl:palp", "--json", "--frames", 5, env=environment)
    output, errors = process.communicate(timeout=WAIT_s)
    assert process.returncode == 0, errors
    counts = json.loads(output.splitlines()[-1])["sent_to"][0]
    assert counts["sent"] == 0 and counts["dropped"] >= 5, counts

    open("lsl-receiver.txt", "w").close()
    process = listen("--send", "lsl:palp", "--json", "--frames", 20, env=environment)
    output, errors = process.communicate(timeout=WAIT_s)
    apart_s = time.time() - time.clock_gettime(time.CLOCK_MONOTONIC)
    assert process.returncode == 0, errors
    *frames, last = map(json.loads, output.splitlines())
    lines = lsl_lines()
    names = "device_s,host_unix_s,frame,valid,area,fx_N,fy_N,fz_N,sd_fx_N,sd_fy_N,sd_fz_N".split(",")
    assert lines[0][:6] == ["stream", "palp", "Force", str(len(names)), "0", "2"], lines[0]
    assert lines[0][6].startswith("palp:") and lines[0][6].endswith(":palp"), lines[0]
    assert [line[1] for line in lines if line[0] == "label"] == names
    assert [line[1] for line in lines if line[0] == "unit"] == ["s", "s"] + 6 * ["N"] and lines[-1] == ["end"]
    samples = [list(map(float, line[1:])) for line in lines if line[0] == "sample"]
    assert len(samples) == last["sent_to"][0]["sent"] and len(samples) > 2
    by_number = {frame["frame"]: frame for frame in frames}
    both = [(sample, by_number[sample[3]]) for sample in samples if sample[3] in by_number]
    assert both
    for (time_s, *values), printed in both:
        frame = dict(zip(names, values))
        assert abs(time_s - (frame["host_unix_s"] - apart_s)) < 1, (frame, time_s)
        check_frame(frame)
        assert [frame[f"f{axis}_N"] for axis in "xyz"] == printed["forces_N"], frame
        assert frame["area"] == printed["area"], frame

    open("lsl-receiver.txt", "w").close() # frames without a force: NaN where CSV has empty fields
    process = replay_with_holes("--send", "lsl:palp", "--send", "csv:lsl.csv", env=environment)
    output, errors = process.communicate(timeout=WAIT_s)
    assert process.returncode == 0, errors
    rows = {float(row["frame"]): list(row.values()) for row in csv.DictReader(open("lsl.csv"))}
    samples = [list(map(float, line[2:])) for line in lsl_lines() if line[0] == "sample"]
    both = [(sample, rows[sample[2]]) for sample in samples if sample[2] in rows]
    assert {sample[3] for sample, row in both} == {0, 1}, both
    for sample, row in both:
        assert ["" if math.isnan(value) else value for value in sample] == [word and float(word) for word in row], row


def check_localhost():
    """Whichever of the addresses of this computer a program listens to; and nobody is nobody."""
    named = {info[4][0] for info in socket.getaddrinfo("localhost", 1, type=socket.SOCK_DGRAM)}
    for address in named:
        with socket.socket(socket.AF_INET6 if ":" in address else socket.AF_INET, socket.SOCK_DGRAM) as receiver:
            receiver.bind((address, 0))
            receiver.settimeout(WAIT_s)
            process = listen("--send", f"udp:localhost:{receiver.getsockname()[1]}", "--frames", 20, "--json")
            output, errors = process.communicate(timeout=WAIT_s)
            assert json.loads(receiver.recv(65536))["frame"] >= 0
        sent = json.loads(output.splitlines()[-1])["sent_to"][0]
        assert sent["sent"] >= 20 and sent["dropped"] == 0, (address, sent)
    nobody = [f"{kind}:localhost:{free_port()}" for kind in ("udp", "osc", "zmq")]
    process = listen("--json", "--frames", 20, *(word for where in nobody for word in ("--send", where)))
    output, errors = process.communicate(timeout=WAIT_s)
    for sent in json.loads(output.splitlines()[-1])["sent_to"]:
        assert sent["sent"] == 0 and sent["dropped"] >= 20, sent


def check_receivers_that_do_not_read():
    """A FIFO that is open and never read, one that nobody opens, and a dead port: the board loses nothing."""
    os.mkfifo("stuck.fifo")
    os.mkfifo("unread.fifo")
    stuck = os.open("stuck.fifo", os.O_RDONLY | os.O_NONBLOCK)
    process = listen("--json", "--send", "csv:stuck.fifo", "--send", "csv:unread.fifo", "--send",
                     f"udp:127.0.0.1:{free_port()}", "--send", "csv:taken.csv", "--frames", 700)
    output, errors = process.communicate(timeout=WAIT_s)
    os.close(stuck)
    assert process.returncode == 0, errors
    last = json.loads(output.splitlines()[-1])
    stuck, unread, dead, taken = last["sent_to"]
    assert stuck["dropped"] > 0 and unread["sent"] == 0 and unread["dropped"] > 0 and dead["dropped"] > 0, last
    assert taken["sent"] > stuck["sent"], last
    assert last["lost_reports"] == 0 and len(output.splitlines()) == 701, last
    assert open("taken.csv").read().count("\n") == taken["sent"] + 1


def check_refusals():
    open("there.csv", "w").write("precious")
    for where, part in (("udp:224.0.0.1:9", "broadcast or multicast"), ("osc:255.255.255.255:9", "broadcast or multicast"),
                        ("udp:[ff02::1]:9", "broadcast or multicast"), ("udp:nowhere.invalid:9", "unknown"),
                        ("udp:localhost:0", "1 to 65535"), ("udp:localhost", "udp:HOST:PORT"), ("fax:x:1", "csv:FILE"),
                        ("csv:", "csv:FILE"), ("csv:/nowhere/x", "/nowhere/x"), ("csv:there.csv", "--force"),
                        ("csv:.", "folder")):
        result = subprocess.run([PALP, "listen", "--simulate", "--frames", "1", "--send", where], capture_output=True,
                                text=True, timeout=WAIT_s)
        assert result.returncode == 2 and result.stderr.count("\n") == 1 and part in result.stderr, (where, result)
    assert open("there.csv").read() == "precious"
    for name in ("liblsl.so.2", "liblsl.so"):
        open(name, "w").close()
    for where, folder, part in (("lsl:palp", ".", "liblsl.so.2: file too short"), ("lsl:two words", LSL, "without spaces"),
                                ("lsl:" + 101 * "a", LSL, "1 to 100"), ("lsl:", LSL, "lsl:NAME")):
        result = subprocess.run([PALP, "listen", "--simulate", "--frames", "1", "--send", where], capture_output=True,
                                text=True, timeout=WAIT_s, env={**os.environ, "LD_LIBRARY_PATH": folder})
        assert result.returncode == 2 and result.stderr.count("\n") == 1 and part in result.stderr, (where, result)
    result = subprocess.run([PALP, "listen", "--simulate", "--json", "--send", "csv:-"], capture_output=True, text=True,
                            timeout=WAIT_s)
    assert result.returncode == 2 and "csv:-" in result.stderr, result


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for step in (check_refusals, check_pipe_and_file, check_without_force, check_lsl, check_osc, check_examples, check_localhost,
                 check_receivers_that_do_not_read):
        step()
    os.chdir("/")
