"""palp listen --send udp at 1,000 frames of one row-wire a second for a minute, into a receiver that is written from the format which
PlotJuggler's UDP server reads (resources/docs/live-forces.md): every frame arrives, once and in order. How long a frame
takes from its last reading to the kernel's arrival stamp of its datagram is printed; only with --quiet, on a machine that
does nothing else, is it held against 1 ms. A receiver that stopped reading stands beside it: the board must not notice.

Used by CTest: python3 live_rate.py PALP SAMPLES [SECONDS] [--quiet]
"""

import json
import math
import os
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading

SO_TIMESTAMPNS = 35 # Linux, x86-64: Python 3.11 has no name for it
RATE_per_s = 1000
REPORTS_of_a_row = 2
LATENCY_BAR_ms = 1.0


def receiver():
    """A socket of 127.0.0.1 with as much room as the kernel gives."""
    taken = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    taken.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 8 << 20)
    taken.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
    taken.bind(("127.0.0.1", 0))
    taken.settimeout(0.5)
    return taken


def read_all(taken, over, frames):
    """Frame numbers and latencies [ms] until `over` is set and nothing more comes."""
    while True:
        try:
            data, aside, *_ = taken.recvmsg(4096, 128)
        except socket.timeout:
            if over.is_set():
                return
            continue
        stamp = next(value for level, kind, value in aside if level == socket.SOL_SOCKET and kind == SO_TIMESTAMPNS)
        seconds, nanoseconds = struct.unpack("qq", stamp)
        frames.append((data, seconds + 1e-9 * nanoseconds))


def main(palp, samples, seconds, quiet):
    subprocess.run([palp, "train", samples, "--input", "resistance", "--rows", "4", "--noise", "1e-4", "-o", "row.json"],
                   check=True, stdout=subprocess.DEVNULL)
    taken, over, datagrams = receiver(), threading.Event(), []
    os.mkfifo("stuck.fifo")
    stuck = os.open("stuck.fifo", os.O_RDONLY | os.O_NONBLOCK) # open, and never read
    reader = threading.Thread(target=read_all, args=(taken, over, datagrams))
    reader.start()
    process = subprocess.run(
        [palp, "listen", "--simulate", "--network", "row.json", "--row", "4", "--rate", str(REPORTS_of_a_row * RATE_per_s), "--seconds", str(seconds), "--json", "--send",
         f"udp:127.0.0.1:{taken.getsockname()[1]}", "--send", "csv:stuck.fifo"],
        stdout=open("frames.jsonl", "w"), stderr=subprocess.PIPE, text=True, timeout=3 * seconds + 60)
    over.set()
    reader.join()
    os.close(stuck)
    assert process.returncode == 0, process.stderr
    with open("frames.jsonl") as lines:
        *printed, last = map(json.loads, lines)
    udp, fifo = last["sent_to"]

    frames = [json.loads(data) for data, _ in datagrams]
    decoding_ms = {line["frame"]: line["latency_ms"] for line in printed}
    late_ms = sorted(1e3 * (stamp - frame["host_unix_s"]) + decoding_ms[frame["frame"]]
                     for frame, (_, stamp) in zip(frames, datagrams) if frame["frame"] in decoding_ms)
    numbers = [frame["frame"] for frame in frames]
    lost = udp["sent"] - len(frames)
    p50, p99 = late_ms[len(late_ms) // 2], late_ms[math.ceil(0.99 * len(late_ms)) - 1]
    print(f"{len(frames)} of {udp['sent']} frames received in {seconds} s, {lost} lost, {udp['dropped']} dropped; reading to "
          f"datagram: median {p50:.3f} ms, p99 {p99:.3f} ms, longest {late_ms[-1]:.2f} ms; reports lost "
          f"{last['lost_reports']}; the FIFO that is not read: {fifo['dropped']} dropped")
    assert lost == 0 and udp["dropped"] == 0, udp
    assert all(a < b for a, b in zip(numbers, numbers[1:])), "each frame once, in order"
    assert len(frames) > 0.9 * RATE_per_s * seconds, len(frames)
    assert last["lost_reports"] == 0 and fifo["dropped"] > 0, last
    for frame in frames:
        assert frame["valid"] == 1 and all(math.isfinite(frame[f"f{axis}_N"]) for axis in "xyz"), frame
    assert late_ms[0] >= 0, late_ms[0]
    if quiet:
        assert p99 < LATENCY_BAR_ms, p99


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    words = [word for word in sys.argv[1:] if word != "--quiet"]
    program, solved = map(os.path.abspath, words[:2])
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        main(program, solved, int(words[2]) if len(words) > 2 else 60, "--quiet" in sys.argv)
        os.chdir("/")
