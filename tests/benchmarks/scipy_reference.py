#!/usr/bin/python3
"""What scipy's RBFInterpolator gives and how long it takes.

scipy_reference.py --write FILE   tests/reference/scipy_rbf.csv: 80 training and 40 fresh rows, x0..x3, y0, y1
scipy_reference.py --time         seconds of the benchmark's four cases, one JSON object (linear tail, 600 centres)
"""
import json
import sys
import time

import numpy
from scipy.interpolate import RBFInterpolator


def write(path):
    generator = numpy.random.default_rng(1)
    x = generator.uniform(-1, 1, (120, 4))
    y = numpy.stack([numpy.sin(x[:, 0] + x[:, 1]) + x[:, 2] ** 2, x[:, 3] * numpy.exp(x[:, 0])], axis=1)
    # exp(-(epsilon r)^2) = exp(-r^2 / (2 sigma^2)) with sigma = 0.6
    epsilon = 1 / (0.6 * numpy.sqrt(2))
    y[80:] = RBFInterpolator(x[:80], y[:80], kernel="gaussian", epsilon=epsilon, degree=1)(x[80:])
    with open(path, "w", encoding="ascii") as file:
        file.write("x0,x1,x2,x3,y0,y1 (rows 80 on: y by scipy, gaussian, sigma 0.6, degree 1)\n")
        for row in numpy.hstack([x, y]):
            file.write(",".join(repr(float(value)) for value in row) + "\n")


def seconds(work, repeats):
    best = float("inf")
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        best = min(best, time.perf_counter() - start)
    return best


def measure():
    generator = numpy.random.default_rng(1)
    causes = generator.uniform(-1, 1, (10600, 3))
    mixing = generator.normal(size=(3, 30))
    x = causes @ mixing + 0.02 * (causes**2) @ generator.normal(size=(3, 30))
    train, targets, many = x[:600], causes[:600], x[600:]

    def fit(epsilon=0.5):
        return RBFInterpolator(train, targets, kernel="gaussian", epsilon=epsilon, degree=1, smoothing=1e-12)

    model = fit()
    # scipy has no leave-one-out in closed form: a full inverse a spread, as its users write it
    square = ((train[:, None, :] - train[None, :, :]) ** 2).sum(-1)

    def leave_one_out():
        for spread in numpy.geomspace(0.5, 50, 40):
            inverse = numpy.linalg.inv(numpy.exp(-square / spread**2) + 1e-10 * numpy.eye(600))
            (inverse @ targets) / numpy.diag(inverse)[:, None]

    print(json.dumps({
        "fit_600x30_s": seconds(fit, 5),
        "leave_one_out_40_spreads_s": seconds(leave_one_out, 1),
        "predict_one_s": seconds(lambda: model(many[:1]), 200),
        "predict_10000_s": seconds(lambda: model(many), 3),
    }))


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "--write":
        write(sys.argv[2])
    elif sys.argv[1:] == ["--time"]:
        measure()
    else:
        sys.exit(__doc__)
