#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A program that prints a session while it runs, with what its own index answers; here that is a scan of all points.

    python3 brute.py | octreel record - -o flight && octreel audit flight

With an argument the index is stale, where points were a tick before, and octreel audit says so."""
import json, sys

seed = 1

def place():
    global seed
    at = []
    for _ in range(3):
        seed = seed * 16807 % 2147483647
        at.append(seed % 1801 - 900)
    return at

def say(thing):
    print(json.dumps(thing, separators=(",", ":")), flush=True)

points = {i: place() for i in range(1, 101)}
say({"octreel": "session", "version": 2, "player": None, "points": [p + [i] for i, p in points.items()]})
for tick in range(1, 31):
    index = dict(points) if len(sys.argv) > 1 else points
    moved = [i for i in points if i % 10 == tick % 10]
    for i in moved:
        points[i] = place()
    at = place()
    squared = {i: sum((a - b) ** 2 for a, b in zip(p, at)) for i, p in index.items()}
    say({"tick": tick,
         "edits": [{"move": {"id": i, "position": points[i]}} for i in moved],
         "queries": [{"nearest": at, "answer": [min(squared, key=squared.get)]},
                     {"radius": 500, "at": at, "answer": [i for i in squared if squared[i] <= 500 ** 2]}]})
